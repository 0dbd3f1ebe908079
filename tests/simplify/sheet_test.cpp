// Sheets of the base complex.
#include "simplify/sheet.h"

#include <algorithm>
#include <map>
#include <set>

#include <gmock/gmock.h>

#include "tests/mesh_families.h"
#include "tests/simplify/test_meshes.h"

namespace hexweft {
namespace {

using testing::ElementsAre;
using testing::Pair;

std::vector<Sheet> sheets_of(const HexMesh& mesh) {
  return extract_sheets(extract_base_complex(mesh));
}

std::map<SheetKind, int> kinds(const HexMesh& mesh) {
  std::map<SheetKind, int> n;
  for (const Sheet& s : sheets_of(mesh)) ++n[s.kind];
  return n;
}

TEST(Sheet, GridHasThreeOpenOnesOfItsSizes) {
  std::multiset<int> widths;
  for (const Sheet& s : sheets_of(make_grid({4, 3, 2}))) {
    EXPECT_EQ(s.kind, SheetKind::open);
    EXPECT_EQ(s.edges.size(), 4u);
    EXPECT_EQ(s.crossings.size(), 1u);
    widths.insert(s.width);
  }
  EXPECT_THAT(widths, ElementsAre(2, 3, 4));
}

TEST(Sheet, PillowIsClosedAndTheGridsOwnAreOpen) {
  const auto sheets = sheets_of(make_pillowed_grid(3));
  ASSERT_EQ(sheets.size(), 10u);
  for (const Sheet& s : sheets) {
    const bool pillow = s.edges.size() == 8;
    EXPECT_EQ(s.kind, pillow ? SheetKind::closed : SheetKind::open);
    EXPECT_TRUE(!pillow || s.crossings.size() == 6);
  }
}

TEST(Sheet, OGridHasOneRoundItsCoreThatOpensAtTheEnds) {
  // Two through the core, one round it, one across the axis.
  EXPECT_THAT(kinds(make_o_grid()), ElementsAre(Pair(SheetKind::open, 4)));
  // On the ring the one round the core closes.
  EXPECT_THAT(kinds(make_torus()),
              ElementsAre(Pair(SheetKind::open, 5), Pair(SheetKind::closed, 1)));
}

TEST(Sheet, TwistedSectionMakesOneSidedSheets) {
  const auto square = [](int turns) {
    return kinds(make_torus({.round_section = false, .n_quarter_turns = turns}));
  };
  // Three or more across the ring, besides those along it: two of them, one, two.
  EXPECT_THAT(square(0), ElementsAre(Pair(SheetKind::open, 5)));
  EXPECT_THAT(square(1), ElementsAre(Pair(SheetKind::open, 3), Pair(SheetKind::moebius, 1)));
  EXPECT_EQ(square(2)[SheetKind::moebius], 2);
  EXPECT_THAT(square(3), ElementsAre(Pair(SheetKind::open, 3), Pair(SheetKind::moebius, 1)));
}

TEST(Sheet, QuarterTurnSheetCrossesEachComponentTwice) {
  for (const Sheet& s : sheets_of(make_torus({.round_section = false, .n_quarter_turns = 1}))) {
    if (s.kind == SheetKind::moebius) {
      EXPECT_EQ(s.crossings.size(), 6u);
      EXPECT_EQ(s.edges.size(), 12u);
    }
  }
}

TEST(Sheet, RibbonThatCrossesItselfIsIntersecting) {
  int n = 0;
  for (const Sheet& s : sheets_of(make_crossing_ribbon())) {
    if (s.kind != SheetKind::intersecting) continue;
    ++n;
    EXPECT_EQ(s.crossings.size(), 5u);  // the crossing twice, both ends, the loop
    EXPECT_EQ(s.width, 1);
  }
  EXPECT_EQ(n, 1);
}

TEST(Sheet, RibbonThatLiesAlongItselfIsTangent) {
  int n = 0;
  for (const Sheet& s : sheets_of(make_touching_ribbon())) {
    if (s.kind != SheetKind::tangent || s.crossings.size() != 3) continue;
    ++n;
    EXPECT_EQ(s.edges.size(), 8u);  // four in each of the two planes
  }
  EXPECT_EQ(n, 1);
}

class SheetsOfEveryFamily : public testing::TestWithParam<MeshFamily> {};
INSTANTIATE_TEST_SUITE_P(, SheetsOfEveryFamily, testing::ValuesIn(mesh_families()), family_name);

TEST_P(SheetsOfEveryFamily, EveryBaseEdgeIsInOneSheet) {
  const BaseComplex bc = extract_base_complex(GetParam().make());
  std::vector<int> seen(bc.edges.size(), 0);
  int lowest = -1;
  for (const Sheet& s : extract_sheets(bc)) {
    EXPECT_TRUE(std::is_sorted(s.edges.begin(), s.edges.end()));
    EXPECT_GT(s.edges.front(), lowest);
    lowest = s.edges.front();
    for (int e : s.edges) {
      ++seen[e];
      EXPECT_EQ(bc.edges[e].n, s.width);
    }
  }
  EXPECT_THAT(seen, testing::Each(1));
}

TEST_P(SheetsOfEveryFamily, EveryAxisOfAComponentIsCrossedOnceByTheSheetOfItsEdges) {
  const BaseComplex bc = extract_base_complex(GetParam().make());
  std::set<std::pair<int, int>> seen;
  for (const Sheet& s : extract_sheets(bc)) {
    std::set<int> edges;
    for (const Crossing& x : s.crossings) {
      EXPECT_TRUE(seen.insert({x.component, x.axis}).second);
      for (int i = 0; i < 4; ++i) edges.insert(bc.components[x.component].edges[4 * x.axis + i]);
    }
    EXPECT_TRUE(std::equal(edges.begin(), edges.end(), s.edges.begin(), s.edges.end()));
  }
  EXPECT_EQ(seen.size(), 3 * bc.components.size());
}

TEST_P(SheetsOfEveryFamily, KindsFollowFromEdgesAndCrossings) {
  const BaseComplex bc = extract_base_complex(GetParam().make());
  for (const Sheet& s : extract_sheets(bc)) {
    std::multiset<int> ends;
    std::set<int> components;
    bool boundary = false;
    for (int e : s.edges) {
      ends.insert(bc.edges[e].ends.begin(), bc.edges[e].ends.end());
      boundary |= bc.edges[e].boundary;
    }
    for (const Crossing& x : s.crossings) components.insert(x.component);
    const bool crosses = components.size() < s.crossings.size();
    const bool touches = std::set<int>(ends.begin(), ends.end()).size() < ends.size();
    switch (s.kind) {
      case SheetKind::open:
      case SheetKind::closed:
        EXPECT_EQ(boundary, s.kind == SheetKind::open);
        EXPECT_FALSE(crosses || touches);
        break;
      case SheetKind::tangent:
        EXPECT_TRUE(touches && !crosses);
        break;
      case SheetKind::intersecting:
        EXPECT_TRUE(crosses);
        break;
      case SheetKind::moebius:
        break;
    }
  }
}

}  // namespace
}  // namespace hexweft
