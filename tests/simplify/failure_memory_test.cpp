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
  const CandidateKey key = {1, 1}, other = {2, 1};
  EXPECT_FALSE(memory.should_wait(key, 0, true));
  memory.failed(key, Refusal::quality, 0);
  EXPECT_TRUE(memory.should_wait(key, 0, false));
  EXPECT_TRUE(memory.should_wait(key, 3, true));
  EXPECT_FALSE(memory.should_wait(key, 1, false));
  EXPECT_FALSE(memory.should_wait(key, 4, true));
  memory.failed(key, Refusal::quality, 4);
  EXPECT_TRUE(memory.should_wait(key, 19, true));
  EXPECT_FALSE(memory.should_wait(key, 20, true));
  memory.failed(key, Refusal::quality, 20);
  EXPECT_TRUE(memory.should_wait(key, 1000, false)) << "let go after the third failure";
  EXPECT_FALSE(memory.should_wait(other, 2, true));
  memory.forget_all();
  EXPECT_FALSE(memory.should_wait(key, 2, false));
}

TEST_F(FailureMemoryTest, TheSameConnectivityFailsAgainUntried) {
  const CandidateKey before = {1, 1}, after = {1, 2};
  for (const Refusal r : {Refusal::valence, Refusal::topology, Refusal::feature}) {
    SCOPED_TRACE(name(r));
    memory.forget_all();
    memory.failed(before, r, 0);
    EXPECT_TRUE(memory.should_wait(after, 3, true));
    EXPECT_FALSE(memory.should_wait(after, 4, true));
    EXPECT_TRUE(memory.should_wait(before, 4, true)) << "the second failure";
    EXPECT_TRUE(memory.should_wait(after, 19, true));
    EXPECT_FALSE(memory.should_wait(after, 20, true));
    EXPECT_TRUE(memory.should_wait(before, 20, true)) << "the third";
    EXPECT_TRUE(memory.should_wait(after, 1000, false));
  }
  memory.forget_all();
  memory.failed(before, Refusal::quality, 0);
  EXPECT_FALSE(memory.should_wait(before, 4, true));
}

TEST_F(FailureMemoryTest, ACauseHoldsForEveryPlanThatMakesTheSameMerges) {
  const CollapsePlan& plan = plans[0];
  const std::vector<int> cause = {0, 1};
  // The same collapse, had it reached one cell further: another plan.
  CollapsePlan longer = plan;
  longer.removed.pop_back();
  ASSERT_FALSE(memory.has_cause(mesh, longer, 0, true));
  memory.failed_at(mesh, plan, cause, 0);
  EXPECT_TRUE(memory.has_cause(mesh, longer, 3, true));
  EXPECT_FALSE(memory.has_cause(mesh, longer, 4, true));
  for (std::size_t i = 1; i < plans.size(); ++i) {
    const std::vector<int> common = common_groups(plan, plans[i]);
    const bool has_cause = std::includes(common.begin(), common.end(), cause.begin(), cause.end());
    EXPECT_EQ(memory.has_cause(mesh, plans[i], 1, true), has_cause) << i;
  }
}

TEST_F(FailureMemoryTest, ACauseIsGoneWhenItsSurroundingsHaveChanged) {
  const CollapsePlan& plan = plans[0];
  CollapsePlan longer = plan;
  longer.removed.pop_back();
  memory.failed_at(mesh, plan, std::vector<int>{0}, 0);
  ASSERT_TRUE(memory.has_cause(mesh, longer, 1, true));
  // A cell beside a vertex of the cause goes and comes back as another.
  const VertexHandle v = plan.group(0)[0];
  const CellHandle cell = *mesh.cells(v).begin();
  const auto vertices = mesh.vertices(cell);
  std::array<VertexHandle, 8> corners;
  std::copy(vertices.begin(), vertices.end(), corners.begin());
  mesh.delete_cell(cell);
  mesh.add_cell(corners);
  EXPECT_FALSE(memory.has_cause(mesh, longer, 1, true));
}

