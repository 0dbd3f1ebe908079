/// \file
/// What can be said of a collapse before it is made: the valences it leaves, and why not.
#pragma once

#include <vector>

#include "simplify/collapse_plan.h"

namespace hexweft {

/// A mesh edge that comes to be when a plan is carried out, by the vertices that stand for its ends
/// (the first member of a group, or the vertex itself).
struct PredictedEdge {
  VertexHandle a, b;
  int valence;  ///< cells at it
  bool boundary;
  int merged;       ///< mesh edges that fall together in it
  int old_error;    ///< the largest |v - q| among them
  int old_least;    ///< the least valence among them
  CellHandle cell;  ///< one that stays at it; invalid if none does
  int error() const {
    return valence > (boundary ? 2 : 4) ? valence - (boundary ? 2 : 4)
                                        : (boundary ? 2 : 4) - valence;
  }
};

/// The edges at merged vertices after the collapse. Counting the cells that survive round a group;
/// for two edges this is v_l + v_r - 4, or - 2 where the face between them is on the boundary
/// (spec, "Corrections" to [Xu2021, Eq. 1]). What a peel uncovers is on the boundary then, and what it
/// takes away is left out. Cost O(size of the plan) + a pass over the vertices.
std::vector<PredictedEdge> predict_edges(const HexMesh& mesh, const SingularityGraph& graph,
                                         const CollapsePlan& plan);

/// Bounds on what a collapse may leave behind.
struct ValenceLimits {
  int min_interior = 3;
  int max_interior = 6;  ///< raised where an edge of the group already exceeds it
  int max_boundary = 5;
  /// (0, 360], interior angle of the boundary at an edge of a single cell that a collapse makes; 360
  /// allows all. On a smooth surface the sheet next to it, whose removal makes most of these, is
  /// what gives the surface cells a good shape.
  double max_angle_deg = 140;
};

/// The groups of a plan at whose edges the limits on valence would not hold, ascending.
std::vector<int> groups_out_of_limits(const HexMesh& mesh, const SingularityGraph& graph,
                                      const CollapsePlan& plan, const ValenceLimits& limits);

/// What can be said against a plan without moving anything; Refusal::none is no promise.
Refusal check_plan(const HexMesh& mesh, const SingularityGraph& graph, const CollapsePlan& plan,
                   const ValenceLimits& limits = {});

}  // namespace hexweft
