// Goals of surface vertices: planes, lines, corners; how far vertices move to them.
#include "optimize/surface_constraint.h"

#include <cmath>

#include <gtest/gtest.h>

#include "optimize/hausdorff.h"
#include "optimize/local_parametrization.h"
#include "optimize/untangle.h"
#include "tests/optimize/test_meshes.h"

namespace hexweft {
namespace {

const Eigen::AlignedBox3d kBox(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 1, 1));

int ends(const Eigen::Vector3d& p, double tolerance) {
  int n = 0;
  for (double x : p) n += std::abs(x) < tolerance || std::abs(x - 1) < tolerance ? 1 : 0;
  return n;
}

TEST(SurfaceConstraint, VerticesOfACubeSlideOnFacesAndEdgesAndStayInCorners) {
  const HexMesh cube = make_grid({5, 5, 5}, kBox);
  const ReferenceSurface reference = make_reference_surface(make_grid({9, 9, 9}, kBox));
  HexMesh moved = cube;
  perturb(moved, 0.02, true, 7);
  for (auto treatment : {SurfaceTreatment::project, SurfaceTreatment::fit}) {
    const Region region = make_region(moved, all_cells(moved));
    const auto goals = surface_goals(region, reference, {.treatment = treatment});
    ASSERT_EQ(goals.size(), region.surface.size());
    for (std::size_t i = 0; i < goals.size(); ++i) {
      ASSERT_EQ(goals[i].vertex, region.surface[i]);
      const int n = ends(cube.point(region.vertices[goals[i].vertex]), 1e-12);
      EXPECT_NEAR(goals[i].fixed.trace(), n, 1e-9);
      EXPECT_LT((goals[i].fixed * goals[i].fixed - goals[i].fixed).norm(), 1e-9);
      if (n > 1 || treatment == SurfaceTreatment::project) {
        EXPECT_GE(ends(goals[i].point, 1e-9), n);
      }
    }
  }
}

TEST(SurfaceConstraint, WithoutLinesTheTangentPlanesTellEdgesAndCorners) {
  HexMesh cube = make_grid({5, 5, 5}, kBox);
  const ReferenceSurface reference = make_reference_surface(cube, 40, {.mode = FeatureMode::off});
  const Region region = make_region(cube, all_cells(cube));
  for (const SurfaceGoal& goal : surface_goals(region, reference, {})) {
    EXPECT_NEAR(goal.fixed.trace(), ends(region.points.col(goal.vertex), 1e-12), 1e-9);
  }
}

TEST(SurfaceConstraint, AVertexBesideALineStaysOnItsOwnFace) {
  // Rows of vertices a hundredth away from the cube's edges.
  HexMesh cube = make_grid({6, 6, 6}, kBox);
  const ReferenceSurface reference = make_reference_surface(cube);
  for (VertexHandle v : cube.vertices()) {
    Eigen::Vector3d p = cube.point(v);
    for (double& x : p) {
      if (std::abs(x - 1.0 / 6) < 1e-9) x = 0.01;
      if (std::abs(x - 5.0 / 6) < 1e-9) x = 0.99;
    }
    cube.set_point(v, p);
  }
  const Region region = make_region(cube, all_cells(cube));
  for (const SurfaceGoal& goal : surface_goals(region, reference, {})) {
    EXPECT_NEAR(goal.fixed.trace(), ends(region.points.col(goal.vertex), 1e-12), 1e-9);
    EXPECT_LT((goal.point - region.points.col(goal.vertex)).norm(), 1e-12);
  }
}

TEST(SurfaceConstraint, AMovedCylinderComesBackToItsRims) {
  const HexMesh cylinder = make_o_grid({.n_core = 4, .n_ring = 3, .n_layers = 6});
  const ReferenceSurface reference = make_reference_surface(cylinder);
  HexMesh moved = cylinder;
  perturb(moved, 0.03, true, 3);
  ASSERT_TRUE(parametrize(moved, all_cells(moved), reference).valid());
  EXPECT_LT(hausdorff_distance(moved, reference).ratio(), 0.012);
  for (const FeatureLine& line : reference.curves().features().lines) EXPECT_TRUE(line.closed);
  for (VertexHandle v : cylinder.vertices()) {
    const Eigen::Vector3d p = cylinder.point(v);
    const bool rim = p.head<2>().norm() > 1 - 1e-9 && std::abs(std::abs(p[2] - 1) - 1) < 1e-9;
    if (!rim) continue;
    EXPECT_LT(reference.curves().closest_within(moved.point(v), 1).distance, 1e-9);
  }
}

TEST(SurfaceConstraint, FittedChainsErrToBothSidesOfACurvedLine) {
  const ReferenceSurface reference =
      make_reference_surface(make_o_grid({.n_core = 24, .n_ring = 8, .n_layers = 12}));
  const HexMesh coarse = make_o_grid({.n_core = 2, .n_ring = 2, .n_layers = 2});
  double error[2];
  for (auto treatment : {SurfaceTreatment::project, SurfaceTreatment::fit}) {
    HexMesh mesh = coarse;
    ParametrizationOptions options;
    options.surface.treatment = treatment;
    ASSERT_TRUE(parametrize(mesh, all_cells(mesh), reference, options).valid());
    error[treatment == SurfaceTreatment::fit] = hausdorff_distance(mesh, reference).ratio();
  }
  EXPECT_LT(error[1], 0.7 * error[0]);
}

TEST(SurfaceConstraint, PullsScaleWithTheEdgeLength) {
  const HexMesh cube = make_grid({2, 2, 2}, kBox);
  const ReferenceSurface reference = make_reference_surface(cube);
  const Region region = make_region(cube, all_cells(cube));
  SurfaceConstraint constraint(region, reference);
  const auto goals = constraint.goals(region);
  std::vector<VertexPull> pulls;
  constraint.pulls(region.points, goals, 8, pulls);
  ASSERT_EQ(pulls.size(), goals.size());
  for (std::size_t i = 0; i < pulls.size(); ++i) {
    EXPECT_EQ(pulls[i].vertex, goals[i].vertex);
    EXPECT_LT((pulls[i].metric - 8 / 0.25 * goals[i].fixed).norm(), 1e-9);
  }
}

TEST(SurfaceConstraint, AMoveEndsBeforeAHexahedronInverts) {
  const HexMesh cube = make_grid({3, 3, 3}, kBox);
  Region region = make_region(cube, all_cells(cube));
  std::vector<SurfaceGoal> goals;
  for (int v : region.surface) {  // everything through the opposite side
    const Eigen::Vector3d p = region.points.col(v);
    goals.push_back({v, Eigen::Vector3d(0.5, 0.5, 0.5) - 2 * (p - Eigen::Vector3d(0.5, 0.5, 0.5)),
                     Eigen::Matrix3d::Identity()});
  }
  const ReferenceSurface reference = make_reference_surface(cube);
  const SurfaceConstraint constraint(region, reference);
  EXPECT_LT(constraint.move_to_goals(region, goals, 0.15), 1);
  for (double sj : scaled_jacobians(region.points, region.hexes)) EXPECT_GE(sj, 0.15);
}

// What one vertex that is put back does to its hexahedra puts back the next one.
TEST(SurfaceConstraint, AMoveEndsBeforeAHexahedronInvertsHoweverManyHaveToStay) {
  const HexMesh plate = make_grid({24, 24, 1});
  std::vector<CellHandle> inner;
  for (CellHandle c : plate.cells()) {
    const int i = c.idx % 24, j = c.idx / 24;
    if (i > 0 && i < 23 && j > 0 && j < 23) inner.push_back(c);
  }
  const ReferenceSurface reference = make_reference_surface(plate);
  for (const double edges : {0.5, 0.9, 2.0, 5.0}) {
    Region region = make_region(plate, inner);
    std::vector<SurfaceGoal> goals;
    for (int v : region.surface) {
      goals.push_back({v, region.points.col(v) + Eigen::Vector3d(edges, 0.3 * edges, 0),
                       Eigen::Matrix3d::Identity()});
    }
    const SurfaceConstraint constraint(region, reference);
    constraint.move_to_goals(region, goals, 0);
    for (double sj : scaled_jacobians(region.points, region.hexes)) ASSERT_GE(sj, 0) << edges;
  }
}

// Where all quads at a vertex are flat it has no normal.
TEST(SurfaceConstraint, GoalsAreFiniteWhereVerticesCoincide) {
  HexMesh mesh = make_grid({6, 6, 6}, kBox);
  for (VertexHandle v : mesh.vertices()) {
    const Eigen::Vector3d p = mesh.point(v), from_middle = p - Eigen::Vector3d(0.5, 0.5, 1);
    if (from_middle.lpNorm<Eigen::Infinity>() < 0.2) mesh.set_point(v, {0.5, 0.5, 1});
  }
  const ReferenceSurface reference = make_reference_surface(mesh);
  for (const SurfaceTreatment treatment : {SurfaceTreatment::project, SurfaceTreatment::fit}) {
    const Region region = make_region(mesh, all_cells(mesh));
    for (const SurfaceGoal& g : surface_goals(region, reference, {.treatment = treatment}))
      EXPECT_TRUE(g.point.allFinite());
    HexMesh untangled = mesh;
    ParametrizationOptions options;
    options.surface.treatment = treatment;
    EXPECT_EQ(untangle(untangled, reference, options), 0);
  }
}

}  // namespace
}  // namespace hexweft
