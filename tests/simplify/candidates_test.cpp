// Queues of candidates.
#include "simplify/candidates.h"

#include <algorithm>
#include <set>

#include <gmock/gmock.h>

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

TEST(Candidates, ChordsThatRemoveNoSingularEdgeAreLeftOut) {
  const HexMesh mesh = make_pillowed_grid(5);
  const BaseComplex bc = extract_base_complex(mesh);
  const CandidateQueues q = make_queues(mesh, bc, {});
  ASSERT_EQ(q.chords.size(), q.chord_terms.size());
  std::set<int> queued;
  for (const Candidate& c : q.chord_queue) queued.insert(c.index);
  for (int i = 0; i < static_cast<int>(q.chords.size()); ++i) {
    const ChordTerms& t = q.chord_terms[i];
    EXPECT_EQ(filter_chord(bc, q.chords[i], t, q.sheets, {}) == Refusal::none,
              queued.count(i) == 1);
    const bool passes = can_plan(bc, q.chords[i], q.sheets) == Refusal::none &&
                        t.singular_groups >= 2 &&
                        t.deviation <= SimplifyOptions().max_chord_deviation;
    EXPECT_EQ(queued.count(i) == 1, passes);
  }
}

}  // namespace
}  // namespace hexweft
