/// \file
/// What a candidate is made of, in short: enough to leave it alone, or to know it again in a later
/// base complex, without a plan of it.
///
///     const CandidateKeys keys(mesh, bc);
///     const auto parts = parts_of(sheet);
///     if (memory.should_wait(keys.key(parts), step, true)) ...
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "simplify/chord.h"
#include "simplify/peel.h"
#include "simplify/sheet.h"

namespace hexweft {

/// A component that a collapse changes.
struct CandidatePart {
  int component;
  std::size_t way;  ///< hash: across which axis, along which diagonal or by which layers it folds,
                    ///< from which side it is peeled
  bool whole;       ///< all of it goes, not some layers
};
std::vector<CandidatePart> parts_of(const Sheet& sheet);
std::vector<CandidatePart> parts_of(const Peel& peel);
/// \param sheets  all of this base complex
/// \pre can_plan(chord) is Refusal::none
std::vector<CandidatePart> parts_of(const HexMesh& mesh, const BaseComplex& bc, const Chord& chord,
                                    Diagonal diagonal, const std::vector<Sheet>& sheets);

/// Two hashes. As long as an edit leaves a candidate's cells and vertices alone it keeps the first,
/// and the second as long as all cells at its vertices are the same.
struct CandidateKey {
  std::size_t itself = 0;
  std::size_t surroundings = 0;
};

/// The keys of the candidates of one base complex. Cost O(#cells), then O(#parts) each.
class CandidateKeys {
 public:
  CandidateKeys(const HexMesh& mesh, const BaseComplex& bc);
  CandidateKey key(std::span<const CandidatePart> parts) const;

 private:
  std::vector<CandidateKey> of_component_;
};

}  // namespace hexweft
