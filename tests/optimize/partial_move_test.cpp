// What is left of a move that goes too far.
#include "optimize/partial_move.h"

#include <gtest/gtest.h>

#include "optimize/hausdorff.h"
#include "ovm/transaction.h"
#include "tests/optimize/test_meshes.h"

namespace hexweft {
namespace {

struct Fixture {
  HexMesh mesh = make_ball(6);
  ReferenceSurface reference = make_reference_surface(mesh);
  SurfaceDistance distance{mesh, reference};
  Region before = make_region(mesh, all_cells(mesh));
  std::vector<double> quality = scaled_jacobians(before.points, before.hexes);
};

/// Of the ball. \param end  of the x axis, 1 or -1
VertexHandle boundary_vertex_at_end(const HexMesh& mesh, double end) {
  VertexHandle last;
  for (VertexHandle v : mesh.vertices()) {
    if (mesh.is_boundary(v) && end * mesh.point(v)[0] > 0.99) last = v;
  }
  return last;
}

TEST(PartialMove, KeepsAllOfAMoveThatFits) {
  Fixture f;
  perturb(f.mesh, 0.01, true, 1);
  const auto moved = points_of(f.mesh);
  EXPECT_TRUE(keep_what_fits(f.mesh, f.before, f.distance, {-1, 1}));
  EXPECT_EQ(points_of(f.mesh), moved);
  EXPECT_GT(f.distance.distance(), 1e-4);
}

TEST(PartialMove, TakesBackWhatInverts) {
  Fixture f;
  perturb(f.mesh, 0.3, false, 2);
  ASSERT_LT(min_scaled_jacobian(f.mesh), 0);
  const double least = *std::min_element(f.quality.begin(), f.quality.end());
  EXPECT_TRUE(keep_what_fits(f.mesh, f.before, f.distance, {least, 1}));
  EXPECT_GE(min_scaled_jacobian(f.mesh), least - 1e-12);
}

TEST(PartialMove, TakesBackOnlyWhereTheSurfaceLeavesTheLimit) {
  Fixture f;
  const double limit = 0.02;
  const VertexHandle far = boundary_vertex_at_end(f.mesh, 1);
  const VertexHandle near = boundary_vertex_at_end(f.mesh, -1);
  ASSERT_TRUE(far.valid() && near.valid());
  f.mesh.set_point(far, 1.1 * f.mesh.point(far));
  f.mesh.set_point(near, 1.01 * f.mesh.point(near));
  const Eigen::Vector3d near_goal = f.mesh.point(near);
  EXPECT_TRUE(keep_what_fits(f.mesh, f.before, f.distance, {-1, limit}));
  EXPECT_LE(f.distance.distance(), limit);
  EXPECT_EQ(f.mesh.point(near), near_goal);
  EXPECT_LT(f.mesh.point(far).norm(), 1.03);
}

TEST(PartialMove, LetsAFarSideStayWhereTheRestMoves) {
  Fixture f;
  const VertexHandle far = boundary_vertex_at_end(f.mesh, 1);
  const VertexHandle near = boundary_vertex_at_end(f.mesh, -1);
  ASSERT_TRUE(far.valid() && near.valid());
  f.mesh.set_point(far, 1.05 * f.mesh.point(far));
  f.distance.after_change(f.mesh);
  f.distance.commit();
  const double limit = 0.5 * f.distance.distance();
  f.before = make_region(f.mesh, all_cells(f.mesh));
  const Eigen::Vector3d far_away = f.mesh.point(far);
  const Eigen::Vector3d near_goal = 1.001 * f.mesh.point(near);
  f.mesh.set_point(near, near_goal);
  f.mesh.set_point(far, 1.01 * far_away);
  EXPECT_TRUE(keep_what_fits(f.mesh, f.before, f.distance, {-1, limit}));
  EXPECT_EQ(f.mesh.point(near), near_goal);
  EXPECT_EQ(f.mesh.point(far), far_away);  // the farther it goes, the worse
}

TEST(PartialMove, HoldsALimitBetweenTheSamples) {
  int taken_back = 0;
  for (int seed = 1; seed <= 6; ++seed) {
    Fixture f;
    perturb(f.mesh, 0.02, true, seed);
    const auto moved = points_of(f.mesh);
    const double limit = 0.97 * hausdorff_distance(f.mesh, f.reference).distance();
    EXPECT_TRUE(keep_what_fits(f.mesh, f.before, f.distance, {-1, 1, limit}));
    EXPECT_TRUE(is_within(f.mesh, f.reference, limit)) << seed;
    taken_back += points_of(f.mesh) != moved;
  }
  EXPECT_EQ(taken_back, 6);
}

TEST(PartialMove, OfWhatIsNotWorthKeepingNothingIsKept) {
  Fixture f;
  const double before = f.distance.distance();
  Transaction trial(f.mesh);
  perturb(f.mesh, 0.02, true, 3);
  const double least = min_scaled_jacobian(f.mesh);
  const auto is_worth = [&](double wanted) {
    return [wanted](const std::vector<double>& sj) {
      return *std::min_element(sj.begin(), sj.end()) >= wanted;
    };
  };
  EXPECT_FALSE(keep_what_fits(f.mesh, f.before, f.distance, {-1, 1}, is_worth(least + 1e-9)));
  EXPECT_EQ(f.distance.distance(), before);
  EXPECT_TRUE(keep_what_fits(f.mesh, f.before, f.distance, {-1, 1}, is_worth(least - 1e-9)));
  EXPECT_GT(f.distance.distance(), before);
}

TEST(PartialMove, LeavesTheDistanceToBeCommittedOrRolledBack) {
  Fixture f;
  const double before = f.distance.distance();
  {
    Transaction trial(f.mesh);
    perturb(f.mesh, 0.02, true, 3);
    EXPECT_TRUE(keep_what_fits(f.mesh, f.before, f.distance, {-1, 1}));
    f.distance.rollback();
  }
  EXPECT_EQ(f.distance.distance(), before);
}

}  // namespace
}  // namespace hexweft
