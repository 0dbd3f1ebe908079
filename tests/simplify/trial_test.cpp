// Trials: kept whole or undone whole.
#include "simplify/trial.h"

#include <gmock/gmock.h>

#include "optimize/hausdorff.h"
#include "ovm/neighborhood.h"
#include "tests/mesh_families.h"
#include "tests/ovm/mesh_dump.h"
#include "tests/simplify/prediction.h"
#include "tests/simplify/test_meshes.h"
#include "tests/simplify/trial_bench.h"

namespace hexweft {
namespace {

struct DistanceState {
  explicit DistanceState(const SurfaceDistance& d)
      : forward(d.forward()), backward(d.backward()), by_halfface(d.distance_by_halfface()) {}
  double forward, backward;
  std::vector<double> by_halfface;
  friend bool operator==(const DistanceState&, const DistanceState&) = default;
};

// Tries plans until one is accepted; each that is refused must leave everything as it was.
TrialResult first_accepted(TrialBench& b, const SimplifyOptions& options, std::size_t step,
                           std::array<int, kRefusals>& refused) {
  const auto plans = all_plans(b.mesh, b.bc, 5);
  for (std::size_t i = 0; i < plans.size(); i += step) {
    const MeshDump mesh(b.mesh);
    const DistanceState distance(b.distance);
    TrialResult result = try_collapse(b.context, b.bc, plans[i], options);
    ++refused[static_cast<int>(result.refusal)];
    if (result.accepted()) return result;
    EXPECT_TRUE(MeshDump(b.mesh) == mesh);
    EXPECT_TRUE(DistanceState(b.distance) == distance);
    EXPECT_TRUE(result.base_complex.components.empty());
  }
  TrialResult none;
  none.refusal = Refusal::structure;
  return none;
}

TEST(Trial, AcceptedOneIsValidSimplerAndNear) {
  TrialBench b(make_octree_like(Shape::sphere, 7));
  const double limit = b.context.distance_limit;
  std::array<int, kRefusals> refused = {};
  for (int step = 0; step < 4; ++step) {
    const std::size_t before = b.bc.components.size();
    TrialResult result = first_accepted(b, {}, 1, refused);
    ASSERT_TRUE(result.accepted());
    EXPECT_LT(result.base_complex.components.size(), before);
    EXPECT_EQ(counts(extract_base_complex(b.mesh)), counts(result.base_complex));
    EXPECT_TRUE(is_good(b.mesh));
    EXPECT_LE(b.distance.distance(), limit);
    b.bc = std::move(result.base_complex);
  }
  EXPECT_LE(hausdorff_distance(b.mesh, b.reference).ratio(), 0.012);
  const TopologySummary shape = summarize_topology(b.mesh);
  EXPECT_EQ(shape.n_parts, 1);
  EXPECT_EQ(shape.genus, 0);
}

TEST(Trial, WeighingTellsWhatTheCollapseComesToAndTakesItBack) {
  TrialBench b(make_octree_like(Shape::sphere, 7));
  const auto plans = all_plans(b.mesh, b.bc, 5);
  int weighed = 0;
  for (std::size_t i = 0; i < plans.size() && weighed < 3; ++i) {
    const MeshDump mesh(b.mesh);
    const DistanceState distance(b.distance);
    const double before = b.distance.distance();
    CollapseOutcome outcome;
    const TrialResult result = weigh_collapse(b.context, b.bc, plans[i], {}, outcome);
    EXPECT_TRUE(MeshDump(b.mesh) == mesh);
    EXPECT_TRUE(DistanceState(b.distance) == distance);
    if (!result.accepted()) continue;
    ++weighed;
    TrialBench made(make_octree_like(Shape::sphere, 7));
    const TrialResult kept = try_collapse(made.context, made.bc, plans[i], {});
    ASSERT_TRUE(kept.accepted());
    EXPECT_EQ(static_cast<int>(kept.base_complex.components.size()), outcome.components);
    EXPECT_EQ(kept.quality_spent, outcome.quality_spent);
    EXPECT_NEAR(outcome.distance_spent * b.context.distance_limit,
                made.distance.distance() - before, 1e-12);
  }
  EXPECT_EQ(weighed, 3);
}

TEST(Trial, ArmOfAnLIsTooFarFromTheInput) {
  TrialBench b(make_l_shape(2));
  int legal = 0;
  for (const Sheet& s : extract_sheets(b.bc)) {
    const CollapsePlan plan = plan_sheet_collapse(b.mesh, b.bc, s);
    if (check_plan(b.mesh, b.bc.graph, plan) != Refusal::none) continue;
    ++legal;
    const MeshDump mesh(b.mesh);
    const DistanceState distance(b.distance);
    const TrialResult result = try_collapse(b.context, b.bc, plan, {});
    EXPECT_THAT(result.refusal,
                testing::AnyOf(Refusal::hausdorff, Refusal::inverted, Refusal::quality));
    EXPECT_TRUE(MeshDump(b.mesh) == mesh);
    EXPECT_TRUE(DistanceState(b.distance) == distance);
  }
  EXPECT_GT(legal, 0);
}

TEST(Trial, OutlookIsWhatTheMergeLeaves) {
  TrialBench b(make_l_shape(2));
  SimplifyOptions any;
  any.merged_give_up_factor = 1e6;
  int seen = 0;
  for (const Sheet& s : extract_sheets(b.bc)) {
    const CollapsePlan plan = plan_sheet_collapse(b.mesh, b.bc, s);
    Outlook told;
    const MeshDump dump(b.mesh);
    const DistanceState distance(b.distance);
    const TrialResult result =
        try_collapse_locally(b.context, b.bc.graph, plan, any, [&](const Outlook& outlook) {
          told = outlook;
          return Refusal::quality;
        });
    EXPECT_TRUE(MeshDump(b.mesh) == dump);
    EXPECT_TRUE(DistanceState(b.distance) == distance);
    if (!result.outlook) continue;
    ++seen;
    EXPECT_EQ(result.refusal, Refusal::quality) << "what is known ends the trial";
    EXPECT_EQ(told.distance_rel, result.outlook->distance_rel);
    EXPECT_EQ(told.least, result.outlook->least);
    // The same by hand.
    Transaction merge(b.mesh);
    const auto targets = default_targets(b.mesh, b.bc.graph, plan);
    const auto left = apply_plan(b.mesh, plan, targets);
    EXPECT_EQ(told.least, measure_quality(b.mesh, cells_around(b.mesh, left, 1)).least);
    const double d = b.distance.after_change(b.mesh);
    EXPECT_NEAR(told.distance_rel * b.context.distance_limit, d, 1e-12 + 0.1 * d);
    b.distance.rollback();
    merge.rollback();
    // An arm that goes leaves the surface much farther away than a trial could bring it back.
    const TrialResult given_up = try_collapse_locally(b.context, b.bc.graph, plan, {});
    EXPECT_EQ(given_up.refusal, Refusal::hausdorff);
    EXPECT_GT(given_up.outlook->distance_rel, SimplifyOptions().merged_give_up_factor);
  }
  EXPECT_GT(seen, 0);
}

TEST(Trial, ArmOfAnLTakesCornersAlong) {
  TrialBench b(make_l_shape(2), 1.0, FeatureMode::automatic);
  int by_feature = 0;
  for (const Sheet& s : extract_sheets(b.bc)) {
    const CollapsePlan plan = plan_sheet_collapse(b.mesh, b.bc, s);
    if (check_plan(b.mesh, b.bc.graph, plan) != Refusal::none) continue;
    const MeshDump mesh(b.mesh);
    by_feature += try_collapse(b.context, b.bc, plan, {}).refusal == Refusal::feature;
    EXPECT_TRUE(MeshDump(b.mesh) == mesh);
  }
  EXPECT_EQ(by_feature, 2);
}

TEST(Trial, WithinAWideLimitAnArmGoes) {
  // The two components that stay make one straight grid.
  TrialBench b(make_l_shape(2), 1.0);
  SimplifyOptions options;
  options.hausdorff_limit_rel = 1;
  std::array<int, kRefusals> refused = {};
  const TrialResult result = first_accepted(b, options, 1, refused);
  ASSERT_TRUE(result.accepted());
  EXPECT_EQ(result.base_complex.components.size(), 1u);
  EXPECT_TRUE(is_good(b.mesh));
}

TEST(Trial, ClosingACavityIsRefused) {
  // The middle layer holds the cavity; without it there would be none.
  TrialBench b(make_hollow_box(), 1.0);
  SimplifyOptions options;
  options.hausdorff_limit_rel = 1;
  int n = 0;
  for (const Sheet& s : extract_sheets(b.bc)) {
    const CollapsePlan plan = plan_sheet_collapse(b.mesh, b.bc, s);
    if (plan.removed.size() != 8) continue;
    ++n;
    const MeshDump dump(b.mesh);
    const TrialResult result = try_collapse(b.context, b.bc, plan, options);
    EXPECT_EQ(result.refusal, Refusal::topology) << name(result.refusal);
    EXPECT_TRUE(MeshDump(b.mesh) == dump);
  }
  EXPECT_EQ(n, 3);
}

// What goes below them where there are none is refused, or ends better, where there are.
TEST(Trial, QualityFloorIsKept) {
  SimplifyOptions without;
  without.min_scaled_jacobian = without.mean_scaled_jacobian = 0;
  SimplifyOptions with = without;
  with.min_scaled_jacobian = 0.9;
  int below = 0;
  for (const HexMesh& input :
       {make_octree_like(Shape::torus, 8), make_o_grid({.n_core = 4, .n_layers = 4}),
        make_blocked_sheet(), make_octree_like(Shape::dumbbell, 12)}) {
    const double least_before = min_scaled_jacobian(input);
    const BaseComplex bc = extract_base_complex(input);
    for (const Sheet& s : extract_sheets(bc)) {
      const CollapsePlan plan = plan_sheet_collapse(input, bc, s);
      TrialBench free(input, 0.1), bound(input, 0.1);
      try_collapse_locally(free.context, bc.graph, plan, without);
      below += min_scaled_jacobian(free.mesh) < 0.95 * least_before;
      try_collapse_locally(bound.context, bc.graph, plan, with);
      EXPECT_GE(min_scaled_jacobian(bound.mesh), std::min(0.9, least_before) * (1 - 1e-9));
    }
  }
  EXPECT_GT(below, 0);
}

TEST(Trial, OfNoHexahedraTheQualityIsPerfect) {
  const Quality q = measure_quality(make_grid({1, 1, 1}), {});
  EXPECT_EQ(q.least, 1);
  EXPECT_EQ(q.mean, 1);
}

TEST(Trial, PillowIsTakenOutOfItsGridAgain) {
  TrialBench b(make_pillowed_grid(5));
  for (const Sheet& s : extract_sheets(b.bc)) {
    if (s.kind != SheetKind::closed) continue;
    const TrialResult result =
        try_collapse(b.context, b.bc, plan_sheet_collapse(b.mesh, b.bc, s), {});
    ASSERT_TRUE(result.accepted()) << name(result.refusal);
    EXPECT_EQ(result.base_complex.components.size(), 1u);
    EXPECT_EQ(b.mesh.n_cells(), 125);
    EXPECT_TRUE(is_good(b.mesh));
    return;
  }
  FAIL() << "no pillow";
}

TEST(CellsAround, RingsOfAGrid) {
  const HexMesh mesh = make_grid({9, 9, 9});
  const std::array middle = {VertexHandle(4 + 10 * (4 + 10 * 4))};
  for (int rings = 1; rings <= 4; ++rings) {
    const auto cells = cells_around(mesh, middle, rings);
    EXPECT_EQ(cells.size(), std::size_t(8 * rings * rings * rings));
    EXPECT_TRUE(std::is_sorted(cells.begin(), cells.end()));
  }
  EXPECT_EQ(cells_around(mesh, middle, 100).size(), 729u);
  EXPECT_TRUE(cells_around(mesh, {}, 3).empty());
}

TEST(Trial, ARefusalOverTheDistanceNamesTheMergesRoundThePlace) {
  TrialBench b(make_octree_like(Shape::sphere, 7), 0.002);
  int named = 0;
  for (const CollapsePlan& plan : all_plans(b.mesh, b.bc, 5)) {
    const TrialResult result = try_collapse(b.context, b.bc, plan, {});
    if (result.refusal != Refusal::hausdorff) {
      if (result.accepted()) break;
      EXPECT_TRUE(result.cause.empty() || is_geometric(result.refusal));
      continue;
    }
    ++named;
    EXPECT_FALSE(result.cause.empty());
    for (int g : result.cause) EXPECT_LT(g, plan.n_groups());
  }
  EXPECT_GT(named, 0);
}

}  // namespace
}  // namespace hexweft
