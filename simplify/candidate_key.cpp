#include "simplify/candidate_key.h"

#include "simplify/collapse_plan.h"
#include "simplify/hash.h"

namespace hexweft {
namespace {

enum class Fold { across, diagonal, layers, peeled };

std::size_t hash_of(Fold fold, int axis, std::size_t which = 0) {
  Hash h;
  h.take(static_cast<int>(fold));
  h.take(axis);
  h.take(which);
  return h.value();
}

// By vertex, of the cells at it in any order.
std::vector<std::size_t> hashes_of_stars(const HexMesh& mesh) {
  std::vector<std::size_t> stars(mesh.vertex_slots(), 0);
  for (CellHandle c : mesh.cells()) {
    const std::size_t h = hash_of_cell(mesh, c);
    for (VertexHandle v : mesh.vertices(c)) stars[v.idx] += h;
  }
  return stars;
}

}  // namespace

std::vector<CandidatePart> parts_of(const Sheet& sheet) {
  std::vector<CandidatePart> parts;
  for (const Crossing& x : sheet.crossings) {
    parts.push_back({x.component, hash_of(Fold::across, x.axis), true});
  }
  return parts;
}

std::vector<CandidatePart> parts_of(const Peel& peel) {
  std::vector<CandidatePart> parts;
  for (const PeeledComponent& p : peel.components)
    parts.push_back({p.component, hash_of(Fold::peeled, p.side), true});
  return parts;
}

std::vector<CandidatePart> parts_of(const HexMesh& mesh, const BaseComplex& bc, const Chord& chord,
                                    Diagonal diagonal, const std::vector<Sheet>& sheets) {
  std::vector<CandidatePart> parts;
  for (const ChordLink& l : chord.links) {
    const bool other = l.turned != (diagonal == Diagonal::second);
    parts.push_back({l.component, hash_of(Fold::diagonal, l.axis, other), true});
  }
  const Shortening shortening = find_shortening(mesh, bc, chord, sheets);
  if (!shortening.sheet) return parts;
  Hash layers;
  for (char removed : shortening.removed) layers.take(removed);
  for (const Crossing& x : shortening.sheet->crossings) {
    parts.push_back({x.component, hash_of(Fold::layers, x.axis, layers.value()), false});
  }
  return parts;
}

CandidateKeys::CandidateKeys(const HexMesh& mesh, const BaseComplex& bc) {
  const std::vector<std::size_t> stars = hashes_of_stars(mesh);
  for (const Component& c : bc.components) {
    Hash itself, surroundings;
    for (CellHandle cell : bc.cells(c)) itself.take(mesh.serial(cell));
    for (VertexHandle v : bc.grid(c)) {
      itself.take(mesh.serial(v));
      surroundings.take(stars[v.idx]);
    }
    of_component_.push_back({itself.value(), surroundings.value()});
  }
}

CandidateKey CandidateKeys::key(std::span<const CandidatePart> parts) const {
  CandidateKey sum;
  for (const CandidatePart& p : parts) {
    const CandidateKey& c = of_component_[p.component];
    sum.itself += mixed(c.itself + p.way);
    sum.surroundings += mixed(c.surroundings + p.way);
  }
  return sum;
}

}  // namespace hexweft
