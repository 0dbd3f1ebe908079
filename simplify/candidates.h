/// \file
/// The queues of the loop: what could be collapsed, in order.
#pragma once

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

}  // namespace hexweft
