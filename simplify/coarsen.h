/// \file
/// Coarsening: layers of cells go out of sheets that have several, where neither the surface nor the
/// hexahedra suffer. The inverse of refinement (refine.h): it leaves the base complex as it is, and
/// whatever is tried afterwards has fewer cells to move.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "ovm/dual.h"
#include "simplify/base_complex.h"
#include "simplify/collapse_plan.h"
#include "simplify/trial.h"

namespace hexweft {

/// Every second layer of each sheet that has several and neither touches nor crosses itself: as lists
/// of parallel mesh edges, ascending, those shortest on the mean first. Any of them may go: the others
/// lose cells by it, but not all of their edges. Cost O(#cells).
std::vector<std::vector<EdgeHandle>> list_spare_layers(const HexMesh& mesh, const BaseComplex& bc);

/// By vertex handle, along how many axes it is at an end of its component: 3 for base vertices, 2 on
/// base edges, 1 on base faces, 0 within components.
std::vector<char> count_ends(const HexMesh& mesh, const BaseComplex& bc);

/// The two sides of the layer become one. Where one of them is a side of components, which sharp edges
/// and singular ones are on, it stays in its place; else they meet halfway.
/// \param layer  crosses no cell twice
/// \param ends   count_ends()
CollapsePlan plan_layer_collapse(const HexMesh& mesh, const DualSheet& layer,
                                 std::span<const char> ends);

/// Collapses a layer and relaxes round it.
/// \param graph  of the mesh
/// \param layer  plan_layer_collapse()
/// \return false (and all as before) if that takes more of the distance than the loop can tell, a
///         feature, or the quality under the floors of the options
bool try_coarsen(TrialContext& context, const SingularityGraph& graph, const CollapsePlan& layer,
                 const SimplifyOptions& options);

/// Takes out spare layers until none can go any more, each sheet halved before one is halved again.
/// \param bc           of the mesh
/// \param should_stop  asked between two layers
/// \return how many went
int coarsen(TrialContext& context, const BaseComplex& bc, const SimplifyOptions& options,
            const std::function<bool()>& should_stop);

}  // namespace hexweft
