/// \file
/// The queues of the loop: what could be collapsed, in order, and what is known of earlier
/// failures.
#pragma once

#include <unordered_map>
#include <vector>

#include "simplify/options.h"
#include "simplify/plan_check.h"

namespace hexweft {

/// A sheet or a chord, by its place in the lists of the current base complex.
struct Candidate {
  int index;
  double energy;
};

/// All sheets and chords of a base complex, those of each kind that pass the cheap filters in order
/// of rising energy (ties by index). The energy is what the ranking goes by: SheetTerms::cost() and
/// ChordTerms::cost().
struct CandidateQueues {
  std::vector<Sheet> sheets;
  std::vector<SheetTerms> sheet_terms;
  std::vector<Chord> chords;
  std::vector<ChordTerms> chord_terms;
  std::vector<Candidate> sheet_queue, chord_queue;
};
CandidateQueues make_queues(const HexMesh& mesh, const BaseComplex& bc,
                            const SimplifyOptions& options, Ranking ranking = Ranking::weighted);

/// The filters of a chord that need no plan; Refusal::none is no promise.
/// \param sheets  all of this base complex
Refusal filter_chord(const BaseComplex& bc, const Chord& chord, const ChordTerms& terms,
                     const std::vector<Sheet>& sheets, const SimplifyOptions& options);

/// Remembers which collapses failed. A candidate is known by the cells it would remove; after a
/// failure it waits for a growing number of accepted steps before it is tried again, and after
/// several until its own cells are others.
class FailureMemory {
 public:
  static std::size_t key(const CollapsePlan& plan);
  bool should_wait(std::size_t key, int step, bool patient) const;
  void failed(std::size_t key, int step);
  void forget_all() { failures_.clear(); }

 private:
  struct Failure {
    int step, times;
  };
  std::unordered_map<std::size_t, Failure> failures_;
};

}  // namespace hexweft
