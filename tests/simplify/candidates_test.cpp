// Queues of candidates.
#include "simplify/candidates.h"

#include <algorithm>
#include <set>

#include <gmock/gmock.h>

#include "ovm/detail/disjoint_sets.h"
#include "tests/simplify/prediction.h"
#include "tests/simplify/test_meshes.h"

namespace hexweft {
namespace {

bool has_less_energy(const Candidate& a, const Candidate& b) { return a.energy < b.energy; }

TEST(Candidates, QueuesAreInOrderOfEnergy) {
  const HexMesh mesh = make_octree_like(Shape::blob, 8, 2);
  const CandidateQueues q = make_queues(mesh, extract_base_complex(mesh), {});
  EXPECT_TRUE(std::is_sorted(q.sheet_queue.begin(), q.sheet_queue.end(), has_less_energy));
  EXPECT_TRUE(std::is_sorted(q.chord_queue.begin(), q.chord_queue.end(), has_less_energy));
  EXPECT_EQ(q.sheet_queue.size(), q.sheets.size());
  EXPECT_GT(q.chord_queue.size(), 0u);
}

TEST(Candidates, ThicknessIsAnotherOrderOfTheSameCandidates) {
  const HexMesh mesh = make_octree_like(Shape::blob, 8, 2);
  const BaseComplex bc = extract_base_complex(mesh);
  const CandidateQueues weighted = make_queues(mesh, bc, {});
  const CandidateQueues thin = make_queues(mesh, bc, {}, Ranking::thickness);
  EXPECT_TRUE(std::is_sorted(thin.sheet_queue.begin(), thin.sheet_queue.end(), has_less_energy));
  EXPECT_TRUE(std::is_sorted(thin.chord_queue.begin(), thin.chord_queue.end(), has_less_energy));
  EXPECT_EQ(thin.chord_queue.size(), weighted.chord_queue.size());
  std::vector<int> a, b;
  for (const Candidate& c : weighted.sheet_queue) a.push_back(c.index);
  for (const Candidate& c : thin.sheet_queue) {
    b.push_back(c.index);
    EXPECT_EQ(c.energy, thin.sheet_terms[c.index].thickness);
  }
  EXPECT_NE(a, b);
  EXPECT_TRUE(std::is_permutation(a.begin(), a.end(), b.begin(), b.end()));
}

TEST(Candidates, ChordsAreAnOption) {
  const HexMesh mesh = make_pillowed_grid(3);
  SimplifyOptions options;
  options.chords = false;
  const CandidateQueues q = make_queues(mesh, extract_base_complex(mesh), options);
  EXPECT_TRUE(q.chord_queue.empty());
  EXPECT_EQ(q.sheet_queue.size(), 10u);
}

// Singular ones of the lines along a chord, followed by the vertices that edges of one link and the next
// share. Not for closed chords of two links.
int count_singular_lines(const BaseComplex& bc, const Chord& chord) {
  detail::DisjointSets lines(4 * static_cast<int>(chord.links.size()));
  const auto edge = [&](int i) -> const BaseEdge& {
    const ChordLink& l = chord.links[i / 4];
    return bc.edges[bc.components[l.component].edges[4 * l.axis + i % 4]];
  };
  const auto meet = [](const BaseEdge& a, const BaseEdge& b) {
    return std::find_first_of(a.ends.begin(), a.ends.end(), b.ends.begin(), b.ends.end()) !=
           a.ends.end();
  };
  const int n = lines.size(), last = chord.closed ? n : n - 4;
  for (int i = 0; i < last; ++i) {
    const int next = (i / 4 + 1) * 4 % n;
    for (int j = next; j < next + 4; ++j) {
      if (meet(edge(i), edge(j))) lines.join(i, j);
    }
  }
  std::set<int> singular;
  for (int i = 0; i < n; ++i) {
    if (edge(i).singular) singular.insert(lines.find(i));
  }
  return static_cast<int>(singular.size());
}

TEST(Candidates, ChordsThatRemoveNoSingularEdgeAreLeftOut) {
  int left_out = 0;
  for (const HexMesh& mesh : {make_pillowed_grid(5), make_octree_like(Shape::blob, 8, 2),
                              make_octree_like(Shape::torus, 10)}) {
    const BaseComplex bc = extract_base_complex(mesh);
    const CandidateQueues q = make_queues(mesh, bc, {});
    ASSERT_EQ(q.chords.size(), q.chord_terms.size());
    std::set<int> queued;
    for (const Candidate& c : q.chord_queue) queued.insert(c.index);
    for (int i = 0; i < static_cast<int>(q.chords.size()); ++i) {
      const Chord& chord = q.chords[i];
      if (chord.self_crossing || (chord.closed && chord.links.size() == 2)) continue;
      const int lines = count_singular_lines(bc, chord);
      EXPECT_EQ(q.chord_terms[i].singular_groups, lines);
      if (can_plan(bc, chord, q.sheets) != Refusal::none) continue;
      const bool deviates = q.chord_terms[i].deviation > SimplifyOptions().max_chord_deviation;
      EXPECT_EQ(queued.count(i) == 1, lines >= 2 && !deviates);
      left_out += lines < 2;
    }
  }
  EXPECT_GT(left_out, 0);
}

}  // namespace
}  // namespace hexweft
