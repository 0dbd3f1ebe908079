// Distances that are known exactly.
#include "optimize/hausdorff.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/optimize/test_meshes.h"

namespace hexweft {
namespace {

HexMesh box(double low, double high, int n) {
  return make_grid({n, n, n}, Eigen::AlignedBox3d(Eigen::Vector3d::Constant(low),
                                                  Eigen::Vector3d::Constant(high)));
}

TEST(HausdorffDistance, OfAMeshToItselfIsZero) {
  const HexMesh mesh = make_octree_like(Shape::torus, 10);
  EXPECT_LT(hausdorff_distance(mesh, make_reference_surface(mesh)).ratio(), 1e-15);
}

TEST(HausdorffDistance, OfNestedCubesIsTheirGapAndItsSpaceDiagonal) {
  const auto inner = make_reference_surface(box(0, 1, 3)),
             outer = make_reference_surface(box(-0.1, 1.1, 4));
  // Everywhere about as far: nothing can be passed over.
  const auto d = hausdorff_distance(inner, outer, {.resolution = 0.01});
  EXPECT_NEAR(d.forward, 0.1, 1e-12);
  EXPECT_NEAR(d.backward, 0.1 * std::sqrt(3), 1e-12);
  EXPECT_NEAR(d.ratio(), 0.1 / 1.2, 1e-12);
  EXPECT_NEAR(hausdorff_distance(outer, inner, {.resolution = 0.01}).forward, d.backward, 1e-15);
}

TEST(HausdorffDistance, FindsASpikeFromOneSideOnly) {
  HexMesh mesh = box(0, 1, 4);
  const auto before = make_reference_surface(mesh);
  for (VertexHandle v : mesh.vertices()) {
    if (mesh.point(v) == Eigen::Vector3d(0.5, 0.5, 1)) mesh.set_point(v, {0.5, 0.5, 1.3});
  }
  const auto d = hausdorff_distance(mesh, before);
  EXPECT_NEAR(d.forward, 0.3, 1e-12);
  EXPECT_LT(d.backward, 0.2);
  EXPECT_GT(d.backward, 0.1);
}

TEST(HausdorffDistance, OfABallToItsCoarserSelfIsAboutTheSagitta) {
  const auto fine = make_reference_surface(make_ball(32));
  const auto d = hausdorff_distance(make_ball(4), fine);
  EXPECT_GT(d.backward, 0.05);
  EXPECT_LT(d.backward, 0.2);
}

TEST(HausdorffDistance, IsTheSameHoweverCoarseTheFirstSurfaceIs) {
  HexMesh dented = box(0, 1, 16);
  Random random(6);
  for (VertexHandle v : dented.vertices())
    dented.set_point(v, dented.point(v) + random.in_cube(0.02));
  const auto to = make_reference_surface(dented);
  const double fine = farthest_point(make_reference_surface(box(0, 1, 32)), to).distance;
  for (int n : {1, 2, 3}) {
    const double coarse = farthest_point(make_reference_surface(box(0, 1, n)), to).distance;
    EXPECT_NEAR(coarse, fine, 1.5e-3 * to.bounding_box_diagonal()) << n;
  }
}

TEST(HausdorffDistance, IsNoLowerThanThatOfRandomSamples) {
  HexMesh mesh = make_octree_like(Shape::blob, 10, 2);
  const auto reference = make_reference_surface(mesh);
  perturb(mesh, 0.03, true, 3);
  const auto moved = make_reference_surface(mesh);
  const double d = farthest_point(moved, reference).distance;
  Random random(4);
  double sampled = 0;
  for (const auto& t : moved.triangles()) {
    for (int i = 0; i < 10; ++i) {
      double u = random.uniform(0, 1), v = random.uniform(0, 1);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const auto& p = moved.points();
      sampled = std::max(sampled, reference
                                      .closest(p.col(t[0]) + u * (p.col(t[1]) - p.col(t[0])) +
                                               v * (p.col(t[2]) - p.col(t[0])))
                                      .distance);
    }
  }
  EXPECT_GE(d, 0.99 * sampled);
}

TEST(HausdorffDistance, MoreSamplesNeverLowerIt) {
  HexMesh mesh = make_ball(4);
  const auto fine = make_reference_surface(make_ball(16));
  double last = 0;
  for (int n : {1, 4, 16, 64}) {
    const double d =
        hausdorff_distance(mesh, fine, {.points_per_triangle = n, .points_per_surface = 1})
            .distance();
    EXPECT_GE(d, last);
    last = d;
  }
}

TEST(HausdorffDistance, RefusesBadOptions) {
  const auto s = make_reference_surface(box(0, 1, 1));
  EXPECT_THROW(farthest_point(s, s, {.points_per_triangle = 0}), InputError);
  EXPECT_THROW(farthest_point(s, s, {.points_per_surface = -1}), InputError);
  EXPECT_THROW(farthest_point(s, s, {.resolution = 0}), InputError);
}

}  // namespace
}  // namespace hexweft
