// Relaxing a region of a mesh on its surface.
#include "optimize/local_parametrization.h"

#include <cmath>

#include <gtest/gtest.h>

#include "optimize/hausdorff.h"
#include "ovm/neighborhood.h"
#include "ovm/transaction.h"
#include "tests/optimize/test_meshes.h"

namespace hexweft {
namespace {

TEST(Region, PutsFreeVerticesFirstAndTheRimLast) {
  const HexMesh mesh = make_grid({4, 4, 4});
  const CellHandle seed[1] = {CellHandle(0)};
  const auto cells = grow_cells(mesh, seed, 1);
  EXPECT_EQ(cells.size(), 8u);
  const Region region = make_region(mesh, cells);
  EXPECT_EQ(region.n_free, 8);  // those with all coordinates 0 or 1
  EXPECT_EQ(region.vertices.size(), 27u);
  EXPECT_EQ(region.quads.size(), 12u);
  EXPECT_EQ(region.surface.size(), 7u);
  for (int v = 0; v < region.n_free; ++v) EXPECT_LE(region.points.col(v).maxCoeff(), 1);
}

TEST(Region, RefusesDeadAndRepeatedCells) {
  HexMesh mesh = make_grid({2, 2, 2});
  const CellHandle twice[2] = {CellHandle(1), CellHandle(1)};
  EXPECT_THROW(make_region(mesh, twice), InputError);
  mesh.delete_cell(CellHandle(1));
  EXPECT_THROW(make_region(mesh, {twice, 1}), InputError);
}

TEST(TargetCuboids, AreTheCellsThemselvesOnAGrid) {
  const HexMesh mesh = make_grid(
      {3, 3, 3}, Eigen::AlignedBox3d(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(3, 6, 1.5)));
  for (const TargetCuboid& t : target_cuboids(make_region(mesh, all_cells(mesh)), {})) {
    EXPECT_LT((t.lengths - Eigen::Vector3d(1, 2, 0.5)).norm(), 1e-12);
  }
}

TEST(TargetCuboids, SpreadAStretchedLayerOverItsNeighbors) {
  HexMesh mesh = make_grid({9, 1, 1});
  for (VertexHandle v : mesh.vertices()) {
    if (mesh.point(v)[0] > 4.5) mesh.set_point(v, mesh.point(v) + Eigen::Vector3d(2, 0, 0));
  }
  const auto targets =
      target_cuboids(make_region(mesh, all_cells(mesh)), {.size_blend = 1, .blend_passes = 1});
  EXPECT_NEAR(targets[4].lengths[0], 5. / 3, 1e-12);
  EXPECT_NEAR(targets[3].lengths[0], 5. / 3, 1e-12);
  EXPECT_NEAR(targets[0].lengths[0], 1, 1e-12);
}

TEST(Parametrize, WithoutABarrierStillNeverInverts) {
  for (const Energy& energy : {Energy(Arap{}), Energy(FoldoverFree{})}) {
    HexMesh mesh = make_octree_like(Shape::blob, 8, 1);
    perturb(mesh, 0.01, false, 3);
    ASSERT_GT(min_scaled_jacobian(mesh), 0);
    const auto reference = make_reference_surface(mesh);
    const ParametrizationReport r =
        parametrize(mesh, all_cells(mesh), reference, {.energy = energy});
    EXPECT_TRUE(r.valid()) << energy.name();
    EXPECT_GT(min_scaled_jacobian(mesh), 0) << energy.name();
  }
}

TEST(Parametrize, KeepsTheRimAndImprovesTheRegion) {
  HexMesh mesh = make_octree_like(Shape::blob, 12, 1);
  const auto reference = make_reference_surface(mesh);
  perturb(mesh, 0.02, true, 2);
  const HexMesh before = mesh;
  const CellHandle seed[1] = {CellHandle(40)};
  const auto cells = grow_cells(mesh, seed, 3);
  const Region region = make_region(mesh, cells);
  const ParametrizationReport r = parametrize(mesh, cells, reference);
  EXPECT_TRUE(r.valid());
  double mean_before = 0;
  for (double sj : scaled_jacobians(region.points, region.hexes)) mean_before += sj;
  EXPECT_GT(r.mean_scaled_jacobian, mean_before / static_cast<double>(region.hexes.size()));
  EXPECT_GE(r.min_scaled_jacobian, 0.9 * r.initial_min_scaled_jacobian);
  EXPECT_GT(r.max_move, 0);
  std::vector<char> free(mesh.vertex_slots(), 0);
  for (int i = 0; i < region.n_free; ++i) free[region.vertices[i].idx] = 1;
  for (VertexHandle v : mesh.vertices()) {
    if (free[v.idx]) continue;
    EXPECT_EQ(mesh.point(v), before.point(v));
  }
}

TEST(Parametrize, LeavesSurfaceVerticesOnTheReference) {
  HexMesh mesh = make_octree_like(Shape::sphere, 10);
  const auto reference = make_reference_surface(mesh);
  perturb(mesh, 0.01, true, 3);
  const ParametrizationReport r = parametrize(mesh, all_cells(mesh), reference);
  EXPECT_TRUE(r.valid());
  EXPECT_EQ(r.on_surface, 1);
  for (VertexHandle v : mesh.vertices()) {
    if (!mesh.is_boundary(v)) continue;
    EXPECT_LT(reference.closest(mesh.point(v)).distance, 1e-12);
  }
}

TEST(Parametrize, FittingHalvesTheErrorOfACoarseTorus) {
  const auto reference =
      make_reference_surface(make_torus({.n_core = 12, .n_around = 128, .n_ring = 1}));
  const HexMesh coarse = make_torus({.n_core = 3, .n_around = 32, .n_ring = 2});
  double distance[2];
  for (SurfaceTreatment treatment : {SurfaceTreatment::project, SurfaceTreatment::fit}) {
    HexMesh mesh = coarse;
    ParametrizationOptions options;
    options.surface.treatment = treatment;
    EXPECT_TRUE(parametrize(mesh, all_cells(mesh), reference, options).valid());
    distance[treatment == SurfaceTreatment::fit] = hausdorff_distance(mesh, reference).distance();
  }
  EXPECT_LT(distance[1], 0.65 * distance[0]);
}

TEST(Parametrize, KeepsTheEdgesAndCornersOfACube) {
  HexMesh mesh = make_grid({6, 6, 6});
  const auto reference = make_reference_surface(mesh);
  perturb(mesh, 0.2, false, 4);
  for (SurfaceTreatment treatment : {SurfaceTreatment::project, SurfaceTreatment::fit}) {
    ParametrizationOptions options;
    options.surface.treatment = treatment;
    EXPECT_TRUE(parametrize(mesh, all_cells(mesh), reference, options).valid());
    EXPECT_LT(hausdorff_distance(mesh, reference).ratio(), 1e-6);
  }
}

TEST(Parametrize, UntanglesInvertedStarts) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    HexMesh mesh = make_grid({6, 6, 6});
    const auto reference = make_reference_surface(mesh);
    perturb(mesh, 0.8, false, seed);
    ASSERT_LT(min_scaled_jacobian(mesh), 0);
    const ParametrizationReport r = parametrize(mesh, all_cells(mesh), reference);
    EXPECT_TRUE(r.untangled);
    EXPECT_TRUE(r.valid()) << "seed " << seed;
    EXPECT_NEAR(r.min_scaled_jacobian, min_scaled_jacobian(mesh), 1e-12);
    EXPECT_GT(r.min_scaled_jacobian, 0.8);
  }
}

