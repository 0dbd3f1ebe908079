#include "ovm/generators_solids.h"

#include <algorithm>
#include <string>

#include <gmock/gmock.h>

#include "ovm/errors.h"
#include "ovm/generators.h"
#include "ovm/quality.h"
#include "ovm/topology_check.h"
#include "ovm/topology_summary.h"

namespace hexweft {
namespace {

using Eigen::Vector3d;

TEST(Solid, IsPutTogetherAsSets) {
  const Solid ball = ball_solid(1), box = moved(box_solid({1, 1, 1}), {1, 0, 0});
  const Solid both = intersect(ball, box), any = unite(ball, box), rest = subtract(ball, box);
  for (const Vector3d& p : {Vector3d(-0.5, 0, 0), Vector3d(0.5, 0, 0), Vector3d(1.5, 0.5, 0.5),
                            Vector3d(3, 0, 0), Vector3d(0.1, -0.9, 0)}) {
    const bool in_ball = ball.distance(p) < 0, in_box = box.distance(p) < 0;
    EXPECT_EQ(both.distance(p) < 0, in_ball && in_box);
    EXPECT_EQ(any.distance(p) < 0, in_ball || in_box);
    EXPECT_EQ(rest.distance(p) < 0, in_ball && !in_box);
  }
  EXPECT_EQ(any.box.max(), Vector3d(2, 1, 1));
  EXPECT_EQ(both.box.min(), Vector3d(0, -1, -1));
  EXPECT_FALSE(ball.sharp);
  EXPECT_TRUE(any.sharp);
}

TEST(Solid, TurnsWithItsBox) {
  const auto quarter = Eigen::Quaterniond(Eigen::AngleAxisd(EIGEN_PI / 2, Vector3d::UnitZ()));
  const Solid box = turned(box_solid({1, 2, 3}), quarter);
  EXPECT_TRUE(box.box.max().isApprox(Vector3d(2, 1, 3), 1e-12));
  EXPECT_LT(box.distance({1.9, 0.9, 2.9}), 0);
  EXPECT_GT(box.distance({0, 1.1, 0}), 0);
}

TEST(RandomRotation, IsARotationInGeneralPosition) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Eigen::Matrix3d r = random_rotation(seed).toRotationMatrix();
    EXPECT_NEAR(r.determinant(), 1, 1e-12);
    EXPECT_GT(r.cwiseAbs().minCoeff(), 0);
  }
  EXPECT_FALSE(random_rotation(1).isApprox(random_rotation(2)));
}

class EverySample : public testing::TestWithParam<SampleSolid> {};
INSTANTIATE_TEST_SUITE_P(, EverySample,
                         testing::ValuesIn(sample_solids().begin(), sample_solids().end()),
                         [](const auto& param_info) {
                           std::string id(param_info.param.name);
                           std::replace(id.begin(), id.end(), '-', '_');
                           return id;
                         });

TEST_P(EverySample, IsMeshedWithItsTopology) {
  const SampleSolid& sample = GetParam();
  const HexMesh mesh = make_octree_like(sample.make(), {.resolution = sample.least_resolution});
  EXPECT_THAT(check_topology(mesh), testing::IsEmpty());
  EXPECT_GT(min_scaled_jacobian(mesh), 0);
  const TopologySummary s = summarize_topology(mesh);
  EXPECT_EQ(s.n_parts, sample.n_parts);
  EXPECT_EQ(s.n_boundary_components, sample.n_boundary_components);
  EXPECT_EQ(s.genus, sample.genus);
}

TEST(PlateWithHoles, HasTheGenusAskedFor) {
  for (int n : {0, 1, 5}) {
    const HexMesh mesh = make_octree_like(plate_with_holes(n), {.resolution = 24});
    EXPECT_TRUE(is_valid(mesh));
    EXPECT_EQ(summarize_topology(mesh).genus, n);
  }
  EXPECT_THROW(plate_with_holes(-1), InputError);
}

// A vertex near each corner of the box, and edges of the mesh along its edges.
TEST(OctreeLikeMesh, FollowsTheSharpEdgesOfItsSolid) {
  const Vector3d half(1, 0.7, 0.5);
  const HexMesh mesh = make_octree_like(box_solid(half), {.resolution = 12});
  int n_on_edges = 0, n_on_corners = 0;
  for (VertexHandle v : mesh.vertices()) {
    const Vector3d gap = (mesh.point(v).cwiseAbs() - half).cwiseAbs();
    const auto n = (gap.array() < 0.02).count();
    n_on_edges += n >= 2;
    n_on_corners += n == 3;
  }
  EXPECT_EQ(n_on_corners, 8);
  EXPECT_GT(n_on_edges, 60);
}

TEST(OctreeLikeMesh, OfLargeVoxelsHasTheSingularEdgesOfTheVoxels) {
  const auto n_singular_vertices = [](const HexMesh& mesh) {
    int n = 0;
    for (VertexHandle v : mesh.vertices()) {
      int at_vertex = 0;
      for (EdgeHandle e : mesh.edges(v)) {
        at_vertex += mesh.valence(e) != (mesh.is_boundary(e) ? 2 : 4);
      }
      n += at_vertex > 2;
    }
    return n;
  };
  const Solid ball = ball_solid(1);
  const HexMesh fine = make_octree_like(ball, {.resolution = 8, .cells_per_voxel = 3});
  const HexMesh coarse = make_octree_like(ball, {.resolution = 8});
  EXPECT_TRUE(is_valid(fine));
  EXPECT_GT(min_scaled_jacobian(fine), 0);
  EXPECT_EQ(n_singular_vertices(fine), n_singular_vertices(coarse));
  EXPECT_GT(fine.n_cells(), 12 * coarse.n_cells());
  EXPECT_THROW(make_octree_like(ball, {.cells_per_voxel = 0}), InputError);
}

TEST(OctreeLikeMesh, RefusesASolidThatNoVoxelMeets) {
  const Solid nothing{[](const Vector3d&) { return 1.0; },
                      Eigen::AlignedBox3d(Vector3d(0, 0, 0), Vector3d(1, 1, 1))};
  EXPECT_THROW(make_octree_like(nothing), InputError);
}

TEST(AppendCopy, MakesPartsOfTheirOwn) {
  HexMesh mesh = make_grid({2, 1, 1});
  append_copy(mesh, make_torus(), {9, 0, 0});
  append_copy(mesh, mesh, {0, 9, 0});
  EXPECT_TRUE(is_valid(mesh));
  EXPECT_EQ(summarize_topology(mesh).n_parts, 4);
  EXPECT_EQ(summarize_topology(mesh).genus, 2);
}

TEST(Transform, MovesEveryVertex) {
  HexMesh mesh = make_grid({1, 1, 1});
  transform(mesh, Eigen::Translation3d(1, 2, 3) * Eigen::Scaling(2.0) * random_rotation(4));
  EXPECT_EQ(mesh.point(VertexHandle(0)), Vector3d(1, 2, 3));
  EXPECT_NEAR(summarize_quality(mesh).total_volume, 8, 1e-12);
}

}  // namespace
}  // namespace hexweft
