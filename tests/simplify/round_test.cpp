// What a round takes for touched.
#include "simplify/detail/round.h"

#include <gtest/gtest.h>

#include "ovm/dual.h"
#include "ovm/edit/split_sheet.h"
#include "tests/ovm/mesh_dump.h"
#include "tests/simplify/prediction.h"
#include "tests/simplify/test_meshes.h"

namespace hexweft::detail {
namespace {

// How many candidates a round is clear of, all of which must have their cells as they were before it.
struct Seen {
  int clear = 0, touched = 0;
  void look_at(const Round& round, const HexMesh& before, const HexMesh& now,
               const std::vector<PlannedCandidate>& candidates) {
    for (const PlannedCandidate& c : candidates) {
      const bool whole = is_whole(c);
      if (round.is_clear_of(c.parts) && round.is_clear_of(c.plan)) {
        ++clear;
        EXPECT_TRUE(is_as_before(before, now, c.plan.members));
        EXPECT_TRUE(!whole || is_as_before(before, now, vertices_of_removed(before, c.plan)));
      } else {
        ++touched;
        EXPECT_TRUE(!whole || !round.is_clear_of(c.parts)) << "seen without the plan";
      }
    }
  }
};

TEST(Round, IsClearOfPlansWhoseCellsNothingHasTouched) {
  HexMesh mesh = make_octree_like(Shape::sphere, 7);
  const HexMesh before = mesh;
  const MeshDump dump(mesh);
  const BaseComplex bc = extract_base_complex(mesh);
  const auto candidates = all_candidates(mesh, bc, 3);
  Seen seen;
  for (std::size_t i = 0; i < candidates.size(); i += 7) {
    const CollapsePlan& plan = candidates[i].plan;
    Round round(mesh, bc);
    for (const PlannedCandidate& c : candidates) {
      EXPECT_TRUE(round.is_clear_of(c.plan));
      EXPECT_TRUE(round.is_clear_of(c.parts));
    }
    apply_plan(mesh, plan, default_targets(mesh, bc.graph, plan));
    round.add({}, plan);
    seen.look_at(round, before, mesh, candidates);
    round.take_back();
    EXPECT_TRUE(MeshDump(mesh) == dump);
  }
  EXPECT_GT(seen.clear, 0);
  EXPECT_GT(seen.touched, 0);
}

TEST(Round, KnowsOfSplitsMadeWithACollapse) {
  HexMesh mesh = make_octree_like(Shape::sphere, 7);
  const HexMesh before = mesh;
  const BaseComplex bc = extract_base_complex(mesh);
  const auto candidates = all_candidates(mesh, bc, 3);
  Seen seen;
  for (const DualSheet& sheet : list_dual_sheets(mesh)) {
    Round round(mesh, bc);
    split_sheet(mesh, sheet);
    round.add({}, {});
    seen.look_at(round, before, mesh, candidates);
  }
  EXPECT_GT(seen.clear, 0);
  EXPECT_GT(seen.touched, 0);
}

}  // namespace
}  // namespace hexweft::detail
