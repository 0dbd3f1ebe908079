// Real meshes, where they are at hand.
#include <filesystem>
#include <sstream>

#include "io/file.h"
#include "tests/io/sample_meshes.h"

namespace hexweft::test {
namespace {

namespace fs = std::filesystem;

// The file once more, through the numbers of the standard streams.
void expect_same_numbers(const std::string& file, const HexMesh& mesh) {
  std::istringstream in(file.substr(file.find("POINTS") + 6));
  std::string word;
  int n = 0;
  in >> n >> word;
  ASSERT_EQ(n, mesh.n_vertices());
  for (VertexHandle v : mesh.vertices()) {
    for (double expected : mesh.point(v)) {
      in >> word;
      EXPECT_EQ(std::stod(word), expected);
    }
  }
  in >> word >> n >> word;
  ASSERT_EQ(n, mesh.n_cells());
  for (CellHandle c : mesh.cells()) {
    in >> n;
    EXPECT_EQ(n, 8);
    for (VertexHandle v : mesh.vertices(c)) {
      in >> n;
      EXPECT_EQ(n, v.idx);
    }
  }
}

TEST(SharedData, EveryMeshComesBackBitForBit) {
  const fs::path data = HEXWEFT_SHARED_DATA;
  if (!fs::exists(data)) GTEST_SKIP() << data << " is not there";
  int n = 0;
  for (const char* folder : {"octree", "polycube", "published"}) {
    for (const auto& entry : fs::directory_iterator(data / folder)) {
      if (entry.path().extension() != ".vtk") continue;
      SCOPED_TRACE(entry.path().string());
      const HexMesh mesh = read_hex_mesh(entry.path());
      const std::string text = write_hex_mesh_text(mesh);
      const std::string binary = write_hex_mesh_text(mesh, {.binary = true});
      EXPECT_EQ(text, write_hex_mesh_text(read_hex_mesh_text(binary, "binary")));
      const std::string xml = write_hex_mesh_text(mesh, {.format = "vtu"});
      EXPECT_EQ(text, write_hex_mesh_text(read_hex_mesh_text(xml, "xml")));
      expect_same_numbers(read_file(entry.path()), mesh);
      ++n;
    }
  }
  EXPECT_GT(n, 0);
}

// Files that the OpenVolumeMesh library wrote, and variations of them, t_*.
TEST(SharedData, FilesOfOpenVolumeMesh) {
  const fs::path data = HEXWEFT_SHARED_DATA, folder = data / "formats";
  if (!fs::exists(folder)) GTEST_SKIP() << folder << " is not there";
  HexMesh bone = read_hex_mesh(data / "octree" / "bone.vtk");
  property_registry<VertexTag>(bone)->erase("fixed");
  for (const char* name : {"bone.ovm", "bone.ovmb"}) {
    SCOPED_TRACE(name);
    const HexMesh mesh = read_hex_mesh(folder / name);
    ASSERT_EQ(mesh.n_cells(), bone.n_cells());
    for (VertexHandle v : bone.vertices()) EXPECT_EQ(mesh.point(v), bone.point(v));
    for (CellHandle c : bone.cells()) EXPECT_EQ(mesh.vertices(c), bone.vertices(c));
    // Edges and faces too are numbered as the library does.
    const std::string file = read_file(folder / "bone.ovm");
    const std::string text = write_hex_mesh_text(bone, {.format = "ovm"});
    EXPECT_EQ(file.substr(0, text.size()), text);
  }
  const std::vector<std::string> kRefused{"t_edgeoffset1.ovmb", "t_noeof.ovmb", "t_tet.ovmb",
                                          "t_unkmand.ovmb"};
  int n = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename();
    SCOPED_TRACE(name);
    const bool refused = std::find(kRefused.begin(), kRefused.end(), name) != kRefused.end();
    if (refused) {
      EXPECT_THROW(read_hex_mesh(entry.path()), FormatError);
    } else {
      EXPECT_GT(read_hex_mesh(entry.path()).n_cells(), 0);
    }
    ++n;
  }
  EXPECT_GT(n, 0);
}

}  // namespace
}  // namespace hexweft::test