TEST(Parametrize, UntanglesMeshesWithATenthOfTheirInnerVerticesThrownAbout) {
  const HexMesh meshes[] = {make_grid({8, 8, 8}), make_octree_like(Shape::blob, 12, 1),
                            make_torus({.n_core = 3, .n_around = 32, .n_ring = 2}), make_ball(6),
                            make_octree_like(Shape::double_torus, 16, 1)};
  for (const HexMesh& good : meshes) {
    const auto reference = make_reference_surface(good);
    const double length = mean_edge_length(good);
    for (unsigned seed = 1; seed <= 4; ++seed) {
      HexMesh mesh = good;
      Random random(seed);
      for (VertexHandle v : mesh.vertices()) {
        if (mesh.is_boundary(v) || random.below(10) > 0) continue;
        mesh.set_point(v, mesh.point(v) + random.in_cube(2 * length));
      }
      ASSERT_LT(min_scaled_jacobian(mesh), 0);
      EXPECT_TRUE(parametrize(mesh, all_cells(mesh), reference).valid()) << "seed " << seed;
      EXPECT_GT(min_scaled_jacobian(mesh), 0) << "seed " << seed;
    }
  }
}

TEST(Parametrize, UntanglesWhatLiesRoundAFlatPlaceWithoutTheRest) {
  const HexMesh good = make_grid({10, 10, 10});
  const auto reference = make_reference_surface(good);
  for (const double throw_by : {1.5, 30.0}) {
    HexMesh wide = good;
    for (VertexHandle v : wide.vertices()) {
      if (wide.point(v) == Eigen::Vector3d(5, 5, 5))
        wide.set_point(v, Eigen::Vector3d::Constant(5 + throw_by));
    }
    HexMesh narrow = wide;
    ParametrizationOptions options;
    const ParametrizationReport of_wide = parametrize(wide, all_cells(wide), reference, options);
    options.untangle_widely = false;
    const ParametrizationReport of_narrow =
        parametrize(narrow, all_cells(narrow), reference, options);
    EXPECT_TRUE(of_narrow.untangled);
    if (of_narrow.valid()) {
      EXPECT_EQ(points_of(narrow), points_of(wide));
    }
    EXPECT_TRUE(of_wide.valid() || !of_narrow.valid());
    EXPECT_TRUE(of_narrow.valid() || throw_by > 2);
  }
}

