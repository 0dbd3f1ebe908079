/// \file
/// Why a candidate is not collapsed.
#pragma once

#include <array>
#include <string_view>

namespace hexweft {

enum class Refusal {
  none,
  // decided from the base complex
  valence,          ///< an edge would get too few or too many cells
  angle,            ///< a single cell would have to fill a wide angle of the boundary
  boundary,         ///< two different stretches of the boundary would be glued
  feature,          ///< two features would be merged
  degenerate_cell,  ///< a cell that stays would lose an edge
  unequal_sides,    ///< chord: its cross-section has different counts of cells
  twisted,          ///< chord: its diagonals fall together, or it crosses itself
  not_singular,     ///< chord: removes no singular edge
  vanishing,        ///< nothing, or a whole part, would be left of it
  // decided from the mesh after the edit
  topology,   ///< not a manifold, or genus or parts changed
  structure,  ///< no fewer components than before, or some no cuboid; or too many cells
  // decided from the geometry
  inverted,  ///< no parametrization without inverted cells was found
  quality,   ///< scaled Jacobian under the floor
  hausdorff  ///< too far from the input's surface
};
inline constexpr int kRefusals = static_cast<int>(Refusal::hausdorff) + 1;

/// Found out by moving vertices: the expensive way.
constexpr bool is_geometric(Refusal r) { return r >= Refusal::inverted; }

/// Of the hexahedra, whatever becomes of the surface.
constexpr bool is_of_shape(Refusal r) { return r == Refusal::inverted || r == Refusal::quality; }

/// Found out from the cells at the vertices that would merge and the features these are on: as long
/// as the cells are the same there it stays so, as a rule, wherever the vertices move.
constexpr bool is_of_connectivity(Refusal r) {
  return r == Refusal::valence || r == Refusal::boundary || r == Refusal::feature ||
         r == Refusal::degenerate_cell || r == Refusal::vanishing || r == Refusal::topology;
}

constexpr std::string_view name(Refusal r) {
  constexpr std::array<std::string_view, kRefusals> names = {
      "none",          "valence", "angle",        "boundary",  "feature",  "degenerate_cell",
      "unequal_sides", "twisted", "not_singular", "vanishing", "topology", "structure",
      "inverted",      "quality", "hausdorff"};
  return names[static_cast<std::size_t>(r)];
}

}  // namespace hexweft
