/// \file
/// A collapse, written down before it is made: which cells go and which vertices become one.
/// Sheets and chords of any width and kind come down to the same edit.
#pragma once

#include <span>
#include <vector>

#include "simplify/chord.h"
#include "simplify/refusal.h"
#include "simplify/sheet.h"

namespace hexweft {

struct CollapsePlan {
  std::vector<CellHandle> removed;     ///< ascending
  std::vector<VertexHandle> members;   ///< of the groups, group after group, ascending in each
  std::vector<int> group_begin = {0};  ///< group i is members[group_begin[i] .. group_begin[i + 1])
  /// How many layers of cells fold together: the width of the sheet, the side of the chord.
  int width = 0;
  /// The cells are taken off the boundary instead of being folded up: what lay under them is on the
  /// boundary then. Groups may be of a single vertex.
  bool peels = false;
  std::vector<Eigen::Vector3d> places = {};  ///< where the groups go; empty: to default_targets()

  int n_groups() const { return static_cast<int>(group_begin.size()) - 1; }
  std::span<const VertexHandle> group(int i) const {
    return {members.data() + group_begin[i], members.data() + group_begin[i + 1]};
  }
};

/// Every chain of mesh vertices across the sheet becomes one vertex; chains that share vertices
/// merge.
CollapsePlan plan_sheet_collapse(const HexMesh& mesh, const BaseComplex& bc, const Sheet& sheet);

/// The cross-section is folded along a diagonal: vertices on a line along it become one. Where its
/// sides have different counts of cells, as many layers of the sheet across the longer one are
/// collapsed with it, the thinnest first.
/// \param sheets  all of this base complex
/// \pre can_plan(chord) is Refusal::none
CollapsePlan plan_chord_collapse(const HexMesh& mesh, const BaseComplex& bc, const Chord& chord,
                                 Diagonal diagonal, const std::vector<Sheet>& sheets);
Refusal can_plan(const BaseComplex& bc, const Chord& chord, const std::vector<Sheet>& sheets);

/// What has to go with a chord for the sides of its cross-section to be equal.
struct Shortening {
  const Sheet* sheet = nullptr;  ///< across the longer side, none if they are equal
  std::vector<char> removed;     ///< by layer in the sheet's direction
};
Shortening find_shortening(const HexMesh& mesh, const BaseComplex& bc, const Chord& chord,
                           const std::vector<Sheet>& sheets);

/// Carries the plan out: removes the cells, merges each group in its first member and puts it on
/// `targets` (one per group). Use inside a Transaction.
/// \return the merged vertices that are left
std::vector<VertexHandle> apply_plan(HexMesh& mesh, const CollapsePlan& plan,
                                     std::span<const Eigen::Vector3d> targets);

/// Where the groups go: to the plan's places, if it has any; else the mean of the members on the boundary, of all if none is.
std::vector<Eigen::Vector3d> default_targets(const HexMesh& mesh, const SingularityGraph& graph,
                                             const CollapsePlan& plan);

}  // namespace hexweft
