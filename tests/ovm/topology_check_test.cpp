#include "ovm/topology_check.h"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>

#include "ovm/topology_summary.h"
#include "tests/mesh_families.h"

namespace hexweft {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;

auto IsDefect(TopologyDefect defect, int index) {
  return AllOf(Field(&TopologyViolation::defect, defect), Field(&TopologyViolation::index, index));
}

std::vector<int> indices(const std::vector<TopologyViolation>& violations, TopologyDefect defect) {
  std::vector<int> result;
  for (const auto& v : violations) {
    if (v.defect == defect) result.push_back(v.index);
  }
  return result;
}

class EveryMeshFamily : public testing::TestWithParam<MeshFamily> {};
INSTANTIATE_TEST_SUITE_P(, EveryMeshFamily, testing::ValuesIn(mesh_families()), family_name);

TEST_P(EveryMeshFamily, IsClean) {
  const HexMesh mesh = GetParam().make();
  EXPECT_THAT(check_topology(mesh), IsEmpty());
  const std::vector<VertexHandle> all(mesh.vertices().begin(), mesh.vertices().end());
  EXPECT_THAT(check_topology(mesh, all), IsEmpty());
}

// Deleting cells makes every kind of bad vertex and edge; what is found locally is what lies there.
TEST_P(EveryMeshFamily, LocalCheckFindsWhatTheGlobalOneFindsThere) {
  HexMesh mesh = GetParam().make();
  int i = 0;
  for (CellHandle c : std::vector<CellHandle>(mesh.cells().begin(), mesh.cells().end())) {
    if (++i % 3 == 0) mesh.delete_cell(c);
  }
  const auto global = check_topology(mesh);
  for (VertexHandle v : mesh.vertices()) {
    if (v.idx % 4 != 0) continue;  // a quarter of them says as much
    const auto local = check_topology(mesh, std::array{v});
    for (const auto& x : global) {
      const bool is_here = (x.defect == TopologyDefect::nonmanifold_vertex && x.index == v.idx) ||
                           (x.defect == TopologyDefect::nonmanifold_edge &&
                            std::ranges::count(mesh.vertices(EdgeHandle(x.index)), v) > 0);
      if (!is_here) continue;
      EXPECT_THAT(local, Contains(IsDefect(x.defect, x.index)));
    }
    for (const auto& x : local) EXPECT_THAT(global, Contains(IsDefect(x.defect, x.index)));
    for (const Severity s : {Severity::note, Severity::degenerate, Severity::invalid}) {
      EXPECT_EQ(is_clean(mesh, std::array{v}, s), is_clean(local, s));
    }
  }
}

TEST(Check, NamesTheVertexThatIsAllTwoCellsShare) {
  const HexMesh mesh =
      make_voxels(VoxelSet({2, 2, 2}, [](int x, int y, int z) { return x == y && y == z; }));
  const int shared = mesh.vertices(CellHandle(0))[6].idx;
  const auto found = check_topology(mesh);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(found[0], IsDefect(TopologyDefect::nonmanifold_vertex, shared));
  EXPECT_THAT(found[0].message, HasSubstr("vertex " + std::to_string(shared) + ", at (1, 1, 1), "));
  EXPECT_FALSE(is_valid(mesh));
}

TEST(Check, NamesTheEdgeThatIsAllTwoCellsShare) {
  const HexMesh mesh = make_voxels(VoxelSet({2, 2, 1}, [](int x, int y, int) { return x == y; }));
  const auto& v = mesh.vertices(CellHandle(0));
  const auto found = check_topology(mesh);
  EXPECT_THAT(indices(found, TopologyDefect::nonmanifold_edge),
              testing::ElementsAre(mesh.find_edge(v[2], v[6]).idx));
  EXPECT_THAT(indices(found, TopologyDefect::nonmanifold_vertex),
              testing::UnorderedElementsAre(v[2].idx, v[6].idx));
  // The number of an edge stands in no file.
  const std::string ends = std::to_string(v[2].idx) + " and " + std::to_string(v[6].idx);
  EXPECT_EQ(found[0].message, "the edge between vertices " + ends +
                                  ", at (1, 1, 0), has 4 boundary faces, expected 2");
}

TEST(Check, NamesTheVertexWhereTwoCavitiesMeet) {
  HexMesh mesh = make_grid({4, 4, 4});
  mesh.delete_cell(CellHandle(1 + 4 * (1 + 4 * 1)));
  mesh.delete_cell(CellHandle(2 + 4 * (2 + 4 * 2)));
  EXPECT_THAT(indices(check_topology(mesh), TopologyDefect::nonmanifold_vertex),
              testing::ElementsAre(2 + 5 * (2 + 5 * 2)));
}

TEST(Check, NamesAFaceWithThreeCells) {
  HexMesh mesh = make_grid({2, 1, 1});
  CellVertices third = mesh.vertices(CellHandle(1));
  for (int i : {1, 2, 5, 6}) third[i] = mesh.add_vertex(mesh.point(third[i]));
  const CellHandle c = mesh.add_cell(third);
  const auto found = check_topology(mesh);
  EXPECT_THAT(found, Contains(IsDefect(TopologyDefect::nonconforming_face,
                                       mesh.face(mesh.halfface(c, 0)).idx)));
  EXPECT_THAT(found[0].message, testing::MatchesRegex("the face of vertices [0-9]+, [0-9]+, [0-9]+ "
                                                      "and [0-9]+, at \\(1, [01], [01]\\), .*"));
  EXPECT_FALSE(is_valid(mesh));
}

TEST(Check, NamesTheFacesOfACellAddedTwice) {
  HexMesh mesh = make_grid({1, 1, 1});
  mesh.add_cell(mesh.vertices(CellHandle(0)));
  const auto found = check_topology(mesh);
  EXPECT_EQ(indices(found, TopologyDefect::inside_out_face).size(), 6u);
  EXPECT_THAT(found, Contains(IsDefect(TopologyDefect::multiply_glued_cells, 0)));
}

TEST(Check, NamesTheFaceOfACellGluedInsideOut) {
  HexMesh mesh = make_grid({2, 1, 1});
  const CellVertices v = mesh.vertices(CellHandle(1));
  mesh.delete_cell(CellHandle(1));
  const CellHandle c = mesh.add_cell({v[4], v[5], v[6], v[7], v[0], v[1], v[2], v[3]});
  const auto found = check_topology(mesh);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(found[0],
              IsDefect(TopologyDefect::inside_out_face, mesh.face(mesh.halfface(c, 0)).idx));
}

// Two cells folded round an edge: they share two faces, the edge is inside and has two cells, and
// at its ends two faces share two edges. Degenerate, but a manifold.
TEST(Check, NamesADoublet) {
  HexMesh mesh = make_grid({1, 1, 1});
  const CellVertices v = mesh.vertices(CellHandle(0));
  const VertexHandle p = mesh.add_vertex({-1, -1, 0}), q = mesh.add_vertex({-1, -1, 1});
  mesh.add_cell({v[0], v[3], p, v[1], v[4], v[7], q, v[5]});
  const auto found = check_topology(mesh);
  EXPECT_EQ(found.size(), 4u);
  EXPECT_THAT(found,
              Contains(IsDefect(TopologyDefect::low_valence_edge, mesh.find_edge(v[0], v[4]).idx)));
  EXPECT_THAT(found, Contains(IsDefect(TopologyDefect::multiply_glued_cells, 0)));
  EXPECT_THAT(found, Contains(IsDefect(TopologyDefect::doublet, v[0].idx)));
  EXPECT_THAT(found, Contains(IsDefect(TopologyDefect::doublet, v[4].idx)));
  EXPECT_TRUE(is_valid(mesh));
  EXPECT_FALSE(is_clean(found, Severity::degenerate));
}

TEST(Check, NotesAnIsolatedVertex) {
  HexMesh mesh = make_grid({1, 1, 1});
  const VertexHandle v = mesh.add_vertex(Eigen::Vector3d::Zero());
  const auto found = check_topology(mesh);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(found[0], IsDefect(TopologyDefect::isolated_vertex, v.idx));
  EXPECT_TRUE(is_clean(found, Severity::degenerate));
  EXPECT_EQ(euler_characteristic(mesh), 1) << "it does not count";
}

struct Expected {
  int parts, boundary_components, genus, euler;
};
void expect_summary(const HexMesh& mesh, const Expected& expected) {
  const TopologySummary s = summarize_topology(mesh);
  EXPECT_EQ(s.n_parts, expected.parts);
  EXPECT_EQ(s.n_boundary_components, expected.boundary_components);
  EXPECT_EQ(s.genus, expected.genus);
  EXPECT_EQ(s.euler_characteristic, expected.euler);
  EXPECT_EQ(euler_characteristic(mesh), expected.euler);
  EXPECT_EQ(s.n_boundary_edges, 2 * s.n_boundary_faces) << "a closed surface of quads";
}

TEST(Summary, KnowsBallsToriAndCavities) {
  expect_summary(make_grid({3, 2, 2}), {1, 1, 0, 1});
  expect_summary(make_torus(), {1, 1, 1, 0});
  expect_summary(make_torus({.round_section = false}), {1, 1, 1, 0});
  expect_summary(make_octree_like(Shape::double_torus, 16), {1, 1, 2, -1});
  expect_summary(make_hollow_box(), {1, 2, -1, 2});  // a cavity takes one away
  expect_summary(make_two_boxes(), {2, 2, 0, 2});
  expect_summary(HexMesh(), {0, 0, 0, 0});
}

// Points and hexahedra of a legacy VTK file in ASCII.
HexMesh read_points_and_cells(const std::filesystem::path& path) {
  std::ifstream in(path);
  HexMesh mesh;
  std::string word;
  int n = 0, k = 0;
  while (in >> word && word != "CELL_TYPES") {
    if (word == "POINTS") {
      in >> n >> word;
      for (Eigen::Vector3d p; n > 0 && in >> p.x() >> p.y() >> p.z(); --n) mesh.add_vertex(p);
    } else if (word == "CELLS") {
      in >> n >> k;
      for (CellVertices c; n > 0 && in >> k; --n) {
        for (VertexHandle& v : c) in >> v.idx;
        mesh.add_cell(c);
      }
    }
  }
  return mesh;
}

TEST(Check, FindsNothingInRealMeshes) {
  namespace fs = std::filesystem;
  const fs::path data = HEXWEFT_SHARED_DATA;
  if (!fs::exists(data)) GTEST_SKIP() << "no meshes in " << data;
  int n = 0;
  for (const char* name : {"octree/block.vtk", "octree/eight.vtk", "octree/fandisk.vtk",
                           "polycube/hollow-eight.vtk", "polycube/fancy_ring.vtk"}) {
    if (!fs::exists(data / name)) continue;
    EXPECT_THAT(check_topology(read_points_and_cells(data / name)), IsEmpty()) << name;
    ++n;
  }
  EXPECT_GT(n, 0);
}

}  // namespace
}  // namespace hexweft
