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
      expect_same_numbers(read_file(entry.path()), mesh);
      ++n;
    }
  }
  EXPECT_GT(n, 0);
}

}  // namespace
}  // namespace hexweft::test
