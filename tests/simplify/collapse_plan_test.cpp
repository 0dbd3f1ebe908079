// Plans, and what they predict, against the mesh after the collapse.
#include <set>

#include <gmock/gmock.h>

#include "simplify/plan_check.h"
#include "tests/mesh_families.h"
#include "tests/simplify/prediction.h"
#include "tests/simplify/test_meshes.h"

namespace hexweft {
namespace {

class PlansOfEveryFamily : public testing::TestWithParam<MeshFamily> {};
INSTANTIATE_TEST_SUITE_P(, PlansOfEveryFamily, testing::ValuesIn(mesh_families()), family_name);

TEST_P(PlansOfEveryFamily, CollapseHasThePredictedEdgesAndIsUndone) {
  HexMesh mesh = GetParam().make();
  const BaseComplex bc = extract_base_complex(mesh);
  const auto plans = all_plans(mesh, bc);
  PlanTally tally;
  for (std::size_t i = 0; i < plans.size(); ++i) {
    try_plan(mesh, bc, plans[i], tally, i % (plans.size() / 16 + 1) == 0);
  }
  // A mesh of one component a part can only vanish.
  const auto parts = static_cast<std::size_t>(summarize_topology(mesh).n_parts);
  if (bc.components.size() > parts)
    EXPECT_GT(tally.as_predicted, 0);
  else
    EXPECT_EQ(tally.refused, static_cast<int>(plans.size()));
}

TEST_P(PlansOfEveryFamily, GroupsArePartsOfTheRemovedCells) {
  const HexMesh mesh = GetParam().make();
  const BaseComplex bc = extract_base_complex(mesh);
  for (const CollapsePlan& plan : all_plans(mesh, bc, 7)) {
    EXPECT_TRUE(std::is_sorted(plan.removed.begin(), plan.removed.end()));
    EXPECT_EQ(std::set<CellHandle>(plan.removed.begin(), plan.removed.end()).size(),
              plan.removed.size());
    std::set<VertexHandle> members, corners;
    for (CellHandle c : plan.removed) {
      corners.insert(mesh.vertices(c).begin(), mesh.vertices(c).end());
    }
    for (int g = 0; g < plan.n_groups(); ++g) {
      const auto group = plan.group(g);
      EXPECT_GE(group.size(), plan.peels ? 1u : 2u);
      EXPECT_TRUE(std::is_sorted(group.begin(), group.end()));
      for (VertexHandle v : group) {
        EXPECT_TRUE(members.insert(v).second);
        EXPECT_TRUE(corners.count(v));
      }
    }
    EXPECT_EQ(members.size(), plan.members.size());
  }
}

// Equation 1 in closed form: the two edges across a component of a sheet that touches itself
// nowhere.
void expect_equation_1(const HexMesh& mesh, const BaseComplex& bc, const Sheet& sheet, int& n) {
  const CollapsePlan plan = plan_sheet_collapse(mesh, bc, sheet);
  const auto predicted = predict_edges(mesh, bc.graph, plan);
  std::map<VertexPair, PredictedEdge> by_ends;
  for (const PredictedEdge& e : predicted) by_ends.insert({ordered(e.a, e.b), e});
  std::map<VertexHandle, VertexHandle> stand_in;
  for (int g = 0; g < plan.n_groups(); ++g) {
    for (VertexHandle v : plan.group(g)) stand_in[v] = plan.group(g)[0];
  }
  for (const Crossing& x : sheet.crossings) {
    const Component& c = bc.components[x.component];
    for (int e = 0; e < 12; ++e) {
      const auto [from, to] = kEdgeCorners[e];
      if (edge_axis(e) == x.axis || kCornerCoords[from][x.axis] == 1) continue;
      const int twin = kEdgeBetween[kCornerAcross[from][x.axis]][kCornerAcross[to][x.axis]];
      // The side of the component that has both edges.
      const auto& [s, t] = kEdgeSides[e];
      const int side = side_axis(s) == x.axis ? t : s;
      const bool boundary_face = bc.faces[c.faces[side]].boundary();
      const BaseEdge &left = bc.edges[c.edges[e]], &right = bc.edges[c.edges[twin]];
      const auto chain = bc.chain(left);
      const auto it = by_ends.find(ordered(stand_in.at(chain[0]), stand_in.at(chain[1])));
      ASSERT_NE(it, by_ends.end());
      EXPECT_EQ(it->second.valence, left.valence + right.valence - (boundary_face ? 2 : 4));
      EXPECT_EQ(it->second.boundary, left.boundary || right.boundary);
      EXPECT_EQ(it->second.merged, sheet.width + 1);
      ++n;
    }
  }
}

TEST_P(PlansOfEveryFamily, SimpleSheetsFollowEquation1) {
  const HexMesh mesh = GetParam().make();
  const BaseComplex bc = extract_base_complex(mesh);
  int n = 0;
  bool simple_ones = false;
  for (const Sheet& s : extract_sheets(bc)) {
    if (s.kind != SheetKind::open && s.kind != SheetKind::closed) continue;
    simple_ones = true;
    expect_equation_1(mesh, bc, s, n);
  }
  EXPECT_EQ(simple_ones, n > 0);
}

TEST(CollapsePlan, SheetOfAGridMergesItsRows) {
  const HexMesh mesh = make_grid({4, 3, 2});
  const BaseComplex bc = extract_base_complex(mesh);
  for (const Sheet& s : extract_sheets(bc)) {
    const CollapsePlan plan = plan_sheet_collapse(mesh, bc, s);
    EXPECT_EQ(plan.removed.size(), 24u);
    EXPECT_EQ(plan.width, s.width);
    EXPECT_EQ(plan.n_groups(), 5 * 4 * 3 / (s.width + 1));
    for (int g = 0; g < plan.n_groups(); ++g) {
      EXPECT_EQ(plan.group(g).size(), static_cast<std::size_t>(s.width + 1));
    }
  }
}

TEST(CollapsePlan, ChordFoldsItsSectionAlongADiagonal) {
  const HexMesh mesh = make_grid({3, 3, 2});
  const BaseComplex bc = extract_base_complex(mesh);
  int n = 0;
  const std::vector<Sheet> sheets = extract_sheets(bc);
  for (const Chord& c : extract_chords(bc)) {
    for (Diagonal d : {Diagonal::first, Diagonal::second}) {
      // Anti-diagonals of 4 x 4 vertices: 1, 2, 3, 4, 3, 2, 1 of them; those of one are no group.
      const CollapsePlan plan = plan_chord_collapse(mesh, bc, c, d, sheets);
      if (plan.width != 3) continue;
      ++n;
      EXPECT_EQ(plan.n_groups(), 5 * 3);
      EXPECT_EQ(plan.members.size(), 14u * 3);
      EXPECT_EQ(plan.width, 3);
      EXPECT_EQ(plan.removed.size(), 18u);
    }
  }
  EXPECT_EQ(n, 2);
}

TEST(CollapsePlan, PillowsPredictionIsTheGridItself) {
  const HexMesh mesh = make_pillowed_grid(3);
  const BaseComplex bc = extract_base_complex(mesh);
  for (const Sheet& s : extract_sheets(bc)) {
    if (s.kind != SheetKind::closed) continue;
    const auto predicted = predict_edges(mesh, bc.graph, plan_sheet_collapse(mesh, bc, s));
    EXPECT_EQ(predicted.size(), 12u + 24u);  // of the cube, and three outwards at each corner
    for (const PredictedEdge& e : predicted) {
      EXPECT_EQ(e.valence, 4);
      EXPECT_FALSE(e.boundary);
      EXPECT_EQ(e.error(), 0);
      EXPECT_EQ(e.old_error, e.merged == 2 ? 1 : 0);
    }
  }
}

// Collapses the sheets of width 1 of one kind; how many became as predicted.
int collapse_sheets(HexMesh mesh, SheetKind kind) {
  const BaseComplex bc = extract_base_complex(mesh);
  EXPECT_EQ(bc.irregular, 0);
  int n = 0;
  for (const Sheet& s : extract_sheets(bc)) {
    if (s.kind != kind || s.width != 1) continue;
    PlanTally tally;
    try_plan(mesh, bc, plan_sheet_collapse(mesh, bc, s), tally, true);
    n += tally.as_predicted;
  }
  return n;
}

TEST(CollapsePlan, SheetThatTouchesItselfHasThePredictedEdges) {
  EXPECT_EQ(collapse_sheets(make_touching_ribbon(true, 1), SheetKind::tangent), 1);
  EXPECT_EQ(collapse_sheets(make_touching_ribbon(true, 2), SheetKind::tangent), 1);
}

TEST(CollapsePlan, SheetThatCrossesItselfHasThePredictedEdges) {
  EXPECT_EQ(collapse_sheets(make_crossing_ribbon(true, 1), SheetKind::intersecting), 1);
  EXPECT_EQ(collapse_sheets(make_crossing_ribbon(true, 2), SheetKind::intersecting), 1);
}

TEST(CollapsePlan, DefaultTargetsAreOnTheBoundaryWhereAGroupTouchesIt) {
  const HexMesh mesh = make_o_grid();
  const BaseComplex bc = extract_base_complex(mesh);
  for (const Sheet& s : extract_sheets(bc)) {
    const CollapsePlan plan = plan_sheet_collapse(mesh, bc, s);
    const auto targets = default_targets(mesh, bc.graph, plan);
    for (int g = 0; g < plan.n_groups(); ++g) {
      std::vector<Eigen::Vector3d> all, boundary;
      for (VertexHandle v : plan.group(g)) {
        all.push_back(mesh.point(v));
        if (mesh.is_boundary(v)) boundary.push_back(mesh.point(v));
      }
      Eigen::Vector3d mean = Eigen::Vector3d::Zero();
      const auto& used = boundary.empty() ? all : boundary;
      for (const Eigen::Vector3d& p : used) mean += p / static_cast<double>(used.size());
      EXPECT_LT((targets[g] - mean).norm(), 1e-12);
    }
  }
}

}  // namespace
}  // namespace hexweft
