// The distance kept through edits against the distance computed anew.
#include "optimize/surface_distance.h"

#include <gtest/gtest.h>

#include "optimize/hausdorff.h"
#include "ovm/edit/split_sheet.h"
#include "ovm/errors.h"
#include "ovm/transaction.h"
#include "tests/optimize/test_meshes.h"

namespace hexweft {
namespace {

constexpr double kRounding = 1e-12;

/// Moves the boundary vertices near a random one.
void dent(HexMesh& mesh, Random& random) {
  std::vector<VertexHandle> boundary;
  for (VertexHandle v : mesh.vertices()) {
    if (mesh.is_boundary(v)) boundary.push_back(v);
  }
  const Eigen::Vector3d centre =
      mesh.point(boundary[random.below(static_cast<int>(boundary.size()))]);
  for (VertexHandle v : boundary) {
    if ((mesh.point(v) - centre).norm() < 0.4)
      mesh.set_point(v, mesh.point(v) + random.in_cube(0.03));
  }
}

TEST(SurfaceDistance, StartsAtZeroOnItsOwnReference) {
  const HexMesh mesh = make_octree_like(Shape::torus, 10);
  const SurfaceDistance d(mesh, make_reference_surface(mesh));
  EXPECT_LT(d.ratio(), 1e-15);
}

TEST(SurfaceDistance, IsConservativeAndCloseToExactThroughRandomChanges) {
  HexMesh mesh = make_octree_like(Shape::blob, 10, 1);
  const auto reference = make_reference_surface(mesh);
  SurfaceDistance kept(mesh, reference);
  Random random(2);
  for (int i = 0; i < 20; ++i) {
    dent(mesh, random);
    const double changed = kept.after_change(mesh);
    EXPECT_GT(changed, 0);
    EXPECT_LE(changed, kept.distance());
    kept.commit();
    const SurfaceDistance anew(mesh, reference);
    EXPECT_NEAR(kept.forward(), anew.forward(), kRounding);
    EXPECT_GE(kept.backward(), anew.backward() - kRounding);
    EXPECT_LT(kept.backward(), 1.5 * anew.backward() + kRounding);
    EXPECT_LE(kept.distance(), 1.5 * hausdorff_distance(mesh, reference).distance());
  }
}

TEST(SurfaceDistance, WhatIsNegligibleCountsAsZeroWhereverItWasLookedForFirst) {
  HexMesh mesh = make_octree_like(Shape::blob, 10, 1);
  const auto reference = make_reference_surface(mesh);
  constexpr double kNegligible = 0.015;
  const SurfaceDistanceOptions options = {.negligible = kNegligible};
  SurfaceDistance kept(mesh, reference, options);
  Random random(7);
  int zero = 0, exact = 0;
  for (int i = 0; i < 20; ++i) {
    dent(mesh, random);
    kept.after_change(mesh);
    kept.commit();
    const SurfaceDistance all(mesh, reference), anew(mesh, reference, options);
    for (HalfFaceHandle hf : mesh.boundary_halffaces()) {
      const double d = kept.distance_at(hf);
      EXPECT_TRUE(d == 0 || d > kNegligible);
      (d == 0 ? zero : exact)++;
    }
    EXPECT_NEAR(kept.forward(), all.forward() > kNegligible ? all.forward() : 0, kRounding);
    EXPECT_EQ(kept.forward(), anew.forward());
    EXPECT_GE(kept.backward(), anew.backward() - kRounding);
    if (all.backward() > kNegligible) {
      EXPECT_NEAR(anew.backward(), all.backward(), kRounding);
    }
  }
  EXPECT_GT(zero, 0);
  EXPECT_GT(exact, 0);
}

TEST(SurfaceDistance, LimitsToTouchedCellsWithTheSameResult) {
  HexMesh mesh = make_ball(6);
  const auto reference = make_reference_surface(mesh);
  SurfaceDistance by_cells(mesh, reference), by_all(mesh, reference);
  Random random(3);
  for (int i = 0; i < 10; ++i) {
    const HexMesh before = mesh;
    dent(mesh, random);
    std::vector<CellHandle> touched;
    for (CellHandle c : mesh.cells()) {
      for (VertexHandle v : mesh.vertices(c)) {
        if (mesh.point(v) != before.point(v)) {
          touched.push_back(c);
          break;
        }
      }
    }
    EXPECT_EQ(by_cells.after_change(mesh, touched), by_all.after_change(mesh));
    EXPECT_EQ(by_cells.distance(), by_all.distance());
    by_cells.commit();
    by_all.commit();
  }
}

TEST(SurfaceDistance, LooksBetweenTheSamplesOfAChange) {
  HexMesh mesh = make_octree_like(Shape::blob, 8, 1);
  const auto reference = make_reference_surface(mesh);
  SurfaceDistance kept(mesh, reference, {.suspect_levels = 0});
  Random random(5);
  int missed = 0;  // by the samples
  for (int i = 0; i < 20; ++i) {
    Transaction trial(mesh);
    dent(mesh, random);
    for (VertexHandle v : mesh.vertices()) {  // then only what lies between vertices is far
      if (mesh.is_boundary(v)) mesh.set_point(v, reference.closest(mesh.point(v)).point);
    }
    kept.after_change(mesh);
    const double sampled = kept.distance();
    const double d = hausdorff_distance(mesh, reference).distance();
    missed += sampled < 0.99 * d;
    const HausdorffOptions finer{.points_per_triangle = 60};
    EXPECT_FALSE(kept.change_is_within(0.99 * d));
    EXPECT_TRUE(
        kept.change_is_within(1.01 * hausdorff_distance(mesh, reference, finer).distance()));
    kept.rollback();
    EXPECT_TRUE(kept.change_is_within(0));  // nothing has changed
  }
  EXPECT_GT(missed, 0);
}

TEST(SurfaceDistance, FollowsCellsThatComeAndGo) {
  HexMesh mesh = make_grid({4, 4, 4});
  const auto reference = make_reference_surface(mesh);
  SurfaceDistance kept(mesh, reference);
  for (int c : {0, 21, 63, 5}) {
    mesh.delete_cell(CellHandle(c));
    kept.after_change(mesh);
    kept.commit();
    const SurfaceDistance anew(mesh, reference);
    EXPECT_NEAR(kept.forward(), anew.forward(), kRounding);
    EXPECT_NEAR(kept.backward(), anew.backward(), kRounding);
  }
  EXPECT_NEAR(kept.distance(), 2, kRounding);  // the inner corner of the cavity
}

TEST(SurfaceDistance, GoesOnAfterCompactionAsBefore) {
  HexMesh mesh = make_ball(6), scattered = mesh;
  const auto reference = make_reference_surface(mesh);
  SurfaceDistance d(mesh, reference), of_scattered(scattered, reference);
  const auto change = [](HexMesh& m, unsigned seed) {
    Random random(seed);
    split_sheet(m, *std::next(m.edges().begin(), random.below(5)));
    dent(m, random);
  };
  for (unsigned seed = 1; seed <= 4; ++seed) {
    change(mesh, seed), change(scattered, seed);
    d.after_change(mesh), of_scattered.after_change(scattered);
    EXPECT_THROW(d.renumber({}), InputError) << "a change is open";
    d.commit(), of_scattered.commit();
    {  // sides that there are for a while
      Transaction trial(mesh);
      change(mesh, seed + 10);
      d.after_change(mesh);
      d.rollback();
    }
    d.renumber(mesh.collect_garbage());
    EXPECT_EQ(d.forward(), of_scattered.forward());
    EXPECT_EQ(d.backward(), of_scattered.backward());
    const auto sides = mesh.boundary_halffaces(), same = scattered.boundary_halffaces();
    ASSERT_EQ(sides.size(), same.size());
    for (std::size_t i = 0; i < sides.size(); ++i)
      EXPECT_EQ(d.distance_at(sides[i]), of_scattered.distance_at(same[i]));
    EXPECT_EQ(d.after_change(mesh), 0);
  }
}

TEST(SurfaceDistance, RollbackRestoresEverything) {
  HexMesh mesh = make_ball(6);
  SurfaceDistance d(mesh, make_reference_surface(mesh));
  Random random(4);
  dent(mesh, random);
  d.after_change(mesh);
  d.commit();
  const double forward = d.forward(), backward = d.backward();
  const auto by_side = d.distance_by_halfface();
  for (double limit : {1e9, 1e-3}) {
    Transaction trial(mesh);
    dent(mesh, random);
    mesh.delete_cell(CellHandle(0));
    d.after_change(mesh, limit);
    trial.rollback();
    d.rollback();
    EXPECT_EQ(d.forward(), forward);
    EXPECT_EQ(d.backward(), backward);
    EXPECT_EQ(d.distance_by_halfface(), by_side);
    for (std::size_t side = 0; side < by_side.size(); ++side) {
      EXPECT_EQ(d.distance_at(HalfFaceHandle(static_cast<int>(side))), by_side[side]);
    }
    EXPECT_EQ(d.after_change(mesh), 0);  // nothing has changed
  }
}

TEST(SurfaceDistance, GivesUpOverTheLimitAndThenRefusesToCommit) {
  HexMesh mesh = make_grid({3, 3, 3});
  SurfaceDistance d(mesh, make_reference_surface(mesh));
  Transaction trial(mesh);
  mesh.delete_cell(CellHandle(0));
  EXPECT_GT(d.after_change(mesh, 0.1), 0.1);
  EXPECT_THROW(d.commit(), InputError);
  d.rollback();
  EXPECT_LT(d.distance(), kRounding);
}

TEST(SurfaceDistance, OfAChangeIsWithoutWhatWasThereBefore) {
  HexMesh mesh = make_grid({4, 4, 4});
  SurfaceDistance d(mesh, make_reference_surface(mesh));
  const auto lift = [&](const Eigen::Vector3d& at, double by) {
    for (VertexHandle v : mesh.vertices()) {
      if (mesh.point(v) == at) mesh.set_point(v, at + Eigen::Vector3d(0, 0, by));
    }
  };
  lift({1, 1, 4}, 0.2);
  EXPECT_NEAR(d.after_change(mesh), 0.2, kRounding);
  EXPECT_NEAR(d.after_change(mesh), 0.2, kRounding) << "still since the last commit";
  d.commit();
  EXPECT_EQ(d.after_change(mesh), 0);
  lift({3, 3, 0}, -0.1);
  EXPECT_NEAR(d.after_change(mesh), 0.1, kRounding);
  EXPECT_NEAR(d.distance(), 0.2, kRounding);
  d.rollback();
  EXPECT_NEAR(d.distance(), 0.2, kRounding);
}

TEST(SurfaceDistance, TellsWhereTheSurfaceIsFar) {
  HexMesh mesh = make_grid({3, 3, 3});
  SurfaceDistance d(mesh, make_reference_surface(mesh));
  for (VertexHandle v : mesh.vertices()) {
    if (mesh.point(v) == Eigen::Vector3d(1, 1, 3)) mesh.set_point(v, {1, 1, 3.2});
  }
  d.after_change(mesh);
  const auto by_side = d.distance_by_halfface();
  int far = 0;
  for (HalfFaceHandle hf : mesh.boundary_halffaces()) {
    bool at_spike = false;
    for (VertexHandle v : mesh.vertices(hf)) at_spike |= mesh.point(v)[2] > 3.1;
    if (by_side[hf.idx] > 0.1) ++far;
    EXPECT_EQ(by_side[hf.idx] > 0.1, at_spike);
  }
  EXPECT_EQ(far, 4);
}

TEST(SurfaceDistance, TellsWhereItGaveUp) {
  HexMesh mesh = make_grid({4, 4, 4});
  const auto reference = make_reference_surface(mesh);
  SurfaceDistance kept(mesh, reference);
  const VertexHandle corner(0);
  const Eigen::Vector3d at = mesh.point(corner);
  for (const double outward : {1.0, -1.0}) {  // far from the mesh to the reference, and back
    Transaction trial(mesh);
    mesh.set_point(corner, at * (1 + outward * 0.3) - outward * Eigen::Vector3d::Constant(0.15));
    const double moved = (mesh.point(corner) - at).norm();
    kept.after_change(mesh);
    EXPECT_FALSE(kept.too_far_at());
    EXPECT_FALSE(kept.change_is_within(0.1 * moved));
    ASSERT_TRUE(kept.too_far_at());
    EXPECT_LT((*kept.too_far_at() - at).norm(), 1.0);
    kept.rollback();
    kept.after_change(mesh, 0.1 * moved);
    ASSERT_TRUE(kept.too_far_at());
    EXPECT_LT((*kept.too_far_at() - at).norm(), 1.0);
    kept.rollback();
  }
}

}  // namespace
}  // namespace hexweft
