// Sheets taken off single faces of the surface.
#include "simplify/peel.h"

#include <set>

#include <gmock/gmock.h>

#include "ovm/edit/split_sheet.h"
#include "simplify/feature_targets.h"
#include "simplify/trial.h"
#include "tests/simplify/prediction.h"
#include "tests/simplify/test_meshes.h"

namespace hexweft {
namespace {

// With the features of a surface that may be that of an earlier mesh.
std::vector<Peel> peels_of(const HexMesh& mesh, const BaseComplex& bc,
                           const ReferenceSurface& surface) {
  return extract_peels(bc, extract_sheets(bc),
                       base_edges_on_features(bc, feature_of(surface, mesh)));
}

TEST(Peel, IsWhatLiesUnderOneFace) {
  for (int n : {1, 3}) {
    const HexMesh mesh = make_padded_cube(n);
    const BaseComplex bc = extract_base_complex(mesh);
    const std::vector<Peel> peels = peels_of(mesh, bc, make_reference_surface(mesh));
    ASSERT_EQ(peels.size(), 6u);
    std::set<int> components;
    for (const Peel& p : peels) {
      EXPECT_EQ(p.width, 1);
      EXPECT_EQ(p.kind, SheetKind::closed);
      ASSERT_EQ(p.components.size(), 1u);
      const auto [component, side] = p.components.front();
      components.insert(component);
      EXPECT_TRUE(bc.faces[bc.components[component].faces[side]].boundary());
    }
    EXPECT_EQ(components.size(), 6u);
  }
}

TEST(Peel, AWholeSheetIsNone) {
  const HexMesh mesh = make_padded_cube(3);
  const BaseComplex bc = extract_base_complex(mesh);
  const std::vector<char> no_features(bc.edges.size(), 0);
  EXPECT_TRUE(extract_peels(bc, extract_sheets(bc), no_features).empty());
}

// Nor is what has the boundary on both of its sides.
TEST(Peel, AGridHasNone) {
  const HexMesh mesh = make_grid({3, 2, 1});
  const BaseComplex bc = extract_base_complex(mesh);
  const std::vector<char> all_features(bc.edges.size(), 1);
  EXPECT_TRUE(extract_peels(bc, extract_sheets(bc), all_features).empty());
}

TEST(Peel, ThoseOfTheMostComponentsComeFirst) {
  const HexMesh mesh = make_octree_like(Shape::sphere, 7);
  const BaseComplex bc = extract_base_complex(mesh);
  std::vector<char> some_features(bc.edges.size(), 0);
  for (std::size_t i = 0; i < bc.edges.size(); i += 2) some_features[i] = 1;
  const std::vector<Peel> peels = extract_peels(bc, extract_sheets(bc), some_features);
  ASSERT_GT(peels.size(), 1u);
  EXPECT_GT(peels.front().components.size(), peels.back().components.size());
  for (std::size_t i = 1; i < peels.size(); ++i)
    EXPECT_GE(peels[i - 1].components.size(), peels[i].components.size());
}

// Off the last face it would be the whole of a sheet, and there is no singular edge left.
TEST(Peel, OffFiveFacesOfAPaddedCubeLeavesAGrid) {
  for (int layers : {1, 2}) {
    SCOPED_TRACE(layers);
    HexMesh mesh = make_padded_cube(3);
    for (const DualSheet& s : list_dual_sheets(mesh)) {
      const bool is_padding = s.crossings.size() == 54;
      if (layers == 2 && is_padding) split_sheet(mesh, s);
    }
    mesh.collect_garbage();
    ASSERT_EQ(mesh.n_cells(), 27 + 54 * layers);
    const ReferenceSurface surface = make_reference_surface(mesh);
    for (int face = 0; face < 5; ++face) {
      const BaseComplex bc = extract_base_complex(mesh);
      const std::vector<Peel> peels = peels_of(mesh, bc, surface);
      ASSERT_FALSE(peels.empty());
      EXPECT_EQ(peels.front().width, layers);
      const CollapsePlan plan = plan_peel(mesh, bc, peels.front());
      ASSERT_EQ(check_plan(mesh, bc.graph, plan), Refusal::none);
      apply_plan(mesh, plan, default_targets(mesh, bc.graph, plan));
      EXPECT_TRUE(is_clean(check_topology(mesh), Severity::degenerate));
      EXPECT_EQ(euler_characteristic(mesh), 1);
      mesh.collect_garbage();
    }
    EXPECT_EQ(counts(extract_base_complex(mesh)), (BaseCounts{8, 12, 6, 1}));
    EXPECT_EQ(mesh.n_cells(), 27 + 9 * layers);
    EXPECT_GT(min_scaled_jacobian(mesh), 0);
    Eigen::AlignedBox3d box, grid_box;
    for (VertexHandle v : mesh.vertices()) box.extend(mesh.point(v));
    const HexMesh grid = make_grid({3, 3, 3});
    for (VertexHandle v : grid.vertices()) grid_box.extend(grid.point(v));
    EXPECT_TRUE(box.isApprox(grid_box));
  }
}

TEST(Peel, WhatLayUnderItComesUpToTheFace) {
  for (int n : {1, 2, 4}) {
    SCOPED_TRACE(n);
    HexMesh mesh = make_padded_cube(n);
    const BaseComplex bc = extract_base_complex(mesh);
    for (const Peel& peel : peels_of(mesh, bc, make_reference_surface(mesh))) {
      Transaction trial(mesh);
      Eigen::AlignedBox3d face;
      const auto [component, side] = peel.components.front();
      const Component& c = bc.components[component];
      for (CellHandle cell : bc.cells(c)) {
        for (HalfFaceHandle hf : mesh.halffaces(cell)) {
          if (!mesh.is_boundary(hf)) continue;
          for (VertexHandle v : mesh.vertices(hf)) face.extend(mesh.point(v));
        }
      }
      const CollapsePlan plan = plan_peel(mesh, bc, peel);
      ASSERT_EQ(plan.places.size(), static_cast<std::size_t>(plan.n_groups()));
      for (const Eigen::Vector3d& p : plan.places) EXPECT_TRUE(face.contains(p)) << p.transpose();
      for (int g = 0; g < plan.n_groups(); ++g) {
        for (int h = 0; h < g; ++h)
          EXPECT_GT((plan.places[g] - plan.places[h]).norm(), 0.2) << "of edges of length 1";
      }
      apply_plan(mesh, plan, default_targets(mesh, bc.graph, plan));
      EXPECT_GT(min_scaled_jacobian(mesh), 0);
    }
  }
}

// Some edges of the base complex taken for features, whatever they are.
TEST(Peel, EveryEdgeIsAsPredicted) {
  PlanTally tally;
  int n = 0;
  for (HexMesh mesh : {make_octree_like(Shape::sphere, 7), make_octree_like(Shape::blob, 8, 2),
                       make_padded_cube(3), make_grid_with_random_sheets(4, 2)}) {
    const BaseComplex bc = extract_base_complex(mesh);
    for (std::size_t step : {1, 2, 3}) {
      std::vector<char> features(bc.edges.size(), 0);
      for (std::size_t i = 0; i < features.size(); i += step) features[i] = 1;
      for (const Peel& p : extract_peels(bc, extract_sheets(bc), features))
        try_plan(mesh, bc, plan_peel(mesh, bc, p), tally, ++n % 8 == 0, {.max_angle_deg = 360});
    }
  }
  EXPECT_GT(tally.as_predicted, 20);
  EXPECT_GT(tally.refused, 0);
}

// Under a flat part of the surface that has no edge round it one cell would fill 180 degrees.
TEST(Peel, HasToEndAtAnEdge) {
  HexMesh mesh = make_padded_cube(4);
  ASSERT_GT(insert_random_sheets(mesh, 3, 1), 0);  // cut its faces up
  mesh.collect_garbage();
  const BaseComplex bc = extract_base_complex(mesh);
  const std::vector<char> all_features(bc.edges.size(), 1);
  int too_wide = 0;
  for (const Peel& p : extract_peels(bc, extract_sheets(bc), all_features))
    too_wide += check_plan(mesh, bc.graph, plan_peel(mesh, bc, p)) == Refusal::angle;
  EXPECT_GT(too_wide, 0);
}

TEST(Peel, ATrialKeepsTheEdgesOfTheFace) {
  HexMesh mesh = make_padded_cube(4);
  const ReferenceSurface surface = make_reference_surface(mesh);
  SurfaceDistance distance(mesh, surface);
  const double limit = 0.01 * surface.bounding_box_diagonal();
  TrialContext context{mesh, surface, distance, summarize_topology(mesh), limit, limit};
  for (int left : {6, 5, 4, 3, 1}) {
    const BaseComplex bc = extract_base_complex(mesh);
    const std::vector<Peel> peels =
        extract_peels(bc, extract_sheets(bc), base_edges_on_features(bc, context.feature_labels()));
    ASSERT_FALSE(peels.empty());
    const TrialResult result = try_collapse(context, bc, plan_peel(mesh, bc, peels.front()), {});
    ASSERT_TRUE(result.accepted()) << name(result.refusal);
    EXPECT_EQ(static_cast<int>(result.base_complex.components.size()), left);
    EXPECT_LT(distance.ratio(), 1e-3);
    EXPECT_TRUE(is_good(mesh));
    mesh.collect_garbage();
    distance = SurfaceDistance(mesh, surface);
  }
}

}  // namespace
}  // namespace hexweft
