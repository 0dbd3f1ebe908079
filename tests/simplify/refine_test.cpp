// Refinement splits sheets and leaves the base complex as it is.
#include "simplify/refine.h"

#include <algorithm>
#include <optional>
#include <set>

#include <gmock/gmock.h>

#include "tests/mesh_families.h"
#include "tests/ovm/mesh_dump.h"
#include "tests/simplify/test_meshes.h"
#include "tests/simplify/trial_bench.h"

namespace hexweft {
namespace {

struct Bench : TrialBench {
  using TrialBench::TrialBench;
  std::vector<EdgeHandle> list(const RefineOptions& o,
                               std::span<const EdgeHandle> excluded = {}) const {
    return list_sheets_to_refine(mesh, distance, o, excluded);
  }
  /// The first of them, if any.
  std::optional<DualSheet> first(const RefineOptions& o) const {
    const auto all = list(o);
    return all.empty() ? std::nullopt : std::optional(dual_sheet(mesh, all.front()));
  }
};

// 3 x 2 x 2 cells of size 2 x 1 x 1.
HexMesh make_long_cells() {
  return make_grid({3, 2, 2},
                   Eigen::AlignedBox3d(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(6, 2, 2)));
}

double mean_length(const HexMesh& mesh, const DualSheet& s) {
  double sum = 0;
  for (EdgeHandle e : s.edges) sum += edge_length(mesh, e);
  return sum / static_cast<double>(s.edges.size());
}

TEST(TryRefine, LeavesNoLabelsWhereVerticesWereAdded) {
  TrialBench b(make_long_cells(), 0.01, FeatureMode::automatic);
  ASSERT_EQ(std::ssize(b.context.feature_labels()), b.mesh.vertex_slots());
  const auto sheets = list_sheets_to_refine(b.mesh, b.distance, {.max_cells = 100}, {});
  ASSERT_FALSE(sheets.empty());
  ASSERT_TRUE(try_refine(b.context, dual_sheet(b.mesh, sheets.front()), {}));
  EXPECT_EQ(std::ssize(b.context.feature_labels()), b.mesh.vertex_slots());
}

TEST(SheetsToRefine, AreLongAcross) {
  const Bench b(make_long_cells());
  const auto s = b.first({.max_cells = 100});
  ASSERT_TRUE(s);
  EXPECT_NEAR(mean_length(b.mesh, *s), 2, 1e-12);
  EXPECT_EQ(s->crossings.size(), 4u);
}

TEST(SheetsToRefine, RespectTheNumberOfCells) {
  const Bench b(make_long_cells());
  EXPECT_FALSE(b.first({.max_cells = 3}));
  EXPECT_TRUE(b.first({.max_cells = 4}));
}

TEST(SheetsToRefine, RespectTheLength) {
  // The mean edge has length 1.36.
  const Bench b(make_long_cells());
  EXPECT_TRUE(b.first({.max_cells = 100, .min_length_rel = 1.4}));
  EXPECT_FALSE(b.first({.max_cells = 100, .min_length_rel = 1.5}));
}

TEST(SheetsToRefine, ComeOnceEach) {
  const Bench b(make_long_cells());
  const auto all = b.list({.max_cells = 100});
  EXPECT_EQ(std::set(all.begin(), all.end()).size(), all.size());
  EXPECT_EQ(all.size(), 3u);  // the three sheets across the long direction
  for (EdgeHandle e : all) EXPECT_EQ(dual_sheet(b.mesh, e).edges.front(), e);
}

// Whatever is taken out, the others keep their order: to go on is to choose anew without it.
TEST(SheetsToRefine, LeaveOutWhatIsExcluded) {
  const Bench b(make_long_cells());
  auto all = b.list({.max_cells = 100});
  std::vector<EdgeHandle> excluded;
  while (!all.empty()) {
    excluded.push_back(all.front());
    all.erase(all.begin());
    EXPECT_EQ(b.list({.max_cells = 100}, excluded), all);
  }
}

TEST(SheetsToRefine, BeginWithTheLongestOfTheFarthest) {
  HexMesh mesh = make_grid({3, 1, 1});
  for (VertexHandle v : mesh.vertices()) {
    Eigen::Vector3d p = mesh.point(v);
    p.x() = p.x() == 0 ? 0 : p.x() == 1 ? 2 : p.x() == 2 ? 5 : 7.5;
    mesh.set_point(v, p);
  }
  const Bench b(mesh);
  const auto s = b.first({.max_cells = 1});
  ASSERT_TRUE(s);
  EXPECT_NEAR(mean_length(b.mesh, *s), 3, 1e-12);
}

// A thin sheet that is far from the surface stays so however often it is split.
TEST(SheetsToRefine, AreTheLongestFirstWhereDistanceDoesNotMatter) {
  HexMesh mesh = make_grid({6, 1, 1});
  for (VertexHandle v : mesh.vertices()) {
    Eigen::Vector3d p = mesh.point(v);
    p.x() = p.x() * p.x();
    mesh.set_point(v, p);
  }
  Bench b(mesh);
  for (VertexHandle v : b.mesh.vertices()) {
    const Eigen::Vector3d p = b.mesh.point(v);
    if (p.x() <= 1) b.mesh.set_point(v, p + Eigen::Vector3d(0, 0, 0.1));
  }
  b.distance.after_change(b.mesh);
  b.distance.commit();
  const auto lengths = [&](int by_distance) {
    std::vector<double> result;
    for (EdgeHandle e : b.list({.max_cells = 1, .min_length_rel = 0, .by_distance = by_distance}))
      result.push_back(mean_length(b.mesh, dual_sheet(b.mesh, e)));
    return result;
  };
  EXPECT_NEAR(lengths(1).front(), 1, 0.01);
  EXPECT_THAT(lengths(kAllSheets), testing::Pointwise(testing::DoubleNear(0.01),
                                                      std::vector<double>{11, 9, 7, 5, 3, 1}));
}

TEST(TryRefine, SplitsEachCellOfTheSheet) {
  Bench b(make_long_cells());
  const auto s = b.first({.max_cells = 100});
  ASSERT_TRUE(s && try_refine(b.context, *s, {}));
  EXPECT_EQ(b.mesh.n_cells(), 12 + 4);
  EXPECT_EQ(counts(extract_base_complex(b.mesh)), (BaseCounts{8, 12, 6, 1}));
  EXPECT_LE(b.distance.distance(), b.context.distance_limit);
}

class RefinementOfEveryFamily : public testing::TestWithParam<MeshFamily> {};
INSTANTIATE_TEST_SUITE_P(, RefinementOfEveryFamily, testing::ValuesIn(mesh_families()),
                         family_name);

// The sheets to split: up to twelve, spread over the mesh.
std::vector<EdgeHandle> some_sheets(const HexMesh& mesh) {
  const auto sheets = list_dual_sheets(mesh);
  std::vector<EdgeHandle> result;
  for (std::size_t i = 0; i < sheets.size(); i += sheets.size() / 12 + 1) {
    result.push_back(sheets[i].edges.front());
  }
  return result;
}

TEST_P(RefinementOfEveryFamily, KeepsTheBaseComplexOrEverything) {
  const HexMesh before = GetParam().make();
  const BaseComplex bc = extract_base_complex(before);
  const int euler = euler_characteristic(before);
  int refined = 0;
  for (EdgeHandle e : some_sheets(before)) {
    if (refined == 3) break;
    Bench b(before);
    const MeshDump dump(b.mesh);
    const DualSheet sheet = dual_sheet(b.mesh, e);
    if (!try_refine(b.context, sheet, {})) {
      EXPECT_TRUE(MeshDump(b.mesh) == dump);
      continue;
    }
    ++refined;
    if (!sheet.crosses_itself()) {
      EXPECT_EQ(b.mesh.n_cells(), before.n_cells() + static_cast<int>(sheet.crossings.size()));
    }
    EXPECT_TRUE(is_valid(b.mesh));
    EXPECT_EQ(counts(extract_base_complex(b.mesh)), counts(bc));
    EXPECT_EQ(euler_characteristic(b.mesh), euler);
    EXPECT_GT(min_scaled_jacobian(b.mesh), 0);
    EXPECT_LE(b.distance.distance(), b.context.distance_limit);
  }
  // Of some meshes every cell is about as bad as may be, so that no split is allowed.
  EXPECT_TRUE(refined > 0 || min_scaled_jacobian(before) < 0.1);
}

}  // namespace
}  // namespace hexweft
