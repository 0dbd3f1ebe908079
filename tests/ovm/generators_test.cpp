#include "ovm/generators.h"

#include <gmock/gmock.h>

#include "ovm/errors.h"
#include "ovm/quality.h"
#include "ovm/topology_check.h"
#include "ovm/topology_summary.h"
#include "tests/mesh_families.h"
#include "tests/ovm/mesh_dump.h"

namespace hexweft {
namespace {

using Eigen::Vector3d;

class EveryMeshFamily : public testing::TestWithParam<MeshFamily> {};
INSTANTIATE_TEST_SUITE_P(, EveryMeshFamily, testing::ValuesIn(mesh_families()), family_name);

TEST_P(EveryMeshFamily, IsMadeTheSameTwice) {
  EXPECT_TRUE(MeshDump(GetParam().make()) == MeshDump(GetParam().make()));
}

int n_singular_edges(const HexMesh& mesh) {
  int n = 0;
  for (EdgeHandle e : mesh.edges()) n += mesh.valence(e) != (mesh.is_boundary(e) ? 2 : 4);
  return n;
}

TEST(Grid, IsNumberedXFastest) {
  const Eigen::AlignedBox3d box(Vector3d(-1, 0, 0), Vector3d(1, 3, 1));
  const HexMesh mesh = make_grid({2, 3, 4}, box);
  EXPECT_EQ(mesh.point(VertexHandle(1 + 3 * (2 + 4 * 2))), Vector3d(0, 2, 0.5));
  EXPECT_EQ(mesh.vertices(CellHandle(1 + 2 * (2 + 3 * 3)))[0], VertexHandle(1 + 3 * (2 + 4 * 3)));
  EXPECT_NEAR(summarize_quality(mesh).total_volume, 6, 1e-12);
  EXPECT_THROW(make_grid({2, 0, 1}), InputError);
}

TEST(OGrid, HasFourSingularLinesInside) {
  const HexMesh mesh = make_o_grid({.n_core = 3, .n_ring = 2, .n_layers = 5});
  EXPECT_EQ(mesh.n_cells(), 5 * (9 + 2 * 12));
  int n_inside = 0;
  for (EdgeHandle e : mesh.edges()) {
    if (mesh.is_boundary(e) || mesh.valence(e) == 4) continue;
    EXPECT_EQ(mesh.valence(e), 3);
    ++n_inside;
  }
  EXPECT_EQ(n_inside, 4 * 5);
}

TEST(Torus, HasClosedSingularLinesOnly) {
  for (bool round_section : {false, true}) {
    const HexMesh mesh = make_torus({.n_around = 12, .round_section = round_section});
    for (VertexHandle v : mesh.vertices()) {
      int n = 0;
      for (EdgeHandle e : mesh.edges(v)) n += mesh.valence(e) != (mesh.is_boundary(e) ? 2 : 4);
      EXPECT_TRUE(n == 0 || n == 2);
    }
    EXPECT_EQ(n_singular_edges(mesh), 4 * 12);
  }
  EXPECT_THROW(make_torus({.minor_radius = 4}), InputError);
}

TEST(Voxels, AreFilledToAManifoldOnlyWhereNeeded) {
  VoxelSet good({3, 3, 3}, [](int x, int y, int) { return x < 2 || y < 1; });
  const auto before = good.filled;
  fill_to_manifold(good);
  EXPECT_EQ(good.filled, before);
  VoxelSet bad({4, 4, 4}, [](int x, int y, int z) { return (x * 7 + y * 5 + z * 3) % 4 == 0; });
  EXPECT_FALSE(is_valid(make_voxels(bad)));
  fill_to_manifold(bad);
  EXPECT_TRUE(is_valid(make_voxels(bad)));
}

class EveryShape : public testing::TestWithParam<Shape> {};
INSTANTIATE_TEST_SUITE_P(, EveryShape, testing::ValuesIn(kShapes), [](const auto& param_info) {
  std::string id(name(param_info.param));
  std::replace(id.begin(), id.end(), '-', '_');
  return id;
});

TEST_P(EveryShape, OctreeLikeMeshIsValidAndOnTheSurface) {
  const int genus = GetParam() == Shape::double_torus                                    ? 2
                    : GetParam() == Shape::torus || GetParam() == Shape::block_with_hole ? 1
                                                                                         : 0;
  for (int resolution : {6, 11, 16, 20}) {
    const HexMesh mesh = make_octree_like(GetParam(), resolution, 2);
    EXPECT_THAT(check_topology(mesh), testing::IsEmpty());
    EXPECT_GT(min_scaled_jacobian(mesh), 0) << "resolution " << resolution;
    if (resolution < 16) continue;
    EXPECT_GT(n_singular_edges(mesh), 100);
    EXPECT_EQ(summarize_topology(mesh).n_parts, 1);
    EXPECT_EQ(summarize_topology(mesh).genus, genus);
    int n_boundary = 0, n_off = 0;
    for (VertexHandle v : mesh.vertices()) {
      if (!mesh.is_boundary(v)) continue;
      ++n_boundary;
      n_off += std::abs(signed_distance_like(GetParam(), mesh.point(v), 2)) > 1e-3;
    }
    EXPECT_LT(n_off, 0.05 * n_boundary) << "resolution " << resolution;
  }
}

TEST(RandomSheets, AddSingularEdgesAndKeepTheMeshValid) {
  int n_inserted = 0;
  for (unsigned seed = 0; seed < 4; ++seed) {
    HexMesh mesh = make_grid({6, 6, 6});
    const int before = n_singular_edges(mesh);
    const int n = insert_random_sheets(mesh, 5, seed);
    EXPECT_LE(n, 5);
    EXPECT_GT(n_singular_edges(mesh), before);
    EXPECT_THAT(check_topology(mesh), testing::IsEmpty());
    EXPECT_GT(min_scaled_jacobian(mesh), 0);
    EXPECT_EQ(summarize_topology(mesh).genus, 0);
    n_inserted += n;
  }
  EXPECT_GE(n_inserted, 10);
}

TEST(OctreeLike, RefusesTooCoarse) { EXPECT_THROW(make_octree_like(Shape::sphere, 3), InputError); }

}  // namespace
}  // namespace hexweft
