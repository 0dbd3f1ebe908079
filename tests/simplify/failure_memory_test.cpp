// What waits after a failure, for how long, and what does not.
#include "simplify/failure_memory.h"

#include <gmock/gmock.h>

#include "tests/simplify/prediction.h"
#include "tests/simplify/test_meshes.h"

namespace hexweft {
namespace {

class FailureMemoryTest : public testing::Test {
 protected:
  HexMesh mesh = make_pillowed_grid(4);
  BaseComplex bc = extract_base_complex(mesh);
  std::vector<CollapsePlan> plans = all_plans(mesh, bc);
  FailureMemory memory;

  bool waits(const CollapsePlan& plan, int step, bool patient = true) const {
    return memory.should_wait(mesh, plan, step, patient);
  }
  // The groups of another plan that the first one has too.
  static std::vector<int> common_groups(const CollapsePlan& a, const CollapsePlan& b) {
    std::vector<int> common;
    for (int i = 0; i < a.n_groups(); ++i) {
      for (int j = 0; j < b.n_groups(); ++j) {
        const auto x = a.group(i), y = b.group(j);
        if (std::equal(x.begin(), x.end(), y.begin(), y.end())) common.push_back(i);
      }
    }
    return common;
  }
};

TEST_F(FailureMemoryTest, WaitsLongerAfterEachFailure) {
  const CollapsePlan &plan = plans[0], &other = plans[1];
  EXPECT_FALSE(waits(plan, 0));
  memory.failed(mesh, plan, {}, 0);
  EXPECT_TRUE(waits(plan, 0, false));
  EXPECT_TRUE(waits(plan, 3));
  EXPECT_FALSE(waits(plan, 1, false));
  EXPECT_FALSE(waits(plan, 4));
  memory.failed(mesh, plan, {}, 4);
  EXPECT_TRUE(waits(plan, 19));
  EXPECT_FALSE(waits(plan, 20));
  memory.failed(mesh, plan, {}, 20);
  EXPECT_TRUE(waits(plan, 1000, false)) << "let go after the third failure";
  EXPECT_FALSE(waits(other, 2));
  memory.forget_all();
  EXPECT_FALSE(waits(plan, 2, false));
}

TEST_F(FailureMemoryTest, KnowsPlansApart) {
  // The two diagonals of a chord remove the same cells.
  for (std::size_t i = 0; i < plans.size(); ++i) {
    FailureMemory one;
    one.failed(mesh, plans[i], {}, 0);
    for (std::size_t j = 0; j < plans.size(); ++j) {
      EXPECT_EQ(one.should_wait(mesh, plans[j], 0, true), i == j) << i << ' ' << j;
    }
  }
}

TEST_F(FailureMemoryTest, ACauseHoldsForEveryPlanThatMakesTheSameMerges) {
  const CollapsePlan& plan = plans[0];
  const std::vector<int> cause = {0, 1};
  // The same collapse, had it reached one cell further: another plan.
  CollapsePlan longer = plan;
  longer.removed.pop_back();
  ASSERT_FALSE(waits(longer, 0));
  memory.failed(mesh, plan, cause, 0);
  EXPECT_TRUE(waits(longer, 3));
  EXPECT_FALSE(waits(longer, 4));
  for (std::size_t i = 1; i < plans.size(); ++i) {
    const std::vector<int> common = common_groups(plan, plans[i]);
    const bool has_cause = std::includes(common.begin(), common.end(), cause.begin(), cause.end());
    EXPECT_EQ(waits(plans[i], 1), has_cause) << i;
  }
}

TEST_F(FailureMemoryTest, ACauseIsGoneWhenItsSurroundingsHaveChanged) {
  const CollapsePlan& plan = plans[0];
  CollapsePlan longer = plan;
  longer.removed.pop_back();
  memory.failed(mesh, plan, std::vector<int>{0}, 0);
  ASSERT_TRUE(waits(longer, 1));
  // A cell beside a vertex of the cause goes and comes back as another.
  const VertexHandle v = plan.group(0)[0];
  const CellHandle cell = *mesh.cells(v).begin();
  const auto vertices = mesh.vertices(cell);
  std::array<VertexHandle, 8> corners;
  std::copy(vertices.begin(), vertices.end(), corners.begin());
  mesh.delete_cell(cell);
  mesh.add_cell(corners);
  EXPECT_FALSE(waits(longer, 1));
}

}  // namespace
}  // namespace hexweft
