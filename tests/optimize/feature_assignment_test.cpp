// Feature lines found again as chains of mesh edges: finer, coarser, moved and thin meshes.
#include "optimize/feature_assignment.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "ovm/dual.h"
#include "ovm/edit/split_sheet.h"
#include "tests/optimize/test_meshes.h"

namespace hexweft {
namespace {

struct Count {
  int lines = 0, corners = 0;
};

Count count(const std::vector<FeatureLabel>& labels) {
  Count n;
  for (const FeatureLabel& l : labels) {
    n.lines += l.is_line() ? 1 : 0;
    n.corners += l.is_corner() ? 1 : 0;
    EXPECT_FALSE(l.is_line() && l.is_corner());
  }
  return n;
}

const Eigen::AlignedBox3d kBox(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 1, 1));

TEST(FeatureAssignment, EveryVertexOnAnEdgeOfACubeHasItsLine) {
  const HexMesh cube = make_grid({4, 4, 4}, kBox);
  const ReferenceSurface reference = make_reference_surface(cube);
  const auto labels = feature_of(reference, cube);
  ASSERT_EQ(static_cast<int>(labels.size()), cube.vertex_slots());
  for (VertexHandle v : cube.vertices()) {
    int at_end = 0;
    for (double x : cube.point(v)) at_end += x == 0 || x == 1 ? 1 : 0;
    EXPECT_EQ(labels[v.idx].is_corner(), at_end == 3);
    EXPECT_EQ(labels[v.idx].is_line(), at_end == 2);
    if (at_end < 2) continue;
    EXPECT_LT(reference.curves().closest_within(cube.point(v), 1).distance, 1e-15);
  }
}

TEST(FeatureAssignment, HoldsForCoarserMeshesWithMovedVertices) {
  const ReferenceSurface reference = make_reference_surface(make_grid({12, 12, 12}, kBox));
  for (unsigned seed : {1, 2, 3}) {
    for (int n : {2, 4}) {
      HexMesh coarse = make_grid({n, n, n}, kBox);
      const auto exact = feature_of(reference, coarse);
      perturb(coarse, 0.12 / n, true, seed);
      const auto labels = feature_of(reference, coarse);
      EXPECT_EQ(count(labels).corners, 8);
      EXPECT_EQ(count(labels).lines, 12 * (n - 1));
      EXPECT_EQ(labels, exact);
    }
  }
}

TEST(FeatureAssignment, FollowsClosedLines) {
  const ReferenceSurface reference =
      make_reference_surface(make_o_grid({.n_core = 8, .n_layers = 8}));
  const HexMesh coarse = make_o_grid({.n_core = 3, .n_layers = 3});
  const Count n = count(feature_of(reference, coarse));
  EXPECT_EQ(n.lines, 2 * 12);
  EXPECT_EQ(n.corners, 0);
}

TEST(FeatureAssignment, KeepsTheSidesOfAThinPlateApart) {
  const Eigen::AlignedBox3d box(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 1, 0.02));
  HexMesh plate = make_grid({8, 8, 1}, box);
  const ReferenceSurface reference = make_reference_surface(plate);
  const auto exact = feature_of(reference, plate);
  EXPECT_EQ(count(exact).lines, 8 * 7);
  EXPECT_EQ(count(exact).corners, 8);
  perturb(plate, 0.004, true, 5);
  EXPECT_EQ(feature_of(reference, plate), exact);
}

// Adds a copy of a part, turned about the z axis and then moved up along it.
void add_turned(HexMesh& mesh, const HexMesh& part, double angle, double up) {
  const Eigen::AngleAxisd turn(angle, Eigen::Vector3d::UnitZ());
  std::vector<VertexHandle> copy(part.vertex_slots());
  for (VertexHandle v : part.vertices())
    copy[v.idx] = mesh.add_vertex(turn * part.point(v) + up * Eigen::Vector3d::UnitZ());
  for (CellHandle c : part.cells()) {
    CellVertices corners = part.vertices(c);
    for (VertexHandle& v : corners) v = copy[v.idx];
    mesh.add_cell(corners);
  }
}

TEST(FeatureAssignment, KeepsPartsApartThatFaceEachOtherAcrossAGap) {
  const HexMesh cylinder = make_o_grid({.n_core = 6, .n_layers = 6});
  const double edge = 2 * std::numbers::pi / 24;
  for (const double gap : {0.5 * edge, 0.2 * edge, 0.05 * edge}) {
    HexMesh model, turned;  // the rims' vertices are nearest to those of the other part in `turned`
    add_turned(model, cylinder, 0, 0);
    add_turned(model, cylinder, 0, 2 + gap);
    add_turned(turned, cylinder, edge / 24, 0);
    add_turned(turned, cylinder, 0, 2 + gap);
    const ReferenceSurface reference = make_reference_surface(model);
    const auto labels = feature_of(reference, turned);
    EXPECT_EQ(count(labels).lines, 4 * 24);
    const double middle = turned.point(VertexHandle(0)).z() + 2 + gap / 2;
    for (VertexHandle v : turned.vertices()) {
      if (!labels[v.idx].is_line()) continue;
      const double line_z = reference.curves().at(labels[v.idx].line, 0).point.z();
      EXPECT_EQ(line_z > middle, turned.point(v).z() > middle);
    }
  }
}

