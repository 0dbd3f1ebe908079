// Writing never leaves a half-written file.
#include "io/file.h"

#include <filesystem>
#include <fstream>
#include <unistd.h>

#include "tests/io/sample_meshes.h"

namespace hexweft::test {
namespace {

namespace fs = std::filesystem;

// A folder of the test's own in this process, gone afterwards.
class Folder : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        fs::path(testing::TempDir()) /
        (std::string("hexweft-") + testing::UnitTest::GetInstance()->current_test_info()->name() +
         "-" + std::to_string(::getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  int n_entries() const {
    return static_cast<int>(std::distance(fs::directory_iterator(folder_), {}));
  }
  fs::path folder_;
};

using WriteFile = Folder;

TEST_F(WriteFile, WritesWhatIsReadBack) {
  std::string content = "line\n";
  content += '\0';
  write_file(folder_ / "a", content);
  EXPECT_EQ(read_file(folder_ / "a"), content);
  write_file(folder_ / "a", "");
  EXPECT_EQ(read_file(folder_ / "a"), "");
  EXPECT_EQ(n_entries(), 1);
}

TEST_F(WriteFile, KeepsPermissionsAndLinks) {
  write_file(folder_ / "real", "old");
  fs::permissions(folder_ / "real", fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("real", folder_ / "link");
  write_file(folder_ / "link", "new");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
  EXPECT_EQ(read_file(folder_ / "real"), "new");
  EXPECT_EQ(fs::status(folder_ / "real").permissions(),
            fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(n_entries(), 2);
}

TEST_F(WriteFile, WritesThroughToDevices) {
  write_file("/dev/null", "anything");
  EXPECT_FALSE(fs::is_regular_file("/dev/null"));
}

TEST_F(WriteFile, AFullDiskIsAnError) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  EXPECT_THAT(
      [] { write_file("/dev/full", "anything"); },
      testing::ThrowsMessage<FormatError>(testing::StartsWith("/dev/full: cannot be written: ")));
}

TEST_F(WriteFile, AFailureNamesThePathAndLeavesNothing) {
  const fs::path nowhere = folder_ / "missing" / "a.vtk";
  EXPECT_THAT([&] { write_hex_mesh(nowhere, unit_cube()); },
              testing::ThrowsMessage<FormatError>(
                  nowhere.string() + ": cannot be written: No such file or directory"));
  fs::create_directory(folder_ / "folder.vtk");
  EXPECT_THROW(write_hex_mesh(folder_ / "folder.vtk", unit_cube()), FormatError);
  EXPECT_EQ(n_entries(), 1);
}

TEST_F(WriteFile, TheOutputCanBeCheckedBeforehand) {
  EXPECT_NO_THROW(check_hex_mesh_output(folder_ / "a.vtk"));
  EXPECT_NO_THROW(check_hex_mesh_output("-"));
  EXPECT_THROW(check_hex_mesh_output(folder_ / "missing" / "a.vtk"), FormatError);
  EXPECT_THROW(check_hex_mesh_output(folder_, {.format = "vtk"}), FormatError);
  EXPECT_THROW(check_hex_mesh_output(folder_ / "a.xyz"), InputError);
  EXPECT_THROW(check_hex_mesh_output(folder_ / "a.mesh", {.binary = true}), InputError);
  EXPECT_EQ(n_entries(), 0);
}

TEST_F(WriteFile, ABadRequestLeavesTheTargetAlone) {
  write_file(folder_ / "a.mesh", "precious");
  EXPECT_THROW(write_hex_mesh(folder_ / "a.mesh", unit_cube(), {.binary = true}), InputError);
  EXPECT_THROW(write_hex_mesh(folder_ / "a.mesh", unit_cube(), {.format = "stl"}), InputError);
  EXPECT_THROW(write_hex_mesh(folder_ / "a.xyz", unit_cube()), InputError);
  EXPECT_EQ(read_file(folder_ / "a.mesh"), "precious");
  EXPECT_EQ(n_entries(), 1);
}

TEST_F(WriteFile, ANameMayBeAsLongAsNamesCanBe) {
  const std::string name(255, 'x');
  write_file(folder_ / name, "content");
  EXPECT_EQ(read_file(folder_ / name), "content");
  EXPECT_EQ(n_entries(), 1);
}

TEST_F(WriteFile, TheExtensionChoosesTheFormat) {
  EXPECT_EQ(write_hex_mesh(folder_ / "a.MESH", unit_cube()).format, "medit");
  EXPECT_THAT(read_file(folder_ / "a.MESH"), testing::StartsWith("MeshVersionFormatted"));
  expect_same_mesh(read_hex_mesh(folder_ / "a.MESH"), unit_cube());
  EXPECT_EQ(write_hex_mesh(folder_ / "a.mesh", unit_cube(), {.format = "vtk"}).format, "vtk");
  EXPECT_THROW(read_hex_mesh(folder_ / "a.mesh"), FormatError);
  expect_same_mesh(read_hex_mesh(folder_ / "a.mesh", {.format = "vtk"}), unit_cube());
}

TEST_F(WriteFile, ReadingWhatIsNotThereNamesIt) {
  EXPECT_THAT([&] { read_hex_mesh(folder_ / "no.vtk"); },
              testing::ThrowsMessage<FormatError>((folder_ / "no.vtk").string() +
                                                  ": cannot be read: No such file or directory"));
  EXPECT_THAT([&] { read_hex_mesh(folder_); },
              testing::ThrowsMessage<FormatError>(testing::HasSubstr("Is a directory")));
}

}  // namespace
}  // namespace hexweft::test
