// Smoothing a whole mesh.
#include "optimize/smooth.h"

#include <gtest/gtest.h>

#include "optimize/hausdorff.h"
#include "ovm/quality.h"
#include "tests/optimize/test_meshes.h"

namespace hexweft {
namespace {

TEST(Smooth, NeverLowersTheLeastScaledJacobianNorLeavesTheSurface) {
  for (Shape shape : kShapes) {
    HexMesh mesh = make_octree_like(shape, 8, 1);
    const auto reference = make_reference_surface(mesh);
    const double before = min_scaled_jacobian(mesh);
    const SmoothingReport r = smooth(mesh, reference, {.local_trials = 20});
    EXPECT_GE(r.min_scaled_jacobian, before - 1e-12) << name(shape);
    EXPECT_NEAR(r.min_scaled_jacobian, min_scaled_jacobian(mesh), 1e-12);
    EXPECT_NEAR(r.hausdorff_rel, hausdorff_distance(mesh, reference).ratio(), 1e-12);
    EXPECT_LE(r.hausdorff_rel, 0.01) << name(shape);
  }
}

TEST(Smooth, BringsAPerturbedGridBack) {
  HexMesh mesh = make_grid({5, 5, 5});
  const auto reference = make_reference_surface(mesh);
  perturb(mesh, 0.4, false, 2);
  const SmoothingReport r = smooth(mesh, reference);
  EXPECT_GT(r.min_scaled_jacobian, 0.98);
  EXPECT_LT(r.hausdorff_rel, 1e-4);
}

TEST(Smooth, DoesNothingItIsNotAllowedTo) {
  HexMesh mesh = make_octree_like(Shape::blob, 8, 1);
  const auto before = points_of(mesh);
  const SmoothingReport r = smooth(mesh, make_reference_surface(mesh),
                                   {.global_rounds = 0, .mean_rounds = 0, .local_trials = 0});
  EXPECT_EQ(r.trials, 0);
  EXPECT_EQ(points_of(mesh), before);
  EXPECT_EQ(r.min_scaled_jacobian, r.initial_min_scaled_jacobian);
}

TEST(Smooth, GainsWhereTheWholeMoveWouldLeaveTheLimit) {
  for (Shape shape : {Shape::sphere, Shape::blob}) {
    HexMesh mesh = make_octree_like(shape, 8, 1);
    const auto reference = make_reference_surface(mesh);
    const SmoothingReport r =
        smooth(mesh, reference, {.hausdorff_limit_rel = 1e-3, .local_trials = 30});
    EXPECT_GT(r.min_scaled_jacobian, r.initial_min_scaled_jacobian + 2e-3) << name(shape);
    EXPECT_GE(r.mean_scaled_jacobian, r.initial_mean_scaled_jacobian - 1e-12) << name(shape);
    EXPECT_LE(r.hausdorff_rel, 1e-3) << name(shape);
  }
}

TEST(Smooth, WholeMeshPassesGoOnWhereOneSideIsAtTheLimit) {
  for (Shape shape : {Shape::blob, Shape::torus}) {
    HexMesh mesh = make_octree_like(shape, 10, 1);
    const auto reference = make_reference_surface(mesh);
    perturb(mesh, 0.01, false, 4);
    VertexHandle highest;
    for (VertexHandle v : mesh.vertices()) {
      if (!mesh.is_boundary(v)) continue;
      if (!highest.valid() || mesh.point(v)[2] > mesh.point(highest)[2]) highest = v;
    }
    const double limit = 0.01 * reference.bounding_box_diagonal();
    mesh.set_point(highest, mesh.point(highest) + Eigen::Vector3d(0, 0, 0.95 * limit));
    const SmoothingReport r =
        smooth(mesh, reference, {.global_rounds = 1, .mean_rounds = 0, .local_trials = 0});
    EXPECT_GT(r.accepted_global, 0) << name(shape);
    EXPECT_GT(r.mean_scaled_jacobian, r.initial_mean_scaled_jacobian) << name(shape);
    EXPECT_LE(r.hausdorff_rel, 0.01) << name(shape);
  }
}

TEST(Smooth, PassesForTheMeanRaiseItAndKeepTheLeast) {
  for (Shape shape : {Shape::blob, Shape::torus}) {
    HexMesh mesh = make_octree_like(shape, 10, 1);
    perturb(mesh, 0.015, false, 4);
    const auto reference = make_reference_surface(mesh);
    const SmoothingReport r = smooth(mesh, reference, {.global_rounds = 0, .local_trials = 0});
    EXPECT_GE(r.min_scaled_jacobian, r.initial_min_scaled_jacobian - 1e-12) << name(shape);
    EXPECT_GT(r.mean_scaled_jacobian, r.initial_mean_scaled_jacobian + 0.005) << name(shape);
    EXPECT_EQ(r.accepted_local, 0);
  }
}

// One that gains nothing is the last, in later cycles too.
TEST(Smooth, PassesForTheMeanEndWhereTheyPromiseNothing) {
  for (Shape shape : {Shape::blob, Shape::torus, Shape::double_torus}) {
    SCOPED_TRACE(name(shape));
    HexMesh mesh = make_octree_like(shape, 10, 1);
    const SmoothingReport r =
        smooth(mesh, make_reference_surface(mesh),
               {.cycles = 4, .global_rounds = 0, .mean_rounds = 20, .local_trials = 0});
    EXPECT_GT(r.accepted_global, 0);
    EXPECT_LE(r.trials, r.accepted_global + 1);
  }
}

TEST(Smooth, MoreCyclesGoOnWhereOneEnds) {
  for (Shape shape : {Shape::blob, Shape::double_torus}) {
    SCOPED_TRACE(name(shape));
    const HexMesh input = make_octree_like(shape, 12, 1);
    const auto reference = make_reference_surface(input);
    HexMesh once = input, often = input;
    const SmoothingReport one = smooth(once, reference, {.cycles = 1, .local_trials = 20}),
                          three = smooth(often, reference, {.cycles = 3, .local_trials = 20});
    EXPECT_GT(three.trials, one.trials);
    EXPECT_GE(three.min_scaled_jacobian, one.min_scaled_jacobian);
    EXPECT_GE(three.mean_scaled_jacobian, one.initial_mean_scaled_jacobian);
    EXPECT_LE(three.hausdorff_rel, 0.01);
  }
}

TEST(Smooth, NeedsNoMeasureOfADistanceThatIsKnown) {
  const HexMesh input = make_octree_like(Shape::blob, 8, 1);
  const auto reference = make_reference_surface(input);
  SmoothingOptions options = {.local_trials = 20};
  HexMesh measured = input, told = input;
  const SmoothingReport of_measured = smooth(measured, reference, options);
  options.initial_hausdorff_rel = options.hausdorff_limit_rel;
  const SmoothingReport of_told = smooth(told, reference, options);
  EXPECT_EQ(points_of(told), points_of(measured));
  EXPECT_EQ(of_told.hausdorff_rel, of_measured.hausdorff_rel);
  EXPECT_EQ(of_told.initial_hausdorff_rel, options.hausdorff_limit_rel);

  options.cycles = 1;
  std::stop_source source;
  source.request_stop();  // nothing is done: what is told of the mesh is still the truth
  options.stop = source.get_token();
  EXPECT_EQ(smooth(told, reference, options).hausdorff_rel, of_measured.hausdorff_rel);
}

TEST(Smooth, WorksWithEveryEnergyAndNeverInverts) {
  for (const Energy& energy : all_energies()) {
    HexMesh mesh = make_octree_like(Shape::blob, 8, 1);
    const auto reference = make_reference_surface(mesh);
    SmoothingOptions options = {.hausdorff_limit_rel = 0.005, .local_trials = 20};
    options.parametrization.energy = energy;
    const SmoothingReport r = smooth(mesh, reference, options);
    EXPECT_GT(r.min_scaled_jacobian, r.initial_min_scaled_jacobian) << energy.name();
    EXPECT_GE(r.mean_scaled_jacobian, r.initial_mean_scaled_jacobian) << energy.name();
    EXPECT_LE(r.hausdorff_rel, 0.005) << energy.name();
  }
}

TEST(Smooth, ASurfaceThatGivesWayLessIsNearer) {
  double nearer = 0, farther = 0;
  for (Shape shape : kShapes) {
    const HexMesh start = make_octree_like(shape, 8);
    const auto reference = make_reference_surface(start);
    SmoothingOptions of_worst = {.cycles = 1, .global_rounds = 0, .mean_rounds = 0};
    HexMesh a = start, b = start;
    of_worst.giving_way = 1;
    nearer += smooth(a, reference, of_worst).hausdorff_rel;
    of_worst.giving_way = 0.03;
    farther += smooth(b, reference, of_worst).hausdorff_rel;
  }
  EXPECT_LT(nearer, farther);
}

TEST(Smooth, StopsWhenAskedTo) {
  HexMesh mesh = make_octree_like(Shape::blob, 8, 1);
  const auto before = points_of(mesh);
  std::stop_source source;
  source.request_stop();
  const auto reference = make_reference_surface(mesh);
  EXPECT_EQ(smooth(mesh, reference, {.stop = source.get_token()}).trials, 0);
  EXPECT_EQ(points_of(mesh), before);
}

TEST(Smooth, SameInputSameBytes) {
  HexMesh a = make_octree_like(Shape::double_torus, 8), b = a;
  const auto reference = make_reference_surface(a);
  smooth(a, reference, {.local_trials = 10});
  smooth(b, reference, {.local_trials = 10});
  EXPECT_EQ(points_of(a), points_of(b));
}

TEST(Smooth, TakesAnEmptyMeshAndRefusesBadOptions) {
  HexMesh mesh, box = make_grid({1, 1, 1});
  const auto reference = make_reference_surface(box);
  EXPECT_EQ(smooth(mesh, reference).trials, 0);
  EXPECT_THROW(smooth(box, reference, {.hausdorff_limit_rel = 0}), InputError);
  EXPECT_THROW(smooth(box, reference, {.cycles = 0}), InputError);
  EXPECT_THROW(smooth(box, reference, {.giving_way = 0}), InputError);
  EXPECT_THROW(smooth(box, reference, {.giving_way = 1.1}), InputError);
  EXPECT_THROW(smooth(box, reference, {.initial_hausdorff_rel = -1}), InputError);
}

}  // namespace
}  // namespace hexweft
