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

// Whether all cells at the members are those they were.
bool is_as_before(const HexMesh& before, const HexMesh& mesh, const CollapsePlan& plan) {
  return std::all_of(plan.members.begin(), plan.members.end(), [&](VertexHandle v) {
    if (!mesh.is_live(v)) return false;
    std::vector<CellHandle> a, b;
    for (CellHandle c : before.cells(v)) a.push_back(c);
    for (CellHandle c : mesh.cells(v)) b.push_back(c);
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    return a == b && std::all_of(a.begin(), a.end(), [&](CellHandle c) {
             const auto x = before.vertices(c), y = mesh.vertices(c);
             return std::equal(x.begin(), x.end(), y.begin(), y.end());
           });
  });
}

// How many plans a round is clear of, all of which must have their cells as they were before it.
struct Seen {
  int clear = 0, touched = 0;
  void look_at(const Round& round, const HexMesh& before, const HexMesh& now,
               const std::vector<CollapsePlan>& plans) {
    for (const CollapsePlan& plan : plans) {
      if (!round.is_clear_of(plan)) {
        ++touched;
        continue;
      }
      ++clear;
      EXPECT_TRUE(is_as_before(before, now, plan));
    }
  }
};

TEST(Round, IsClearOfPlansWhoseCellsNothingHasTouched) {
  HexMesh mesh = make_octree_like(Shape::sphere, 7);
  const HexMesh before = mesh;
  const MeshDump dump(mesh);
  const BaseComplex bc = extract_base_complex(mesh);
  const auto plans = all_plans(mesh, bc, 3);
  Seen seen;
  for (std::size_t i = 0; i < plans.size(); i += 7) {
    Round round(mesh);
    for (const CollapsePlan& plan : plans) EXPECT_TRUE(round.is_clear_of(plan));
    apply_plan(mesh, plans[i], default_targets(mesh, bc.graph, plans[i]));
    round.add(plans[i]);
    seen.look_at(round, before, mesh, plans);
    round.take_back();
    EXPECT_TRUE(MeshDump(mesh) == dump);
  }
  EXPECT_GT(seen.clear, 0);
  EXPECT_GT(seen.touched, 0);
}

TEST(Round, KnowsOfSplitsMadeWithACollapse) {
  HexMesh mesh = make_octree_like(Shape::sphere, 7);
  const HexMesh before = mesh;
  const auto plans = all_plans(mesh, extract_base_complex(mesh), 3);
  Seen seen;
  for (const DualSheet& sheet : list_dual_sheets(mesh)) {
    Round round(mesh);
    split_sheet(mesh, sheet);
    round.add({});
    seen.look_at(round, before, mesh, plans);
  }
  EXPECT_GT(seen.clear, 0);
  EXPECT_GT(seen.touched, 0);
}

}  // namespace
}  // namespace hexweft::detail
