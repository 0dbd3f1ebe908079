// Chords of the base complex.
#include "simplify/chord.h"

#include <algorithm>
#include <set>

#include <gmock/gmock.h>

#include "tests/mesh_families.h"
#include "tests/simplify/test_meshes.h"

namespace hexweft {
namespace {

std::array<int, 2> ends(const BaseComplex& bc, const ChordLink& l) {
  const auto& faces = bc.components[l.component].faces;
  return {faces[2 * l.axis], faces[2 * l.axis + 1]};
}

TEST(Chord, GridHasThree) {
  const auto chords = extract_chords(extract_base_complex(make_grid({4, 3, 2})));
  ASSERT_EQ(chords.size(), 3u);
  for (const Chord& c : chords) {
    EXPECT_EQ(c.links.size(), 1u);
    EXPECT_FALSE(c.closed || c.self_crossing || c.twisted);
  }
}

TEST(Chord, OGridHasOneRoundItsCoreAndFiveAlongIt) {
  const auto chords = extract_chords(extract_base_complex(make_o_grid()));
  // Along the axis five; through the core two, each with three links; one round the core.
  std::multiset<std::size_t> open, closed;
  for (const Chord& c : chords) (c.closed ? closed : open).insert(c.links.size());
  EXPECT_THAT(open, testing::ElementsAre(1, 1, 1, 1, 1, 3, 3));
  EXPECT_THAT(closed, testing::ElementsAre(4));
}

TEST(Chord, AlongATorusItIsTwistedByAnOddNumberOfQuarterTurns) {
  for (int turns = 0; turns < 4; ++turns) {
    const HexMesh mesh = make_torus({.round_section = false, .n_quarter_turns = turns});
    int n = 0;
    for (const Chord& c : extract_chords(extract_base_complex(mesh))) {
      if (!c.closed) continue;
      ++n;
      EXPECT_EQ(c.twisted, turns % 2 == 1) << turns;
    }
    EXPECT_EQ(n, 1);
  }
}

TEST(Chord, AlongACrossingRibbonItCrossesItself) {
  int n = 0;
  for (const Chord& c : extract_chords(extract_base_complex(make_crossing_ribbon()))) {
    if (!c.self_crossing) continue;
    ++n;
    EXPECT_EQ(c.links.size(), 5u);
    EXPECT_FALSE(c.closed);
  }
  EXPECT_EQ(n, 1);
}

class ChordsOfEveryFamily : public testing::TestWithParam<MeshFamily> {};
INSTANTIATE_TEST_SUITE_P(, ChordsOfEveryFamily, testing::ValuesIn(mesh_families()), family_name);

TEST_P(ChordsOfEveryFamily, EveryBaseFaceIsInOneChord) {
  const BaseComplex bc = extract_base_complex(GetParam().make());
  std::vector<int> chord_of(bc.faces.size(), -1);
  std::set<std::pair<int, int>> links;
  const auto chords = extract_chords(bc);
  for (int id = 0; id < static_cast<int>(chords.size()); ++id) {
    for (const ChordLink& l : chords[id].links) {
      EXPECT_TRUE(links.insert({l.component, l.axis}).second);
      for (int f : ends(bc, l)) {
        EXPECT_TRUE(chord_of[f] == -1 || chord_of[f] == id);
        chord_of[f] = id;
      }
    }
  }
  EXPECT_EQ(links.size(), 3 * bc.components.size());
  EXPECT_THAT(chord_of, testing::Each(testing::Ge(0)));
}

TEST_P(ChordsOfEveryFamily, LinksFollowEachOtherThroughBaseFaces) {
  const BaseComplex bc = extract_base_complex(GetParam().make());
  for (const Chord& chord : extract_chords(bc)) {
    const std::size_t n = chord.links.size();
    // Every face between links is used by two of them, the two ends of an open chord by one.
    std::multiset<int> faces;
    for (const ChordLink& l : chord.links) {
      for (int f : ends(bc, l)) faces.insert(f);
    }
    int once = 0;
    for (int f : faces) {
      once += faces.count(f) == 1;
      EXPECT_EQ(bc.faces[f].boundary(), faces.count(f) == 1);
    }
    EXPECT_EQ(once, chord.closed ? 0 : 2);
    for (std::size_t i = 0; i + (chord.closed ? 0 : 1) < n; ++i) {
      const auto a = ends(bc, chord.links[i]), b = ends(bc, chord.links[(i + 1) % n]);
      EXPECT_TRUE(a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1]);
    }
  }
}

TEST_P(ChordsOfEveryFamily, DiagonalsContinueFromLinkToLink) {
  const BaseComplex bc = extract_base_complex(GetParam().make());
  const auto corners = [&](int a, int b) {
    std::multiset<int> v(bc.edges[a].ends.begin(), bc.edges[a].ends.end());
    v.insert(bc.edges[b].ends.begin(), bc.edges[b].ends.end());
    return v;
  };
  for (const Chord& chord : extract_chords(bc)) {
    for (std::size_t i = 0; i + 1 < chord.links.size(); ++i) {
      const ChordLink &l = chord.links[i], &next = chord.links[i + 1];
      const LinkEdges x = link_edges(bc, l, Diagonal::first);
      const LinkEdges y = link_edges(bc, next, Diagonal::first);
      const LinkEdges z = link_edges(bc, l, Diagonal::second);
      EXPECT_TRUE(z.a == x.c && z.b == x.d && z.c == x.a && z.d == x.b);
      // The diagonal's two base edges of one link meet those of the next in two base vertices.
      std::multiset<int> common;
      const auto here = corners(x.a, x.b), there = corners(y.a, y.b);
      std::set_intersection(here.begin(), here.end(), there.begin(), there.end(),
                            std::inserter(common, common.end()));
      EXPECT_GE(common.size(), 2u);
    }
  }
}

}  // namespace
}  // namespace hexweft
