// Surfaces of triangle files.
#include "optimize/surface_io.h"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>

#include "optimize/hausdorff.h"
#include "ovm/errors.h"
#include "ovm/generators.h"

namespace hexweft {
namespace {

class SurfaceFile : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) / (std::string("surface-") + info->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, const std::string& content) const {
    std::ofstream(folder_ / name, std::ios::binary) << content;
    return folder_ / name;
  }
  std::string message(const std::string& name, const std::string& content) const {
    try {
      read_surface(write(name, content));
    } catch (const FormatError& error) {
      return error.what();
    }
    return "read";
  }

 private:
  std::filesystem::path folder_;
};

// A cube of side 1 in quadrilaterals.
const char* const kCubeOff =
    "OFF\n8 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
    "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";
const char* const kCubeObj =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
const char* const kCubePly =
    "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float "
    "z\n"
    "element face 6\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
    "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";
const char* const kTriangleStl =
    "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
    "endfacet\nendsolid x\n";

TEST_F(SurfaceFile, EveryFormatGivesTheCubeOfAGrid) {
  const ReferenceSurface grid = make_reference_surface(make_grid({1, 1, 1}));
  for (const auto& [name, content] :
       {std::pair("cube.off", kCubeOff), {"cube.obj", kCubeObj}, {"CUBE.PLY", kCubePly}}) {
    SCOPED_TRACE(name);
    const ReferenceSurface surface = read_surface(write(name, content));
    EXPECT_EQ(surface.triangles().size(), 12u);
    EXPECT_LT(hausdorff_distance(surface, grid).distance(), 1e-12);
    // From outside the sides run counter-clockwise.
    EXPECT_GT(surface.closest({2, 0.5, 0.5}).normal.x(), 0.99);
  }
  EXPECT_EQ(read_surface(write("t.stl", kTriangleStl)).triangles().size(), 1u);
}

// Two triangles; the header may begin as that of a text file does.
TEST_F(SurfaceFile, BinaryStlIsRead) {
  const float square[2][12] = {{0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 1, 0},
                               {0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 1, 0}};
  for (const std::string header : {"solid x", "made by a scanner", ""}) {
    SCOPED_TRACE(header);
    std::string content = header;
    content.resize(80, header.empty() ? '\0' : ' ');
    content += std::string("\2\0\0\0", 4);
    for (const auto& triangle : square) {
      content.append(reinterpret_cast<const char*>(triangle), sizeof(triangle));
      content.append(2, '\0');
    }
    const ReferenceSurface surface = read_surface(write("b.stl", content));
    EXPECT_EQ(surface.triangles().size(), 2u);
    EXPECT_NEAR(surface.closest({0.5, 0.5, 3}).distance, 3, 1e-12);
    content.pop_back();
    EXPECT_NE(message("cut.stl", content), "read");
  }
}

TEST_F(SurfaceFile, WhatIsNoSurfaceIsNamed) {
  EXPECT_THAT(message("no.obj", "hello\n"), testing::HasSubstr("no.obj: "));
  EXPECT_THAT(message("empty.off", ""), testing::HasSubstr("empty.off: "));
  EXPECT_THAT(message("bad.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 9\n"),
              testing::HasSubstr("has no triangles"));
  EXPECT_THAT(message("mesh.vtk", kCubeOff), testing::HasSubstr("expected a surface"));
  EXPECT_THROW(read_surface("/no/such/file.off"), FormatError);
}

TEST(SurfaceExtensions, AreKnownInAnyCase) {
  EXPECT_TRUE(is_surface_file("a.stl"));
  EXPECT_TRUE(is_surface_file("b/c.OBJ"));
  EXPECT_FALSE(is_surface_file("a.vtk"));
  EXPECT_FALSE(is_surface_file("-"));
}

}  // namespace
}  // namespace hexweft