TEST(RegionParametrization, GoesOnFromWhereTheMeshIs) {
  const HexMesh start = make_octree_like(Shape::blob, 12, 1);
  const auto reference = make_reference_surface(start);
  const CellHandle seed[1] = {CellHandle(start.n_cells() / 2)};
  const auto region = grow_cells(start, seed, 3);
  const ParametrizationOptions fitting = {.surface = {.treatment = SurfaceTreatment::fit}};
  HexMesh once = start, again = start;
  RegionParametrization kept(again, region, reference);
  for (const ParametrizationOptions& options : {ParametrizationOptions(), fitting}) {
    for (HexMesh* mesh : {&once, &again}) {  // as a rollback would, between two runs
      const VertexHandle v = make_region(*mesh, region).vertices[0];
      mesh->set_point(v, start.point(v));
    }
    const double expected = parametrize(once, region, reference, options).min_scaled_jacobian;
    EXPECT_NEAR(kept.run(again, options).min_scaled_jacobian, expected, 1e-9);
  }
  for (VertexHandle v : start.vertices()) EXPECT_LT((once.point(v) - again.point(v)).norm(), 1e-9);
}

TEST(Parametrize, ReportsWhatItCouldNotRepair) {
  HexMesh mesh = make_grid({3, 3, 3});
  const auto reference = make_reference_surface(mesh);
  perturb(mesh, 2, false, 1);
  ParametrizationOptions options;
  options.untangling_rounds = 0;
  EXPECT_EQ(parametrize(mesh, all_cells(mesh), reference, options).failure,
            ParametrizationFailure::still_inverted);
  HexMesh ball = make_ball(4);
  options.min_scaled_jacobian = 0.99;
  EXPECT_EQ(parametrize(ball, all_cells(ball), make_reference_surface(ball), options).failure,
            ParametrizationFailure::low_quality);
}

TEST(Parametrize, DrawsVerticesToTheirGoals) {
  HexMesh mesh = make_grid({6, 6, 6});
  const auto reference = make_reference_surface(mesh);
  VertexHandle inner;
  for (VertexHandle v : mesh.vertices()) {
    if (mesh.point(v) == Eigen::Vector3d(3, 3, 3)) inner = v;
  }
  const VertexGoal goal[1] = {{inner, {3.3, 3, 3}}};
  ParametrizationOptions options;
  options.goal_weight = 1e3;
  EXPECT_TRUE(parametrize(mesh, all_cells(mesh), reference, options, goal).valid());
  EXPECT_LT((mesh.point(inner) - goal[0].point).norm(), 0.1);
}

TEST(Parametrize, DoesNotDependOnTheUnitOfLength) {
  HexMesh mesh = make_octree_like(Shape::dumbbell, 12);
  const auto reference = make_reference_surface(mesh);
  perturb(mesh, 0.02, true, 5);
  HexMesh unit = mesh;
  parametrize(unit, all_cells(unit), reference);
  for (double scale : {0x1p-10, 0x1p10}) {  // powers of two scale without rounding
    HexMesh scaled = mesh;
    Eigen::Matrix3Xd points = scale * reference.points();
    const ReferenceSurface scaled_reference(std::move(points), reference.triangles());
    for (VertexHandle v : scaled.vertices()) scaled.set_point(v, scale * mesh.point(v));
    parametrize(scaled, all_cells(scaled), scaled_reference);
    for (VertexHandle v : unit.vertices()) {
      EXPECT_LT((scaled.point(v) / scale - unit.point(v)).norm(), 1e-6);
    }
  }
}

TEST(Parametrize, SameInputSameBytesAndRollsBack) {
  HexMesh mesh = make_octree_like(Shape::torus, 12);
  const auto reference = make_reference_surface(mesh);
  perturb(mesh, 0.02, true, 6);
  HexMesh a = mesh, b = mesh;
  parametrize(a, all_cells(a), reference);
  {
    Transaction trial(b);
    parametrize(b, all_cells(b), reference);
  }
  EXPECT_EQ(points_of(b), points_of(mesh));
  parametrize(b, all_cells(b), reference);
  EXPECT_EQ(points_of(a), points_of(b));
}

TEST(Parametrize, RefusesBadOptions) {
  HexMesh mesh = make_grid({2, 2, 2});
  const auto reference = make_reference_surface(mesh);
  ParametrizationOptions options;
  options.max_iterations = 0;
  EXPECT_THROW(parametrize(mesh, all_cells(mesh), reference, options), InputError);
  options = {};
  options.surface.feature_angle_deg = 0;
  EXPECT_THROW(parametrize(mesh, all_cells(mesh), reference, options), InputError);
}

}  // namespace
}  // namespace hexweft