TEST(FeatureAssignment, KeepsTheCornersOfStackedBoxesApart) {
  const HexMesh box = make_grid({4, 4, 4}, kBox);
  HexMesh stack;
  add_turned(stack, box, 0, 0);
  add_turned(stack, box, 0, 1.05);
  const ReferenceSurface reference = make_reference_surface(stack);
  const auto exact = feature_of(reference, stack);
  EXPECT_EQ(count(exact).corners, 16);
  EXPECT_EQ(count(exact).lines, 24 * 3);
  for (unsigned seed : {1, 2, 3}) {
    HexMesh moved = stack;
    perturb(moved, 0.05, true, seed);
    EXPECT_EQ(feature_of(reference, moved), exact) << seed;
  }
}

// A cylinder drawn out to one sharp edge: its rims start and end at the same corner.
TEST(FeatureAssignment, FollowsALineBackToTheCornerItStartsAt) {
  HexMesh drop = make_o_grid({.n_core = 6, .n_ring = 3, .n_layers = 8});
  for (VertexHandle v : drop.vertices()) {
    const Eigen::Vector3d p = drop.point(v);
    const double angle = std::abs(std::atan2(p.y(), p.x()));
    const double out = 1 + 0.9 * std::max(0.0, 1 - angle / (std::numbers::pi / 3));
    drop.set_point(v, {out * p.x(), out * p.y(), p.z()});
  }
  const ReferenceSurface reference = make_reference_surface(drop);
  const Count n = count(feature_of(reference, drop));
  EXPECT_EQ(n.corners, 2);
  EXPECT_EQ(n.lines, 2 * 23 + 7);
}

TEST(FeatureAssignment, FindsNothingOnASmoothSurface) {
  const HexMesh ball = make_ball(8);
  const Count n = count(feature_of(make_reference_surface(ball), ball));
  EXPECT_EQ(n.lines + n.corners, 0);
}

TEST(FeatureAssignment, PassesOverDeletedVertices) {
  HexMesh cube = make_grid({3, 3, 3}, kBox);
  const ReferenceSurface reference = make_reference_surface(cube);
  cube.delete_cell(CellHandle(0));
  const auto labels = feature_of(reference, cube);
  EXPECT_EQ(static_cast<int>(labels.size()), cube.vertex_slots());
  EXPECT_EQ(count(labels).corners, 7);
}

TEST(FeatureAssignment, WhatWasKnownOfAMeshBeforeMakesNoDifference) {
  for (HexMesh mesh : {make_l_shape(4), make_o_grid({.n_core = 4, .n_layers = 4}),
                       make_torus({.n_around = 24, .round_section = false})}) {
    const ReferenceSurface reference = make_reference_surface(mesh);
    NearLines known;
    const auto expect_no_difference = [&] {
      const auto labels = feature_of(reference, mesh, known);
      EXPECT_GT(count(labels).lines, 0);
      EXPECT_EQ(labels, feature_of(reference, mesh));
    };
    expect_no_difference();
    expect_no_difference();
    Random random(8);
    for (const VertexHandle v : mesh.vertices()) {
      if (v.idx % 3 == 0) mesh.set_point(v, mesh.point(v) + 0.02 * random.in_cube(1));
    }
    expect_no_difference();
    split_sheet(mesh, dual_sheet(mesh, EdgeHandle(0)));
    expect_no_difference();
    mesh.collect_garbage();  // others have their handles now
    expect_no_difference();
  }
}

TEST(FeatureAssignment, LinesGoOnBeyondTheRimOfARegion) {
  const HexMesh bar = make_grid({10, 2, 2});
  const ReferenceSurface reference = make_reference_surface(bar);
  std::vector<CellHandle> middle;
  for (int layer = 0; layer < 4; ++layer) {
    for (int x = 3; x < 7; ++x) middle.emplace_back(x + 10 * layer);
  }
  const Region region = make_region(bar, middle);
  const auto labels = assign_features(region.points, region.quads, region.n_free, reference);
  int on_line = 0;
  for (int v : region.surface) on_line += labels[v].is_line() ? 1 : 0;
  EXPECT_EQ(on_line, 4 * 3);
}

}  // namespace
}  // namespace hexweft
