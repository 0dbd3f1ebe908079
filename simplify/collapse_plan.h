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

/// A mesh edge that comes to be when a plan is carried out, by the vertices that stand for its ends
/// (the first member of a group, or the vertex itself).
struct PredictedEdge {
  VertexHandle a, b;
  int valence;  ///< cells at it
  bool boundary;
  int merged;     ///< mesh edges that fall together in it
  int old_error;  ///< the largest |v - q| among them
  int error() const {
    return valence > (boundary ? 2 : 4) ? valence - (boundary ? 2 : 4)
                                        : (boundary ? 2 : 4) - valence;
  }
};

/// The edges at merged vertices after the collapse. Counting the cells that survive round a group;
/// for two edges this is v_l + v_r - 4, or - 2 where the face between them is on the boundary
/// (spec, "Corrections" to [Xu2021, Eq. 1]). Cost O(size of the plan) + a pass over the vertices.
std::vector<PredictedEdge> predict_edges(const HexMesh& mesh, const SingularityGraph& graph,
                                         const CollapsePlan& plan);

/// Bounds on what a collapse may leave behind.
struct ValenceLimits {
  int min_interior = 3;
  int max_interior = 6;  ///< raised where an edge of the group already exceeds it
  int max_boundary = 5;
};

/// What can be said against a plan without moving anything; Refusal::none is no promise.
Refusal check_plan(const HexMesh& mesh, const SingularityGraph& graph, const CollapsePlan& plan,
                   const ValenceLimits& limits = {});

/// Carries the plan out: removes the cells, merges each group in its first member and puts it on
/// `targets` (one per group). Use inside a Transaction.
/// \return the merged vertices that are left
std::vector<VertexHandle> apply_plan(HexMesh& mesh, const CollapsePlan& plan,
                                     std::span<const Eigen::Vector3d> targets);

/// Where the groups go: the mean of the members on the boundary, of all if none is.
std::vector<Eigen::Vector3d> default_targets(const HexMesh& mesh, const SingularityGraph& graph,
                                             const CollapsePlan& plan);

}  // namespace hexweft
