/// \file
/// One attempt at a collapse: edit, parametrization, checks; kept or undone.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "optimize/hex_energy.h"
#include "simplify/options.h"
#include "simplify/plan_check.h"
#include "simplify/trial_context.h"

namespace hexweft {

/// What a merge leaves before anything round it has moved: it settles most of what becomes of it.
struct Outlook {
  double distance_rel = 0;  ///< of the boundary sides that changed, limits
  double least = 1;         ///< scaled Jacobian, of the cells at what was merged
};
/// Told of an outlook, what a trial with the same one failed by, or Refusal::none.
using KnownFailure = std::function<Refusal(const Outlook&)>;

/// What an accepted collapse comes to.
struct CollapseOutcome {
  int components = 0;         ///< of the mesh then
  double distance_spent = 0;  ///< what comes nearer to the limit, limits; negative where it recedes
  double quality_spent = 0;   ///< mean scaled Jacobian that the cells round it lose
};

struct TrialResult {
  Refusal refusal = Refusal::none;
  std::optional<Outlook> outlook;  ///< if the trial came so far
  double quality_spent = 0;  ///< if accepted: mean scaled Jacobian that the cells round it lose
  std::vector<int> cause;    ///< groups of the plan round where a geometric one was found, if known
  BaseComplex base_complex;  ///< of the new mesh if accepted by try_collapse(), else empty
  bool accepted() const { return refusal == Refusal::none; }
};

/// An edit before the collapse that belongs to the same trial.
struct EarlierEdit {
  std::vector<VertexHandle> changed;  ///< round these the mesh moves as well
  std::vector<CellHandle> removed;
  Quality quality;  ///< before it, of what moves
};

/// Collapses; on refusal the mesh and the distance are as before. Cheap checks come first: the
/// plan, the topology where it changed, the parametrization, the distance, the new base complex.
TrialResult try_collapse(TrialContext& context, const BaseComplex& bc, const CollapsePlan& plan,
                         const SimplifyOptions& options);

/// The same after an edit: on refusal the mesh is as that has left it, and the distance as before it.
/// \param bc        of the mesh as it is
/// \param n_before  components before the edit, of which fewer have to be left
TrialResult try_collapse_after(const EarlierEdit& edit, TrialContext& context,
                               const BaseComplex& bc, int n_before, const CollapsePlan& plan,
                               const SimplifyOptions& options);

/// The same but for the look at the whole mesh, which costs more than many a trial: the caller makes up
/// for it with check_structure(), for several collapses at once, and must be able to undo them.
/// \param graph  of the mesh; may be out of date beyond the cells at the plan's members, as may
///               TrialContext::labels
/// \param known  ends the trial where it knows better, if not empty
TrialResult try_collapse_locally(TrialContext& context, const SingularityGraph& graph,
                                 const CollapsePlan& plan, const SimplifyOptions& options,
                                 const KnownFailure& known = {});

/// The same, and takes the collapse back whatever comes of it, so that it can be compared with others.
/// \param outcome  set if it is accepted
TrialResult weigh_collapse(TrialContext& context, const BaseComplex& bc, const CollapsePlan& plan,
                           const SimplifyOptions& options, CollapseOutcome& outcome,
                           const KnownFailure& known = {});

/// Whether genus, parts and boundary surfaces are the input's and the base complex is one of cuboids,
/// fewer than before.
/// \param n_before  components
/// \param after     set to the base complex of the mesh as it is
Refusal check_structure(const TrialContext& context, std::size_t n_before, BaseComplex& after);

}  // namespace hexweft
