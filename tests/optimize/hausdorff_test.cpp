// Distances that are known exactly.
#include "optimize/hausdorff.h"

#include <array>
#include <cmath>
#include <vector>

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
  const auto d = hausdorff_distance(inner, outer, {.limit = 0.2});
  EXPECT_NEAR(d.forward, 0.1, 1e-12);
  EXPECT_NEAR(d.backward, 0.1 * std::sqrt(3), 1e-12);
  EXPECT_NEAR(d.ratio(), 0.1 / 1.2, 1e-12);
  EXPECT_NEAR(hausdorff_distance(outer, inner, {.limit = 0.2}).forward, d.backward, 1e-15);
}

TEST(HausdorffDistance, IsTheSameInAnyUnitOfLength) {
  const HexMesh ball = make_ball(4), finer = make_ball(7);
  const auto ratio = [&](double unit) {
    HexMesh a = ball, b = finer;
    for (HexMesh* mesh : {&a, &b}) {
      for (VertexHandle v : mesh->vertices()) mesh->set_point(v, unit * mesh->point(v));
    }
    return hausdorff_distance(a, make_reference_surface(b)).ratio();
  };
  for (const int power : {-140, -60, 60, 140}) EXPECT_EQ(ratio(std::ldexp(1, power)), ratio(1));
}

// A plate of four by four squares a side, and the same plate of larger triangles round a small hole in
// its top: what is farthest is the middle of a square.
TEST(HausdorffDistance, IsLookedForAsCloselyAsTheLimitIsSmall) {
  const HexMesh plate = make_grid(
      {4, 4, 1}, Eigen::AlignedBox3d(Eigen::Vector3d(0, 0, -0.2), Eigen::Vector3d(1, 1, 0)));
  const double w = 0.002, x = 0.43, y = 0.29;
  Eigen::Matrix3Xd points(3, 12);
  points << 0, 1, 1, 0, 0, 1, 1, 0, x - w, x + w, x + w, x - w,  //
      0, 0, 1, 1, 0, 0, 1, 1, y - w, y - w, y + w, y + w,        //
      0, 0, 0, 0, -0.2, -0.2, -0.2, -0.2, 0, 0, 0, 0;
  std::vector<std::array<int, 3>> triangles;
  const auto add = [&](int a, int b, int c, int d) {
    triangles.push_back({a, b, c});
    triangles.push_back({c, d, a});
  };
  add(7, 6, 5, 4);
  for (int i = 0, j = 1; i < 4; ++i, j = (i + 1) % 4) {
    add(i, j, 8 + j, 8 + i);
    add(4 + i, 4 + j, j, i);
  }
  const ReferenceSurface holed(points, triangles);
  const double exact = w / holed.bounding_box_diagonal();
  EXPECT_NEAR(hausdorff_ratio(plate, holed, exact), exact, 0.1 * exact);
  EXPECT_FALSE(is_within(plate, holed, 0.8 * w));
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
  EXPECT_THROW(farthest_point(s, s, {.limit = 0}), InputError);
}

}  // namespace
}  // namespace hexweft
