/// \file
/// Base-complex chords: columns of components through opposite base faces.
#pragma once

#include <array>
#include <vector>

#include "simplify/base_complex.h"

namespace hexweft {

/// A component of a chord. The chord runs along `axis`; its cross-section is the quadrilateral of
/// the four base edges parallel to it, edges 4 * axis + i of the component (hex_numbering.h).
struct ChordLink {
  int component;
  int axis;
  /// true where diagonal 0 of the chord joins the component's parallel edges 1 and 2, false where
  /// it joins 0 and 3
  bool turned = false;
  /// For each of the component's four edges along the chord which one of the first link's it goes on
  /// from; the others are opposite or beside as there.
  std::array<int, 4> group = {0, 1, 2, 3};
};

/// How a chord is collapsed: along which diagonal the cross-section folds.
enum class Diagonal { first = 0, second = 1 };

struct Chord {
  std::vector<ChordLink> links;  ///< in order along the chord
  bool closed = false;           ///< comes back to its start
  bool self_crossing = false;    ///< some component is passed twice
  /// If it is closed, as ChordLink::group of the first link when it is come back to.
  std::array<int, 4> group_at_end = {0, 1, 2, 3};
  /// The diagonals fall together (the chord is twisted by a quarter turn); it cannot be collapsed.
  bool twisted = false;
};

/// All chords, each base face in exactly one; ordered by the lowest component they pass.
/// Cost O(#B_F).
std::vector<Chord> extract_chords(const BaseComplex& bc);

/// The four base edges along the chord at a link: {a, b} on the diagonal whose ends fall together,
/// {c, d} on the other. a, c, b, d run round the cross-section.
struct LinkEdges {
  int a, b, c, d;
};
LinkEdges link_edges(const BaseComplex& bc, const ChordLink& link, Diagonal diagonal);

}  // namespace hexweft
