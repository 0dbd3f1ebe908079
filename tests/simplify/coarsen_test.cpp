// Coarsening takes layers out of sheets and leaves the base complex as it is.
#include "simplify/coarsen.h"

#include <numeric>

#include <gmock/gmock.h>

#include "tests/mesh_families.h"
#include "tests/ovm/mesh_dump.h"
#include "tests/simplify/loop_checks.h"
#include "tests/simplify/trial_bench.h"

namespace hexweft {
namespace {

int coarsen_fully(TrialBench& b) {
  return coarsen(b.context, b.bc, {}, [] { return false; });
}

std::vector<int> widths(const HexMesh& mesh) {
  std::vector<int> result;
  for (const Sheet& s : extract_sheets(extract_base_complex(mesh))) result.push_back(s.width);
  return result;
}

TEST(SpareLayers, AreEverySecondOneTheShortestFirst) {
  HexMesh mesh = make_grid({7, 1, 1});
  for (VertexHandle v : mesh.vertices()) {
    Eigen::Vector3d p = mesh.point(v);
    if (p.x() == 7) p.x() = 6.5;  // the last layer, which is no spare one
    if (p.x() >= 4) p.x() -= 0.5;
    mesh.set_point(v, p);
  }
  const auto spare = list_spare_layers(mesh, extract_base_complex(mesh));
  ASSERT_EQ(spare.size(), 3u);
  std::vector<double> first_x;
  for (const auto& layer : spare) {
    EXPECT_EQ(layer.size(), 4u);
    const auto [a, b] = mesh.vertices(layer.front());
    first_x.push_back(std::min(mesh.point(a).x(), mesh.point(b).x()));
  }
  EXPECT_THAT(first_x, testing::ElementsAre(3, 1, 4.5));
}

TEST(SpareLayers, AreNoneWhereASheetCrossesItself) {
  const HexMesh mesh = split_in_eight(make_crossing_ribbon());
  const BaseComplex bc = extract_base_complex(mesh);
  for (const Sheet& s : extract_sheets(bc)) ASSERT_GT(s.width, 1);
  for (const auto& layer : list_spare_layers(mesh, bc))
    EXPECT_FALSE(dual_sheet(mesh, layer.front()).crosses_itself());
}

TEST(Coarsen, LeavesOneHexahedronOfABox) {
  for (const FeatureMode features : {FeatureMode::off, FeatureMode::automatic}) {
    TrialBench b(make_grid({8, 5, 3}), 0.01, features);
    EXPECT_EQ(coarsen_fully(b), 7 + 4 + 2);
    EXPECT_EQ(b.mesh.n_cells(), 1);
    EXPECT_NEAR(b.distance.distance(), 0, 1e-9);
  }
}

TEST(Coarsen, StopsBetweenTwoLayers) {
  TrialBench b(make_grid({8, 5, 3}));
  int left = 2;
  EXPECT_EQ(coarsen(b.context, b.bc, {}, [&] { return left-- == 0; }), 2);
  EXPECT_LT(b.mesh.n_cells(), 8 * 5 * 3);
  EXPECT_TRUE(is_valid(b.mesh));
}

TEST(Coarsen, SplitsNoSheets) {
  TrialBench may(split_in_eight(make_pillowed_grid(3))), may_not(may.mesh);
  SimplifyOptions splits;
  splits.splits_per_trial = 6;
  const int gone = coarsen(may.context, may.bc, splits, [] { return false; });
  EXPECT_GT(gone, 0);
  EXPECT_EQ(coarsen_fully(may_not), gone);
  EXPECT_TRUE(MeshDump(may.mesh) == MeshDump(may_not.mesh));
}

TEST(TryCoarsen, LeavesAllAsItWasWhereTheSurfaceWouldSuffer) {
  // As few segments round as a round section may have.
  TrialBench b(make_torus({.n_core = 2, .n_around = 16}));
  const MeshDump before(b.mesh);
  const auto spare = list_spare_layers(b.mesh, b.bc);
  ASSERT_FALSE(spare.empty());
  const std::vector<char> ends = count_ends(b.mesh, b.bc);
  for (const auto& layer : spare) {
    const CollapsePlan plan = plan_layer_collapse(b.mesh, dual_sheet(b.mesh, layer.front()), ends);
    EXPECT_FALSE(try_coarsen(b.context, b.bc.graph, plan, {}));
    EXPECT_TRUE(MeshDump(b.mesh) == before);
  }
}

class CoarseningOfEveryFamily : public testing::TestWithParam<MeshFamily> {};
INSTANTIATE_TEST_SUITE_P(, CoarseningOfEveryFamily, testing::ValuesIn(mesh_families()),
                         family_name);

TEST_P(CoarseningOfEveryFamily, KeepsTheBaseComplexAndTheSurface) {
  const HexMesh input = split_in_eight(GetParam().make());
  TrialBench b(input, 0.05);  // some of them are that rough
  const int gone = coarsen_fully(b);
  EXPECT_GT(gone, 0);
  EXPECT_TRUE(is_valid(b.mesh));
  EXPECT_EQ(counts(extract_base_complex(b.mesh)), counts(b.bc));
  EXPECT_EQ(euler_characteristic(b.mesh), euler_characteristic(input));
  EXPECT_LT(b.mesh.n_cells(), input.n_cells());
  EXPECT_GT(min_scaled_jacobian(b.mesh), 0);
  EXPECT_LE(b.distance.distance(), 0.2 * b.context.distance_limit);
  // Each layer is one of a sheet that had several.
  const std::vector<int> before = widths(input), after = widths(b.mesh);
  EXPECT_EQ(std::accumulate(before.begin(), before.end(), -gone),
            std::accumulate(after.begin(), after.end(), 0));
}

}  // namespace
}  // namespace hexweft
