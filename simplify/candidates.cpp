#include "simplify/candidates.h"

#include <algorithm>

namespace hexweft {
namespace {

void sort_by_energy(std::vector<Candidate>& queue) {
  std::stable_sort(queue.begin(), queue.end(),
                   [](const Candidate& a, const Candidate& b) { return a.energy < b.energy; });
}

}  // namespace

Refusal filter_chord(const BaseComplex& bc, const Chord& chord, const ChordTerms& terms,
                     const std::vector<Sheet>& sheets, const SimplifyOptions& options) {
  if (const Refusal r = can_plan(bc, chord, sheets); r != Refusal::none) return r;
  if (terms.singular_groups < 2) return Refusal::not_singular;
  return terms.deviation > options.max_chord_deviation ? Refusal::valence : Refusal::none;
}

CandidateQueues make_queues(const HexMesh& mesh, const BaseComplex& bc,
                            const SimplifyOptions& options, Ranking ranking) {
  CandidateQueues q;
  q.sheets = extract_sheets(bc);
  q.sheet_terms = rank_sheets(mesh, bc, q.sheets, options.weights);
  for (int i = 0; i < static_cast<int>(q.sheets.size()); ++i) {
    q.sheet_queue.push_back({i, q.sheet_terms[i].cost(ranking)});
  }
  sort_by_energy(q.sheet_queue);
  if (!options.chords) return q;
  q.chords = extract_chords(bc);
  q.chord_terms =
      rank_chords(mesh, bc, q.chords, boundary_gaussian_curvature(mesh), options.weights);
  for (int i = 0; i < static_cast<int>(q.chords.size()); ++i) {
    const ChordTerms& t = q.chord_terms[i];
    if (filter_chord(bc, q.chords[i], t, q.sheets, options) != Refusal::none) continue;
    q.chord_queue.push_back({i, t.cost(ranking)});
  }
  sort_by_energy(q.chord_queue);
  return q;
}

}  // namespace hexweft