// Takes the first cell away and puts it back: a gap, and a cell that is new.
void renew_first_cell(HexMesh& mesh) {
  const CellHandle first = *mesh.cells().begin();
  const CellVertices corners = mesh.vertices(first);
  mesh.delete_cell(first);
  mesh.add_cell(corners);
}

TEST_F(FailureMemoryTest, HoldsWhenHandlesHaveBecomeOthers) {
  renew_first_cell(mesh);
  bc = extract_base_complex(mesh);
  const auto before = all_candidates(mesh, bc);
  const CandidateKeys keys(mesh, bc);
  for (std::size_t i = 0; i < before.size(); i += 2) {
    memory.failed(keys.key(before[i].parts), Refusal::topology, 0);
    memory.failed_at(mesh, before[i].plan, std::vector<int>{0}, 0);
  }
  std::vector<char> waits, has_cause;
  for (const PlannedCandidate& c : before) {
    waits.push_back(memory.should_wait(keys.key(c.parts), 1, true));
    has_cause.push_back(memory.has_cause(mesh, c.plan, 1, true));
  }
  const Renumbering now = mesh.collect_garbage();
  ASSERT_NE(now.cells.back(), static_cast<int>(now.cells.size()) - 1) << "nothing has moved";
  memory.renumber(now);
  bc = extract_base_complex(mesh);
  const auto after = all_candidates(mesh, bc);
  const CandidateKeys keys_after(mesh, bc);
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < after.size(); ++i) {
    EXPECT_EQ(memory.should_wait(keys_after.key(after[i].parts), 1, true), waits[i] != 0);
    EXPECT_EQ(memory.has_cause(mesh, after[i].plan, 1, true), has_cause[i] != 0);
  }
  EXPECT_THAT(waits, testing::AllOf(testing::Contains(0), testing::Contains(1)));
  EXPECT_THAT(has_cause, testing::Contains(1));
}

TEST_F(FailureMemoryTest, WhatIsGoneIsNoCauseAnyMore) {
  const CollapsePlan& plan = plans[0];
  memory.failed_at(mesh, plan, std::vector<int>{0}, 0);
  ASSERT_TRUE(memory.has_cause(mesh, plan, 1, true));
  Renumbering now = mesh.collect_garbage();
  now.vertices[plan.group(0)[0].idx] = -1;
  memory.renumber(now);
  EXPECT_FALSE(memory.has_cause(mesh, plan, 1, true));
}

TEST_F(FailureMemoryTest, TheSameOutlookFailsByTheSame) {
  const Outlook outlook = {.distance_rel = 1.2, .least = -0.3};
  EXPECT_EQ(memory.refusal_with(outlook), Refusal::none);
  memory.failed_with({.distance_rel = 1.2, .least = 0.3}, Refusal::quality);
  EXPECT_EQ(memory.refusal_with(outlook), Refusal::none) << "other hexahedra";
  memory.failed_with(outlook, Refusal::hausdorff);
  EXPECT_EQ(memory.refusal_with(outlook), Refusal::hausdorff);
  EXPECT_EQ(memory.refusal_with({.distance_rel = 1.2 + 1e-6, .least = -0.3 - 1e-6}),
            Refusal::hausdorff);
  EXPECT_EQ(memory.refusal_with({.distance_rel = 1.21, .least = -0.3}), Refusal::none);
  EXPECT_EQ(memory.refusal_with({.distance_rel = 1.2, .least = -0.31}), Refusal::none);
  memory.forget_all();
  EXPECT_EQ(memory.refusal_with(outlook), Refusal::none);
}

TEST_F(FailureMemoryTest, OnlyGeometryIsKnownByItsOutlook) {
  const Outlook outlook = {.distance_rel = 0.5, .least = 0.1};
  memory.failed_with(outlook, Refusal::topology);
  EXPECT_EQ(memory.refusal_with(outlook), Refusal::none);
  // Distances that do not count are the same wherever they are.
  memory.failed_with({.distance_rel = 0, .least = 0.1}, Refusal::quality);
  EXPECT_EQ(memory.refusal_with({.distance_rel = 0, .least = 0.1}), Refusal::none);
}

}  // namespace
}  // namespace hexweft
