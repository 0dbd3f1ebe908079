#include "simplify/trial.h"

#include <algorithm>
#include <limits>

#include "optimize/hex_energy.h"
#include "ovm/neighborhood.h"
#include "ovm/topology_check.h"
#include "simplify/feature_targets.h"
#include "simplify/region_relaxation.h"

namespace hexweft {
namespace {

int euler_of_live(const HexMesh& mesh) {
  return mesh.n_vertices() - mesh.n_edges() + mesh.n_faces() - mesh.n_cells();
}

// The vertices and those next to them, some of them several times. A merge can make a doublet at a
// neighbour: two of its edges become one.
std::vector<VertexHandle> with_neighbors(const HexMesh& mesh, std::span<const VertexHandle> some) {
  std::vector<VertexHandle> all(some.begin(), some.end());
  for (VertexHandle v : some) {
    for (EdgeHandle e : mesh.edges(v)) all.push_back(mesh.other_end(e, v));
  }
  return all;
}

Refusal check_topology_after(const HexMesh& mesh, std::span<const VertexHandle> left, int euler) {
  if (left.empty()) return Refusal::vanishing;
  if (euler_of_live(mesh) != euler) return Refusal::topology;
  const bool clean = is_clean(mesh, with_neighbors(mesh, left), Severity::degenerate);
  return clean ? Refusal::none : Refusal::topology;
}

// Genus is kept by the Euler number and the count of boundary surfaces and parts.
bool same_shape(const TopologySummary& a, const TopologySummary& b) {
  return a.n_parts == b.n_parts && a.n_boundary_components == b.n_boundary_components &&
         a.genus == b.genus;
}

// Empty if the plan does away with a feature.
std::optional<std::vector<Eigen::Vector3d>> targets_of(TrialContext& context,
                                                       const SingularityGraph& graph,
                                                       const CollapsePlan& plan) {
  const FeatureCurves& curves = context.reference.curves();
  if (curves.n_lines() == 0) return default_targets(context.mesh, graph, plan);
  return feature_targets(context.mesh, graph, plan, context.feature_labels(), curves);
}

// Of a plan that was carried out: the group that was merged nearest to the place, and those round it.
std::vector<int> groups_near(const HexMesh& mesh, const CollapsePlan& plan,
                             const Eigen::Vector3d& place) {
  constexpr int kRings = 2;
  VertexHandle nearest;
  double least = std::numeric_limits<double>::infinity();
  for (int g = 0; g < plan.n_groups(); ++g) {
    const VertexHandle v = plan.group(g)[0];
    if (!mesh.is_live(v)) continue;
    const double d = (mesh.point(v) - place).squaredNorm();
    if (d < least) least = d, nearest = v;
  }
  if (!nearest.valid()) return {};
  std::vector<VertexHandle> round;
  for (CellHandle c : cells_around(mesh, {&nearest, 1}, kRings)) {
    const auto vertices = mesh.vertices(c);
    round.insert(round.end(), vertices.begin(), vertices.end());
  }
  std::sort(round.begin(), round.end());
  std::vector<int> near;
  for (int g = 0; g < plan.n_groups(); ++g) {
    if (std::binary_search(round.begin(), round.end(), plan.group(g)[0])) near.push_back(g);
  }
  return near;
}

// Gives up looking at the distance where that is reason enough to give up the trial.
Outlook outlook_after(TrialContext& context, std::span<const CellHandle> gone,
                      std::span<const VertexHandle> left, double give_up_factor) {
  const StageTimer timer(context.clock, Stage::distance);
  std::vector<CellHandle> changed = cells_around(context.mesh, left, 1);
  Outlook outlook;
  outlook.least = measure_quality(context.mesh, changed).least;
  changed.insert(changed.end(), gone.begin(), gone.end());
  const double limit = give_up_factor * context.distance_limit;
  outlook.distance_rel =
      context.distance.after_change(context.mesh, changed, limit) / context.distance_limit;
  context.distance.rollback();
  return outlook;
}

EarlierEdit no_edit(const HexMesh& mesh, const CollapsePlan& plan, const SimplifyOptions& options) {
  const std::vector<CellHandle> before =
      cells_around(mesh, plan.members, rings_round(plan, options));
  return {{}, {}, measure_quality(mesh, before)};
}

// Within an open transaction. If accepted, the distance is still to be committed, else it is as before.
TrialResult collapse_and_relax(TrialContext& context, const SingularityGraph& graph,
                               const CollapsePlan& plan, const SimplifyOptions& options,
                               const KnownFailure& known = {}, const EarlierEdit* edit = nullptr) {
  HexMesh& mesh = context.mesh;
  TrialResult result;
  {
    const StageTimer timer(context.clock, Stage::plan_check);
    result.refusal = check_plan(mesh, graph, plan, options.valence);
  }
  if (!result.accepted()) return result;

  const auto targets = targets_of(context, graph, plan);
  if (!targets) {
    result.refusal = Refusal::feature;
    return result;
  }
  const int euler = euler_of_live(mesh);
  auto [moving, gone, old] = edit ? *edit : no_edit(mesh, plan, options);
  const auto left = apply_plan(mesh, plan, *targets);
  result.refusal = check_topology_after(mesh, left, euler);
  if (!result.accepted()) return result;

  moving.insert(moving.end(), left.begin(), left.end());
  std::erase_if(moving, [&](VertexHandle v) { return !mesh.is_live(v); });
  gone.insert(gone.end(), plan.removed.begin(), plan.removed.end());
  result.outlook = outlook_after(context, gone, moving, options.merged_give_up_factor);
  if (result.outlook->distance_rel > options.merged_give_up_factor) {
    result.refusal = Refusal::hausdorff;
    if (const auto& place = context.distance.too_far_at())
      result.cause = groups_near(mesh, plan, *place);
  } else if (known) {
    result.refusal = known(*result.outlook);
  }
  if (!result.accepted()) return result;

  const RegionResult relaxed =
      relax_region(context, plan, moving, gone, old, *result.outlook, options);
  result.refusal = relaxed.refusal;
  result.quality_spent = old.mean - relaxed.quality.mean;
  if (relaxed.failed_at) result.cause = groups_near(mesh, plan, *relaxed.failed_at);
  return result;
}

// Within an open transaction. What takes a look at the whole mesh comes last: it hardly ever finds
// anything. \return whether the collapse and all before it are to stay
bool ends_simpler(TrialContext& context, std::size_t n_before, TrialResult& result) {
  if (!result.accepted()) return false;
  result.refusal = check_structure(context, n_before, result.base_complex);
  if (result.accepted()) {
    context.labels.reset();
    return true;
  }
  context.distance.rollback();
  result.base_complex = {};
  return false;
}

}  // namespace

Refusal check_structure(const TrialContext& context, std::size_t n_before, BaseComplex& after) {
  const StageTimer timer(context.clock, Stage::structure);
  // A hole that moved from one part to another shows only here.
  if (!same_shape(context.shape, summarize_topology(context.mesh))) return Refusal::topology;
  after = extract_base_complex(context.mesh);
  const bool simpler = after.irregular == 0 && after.components.size() < n_before;
  return simpler ? Refusal::none : Refusal::structure;
}

TrialResult try_collapse_locally(TrialContext& context, const SingularityGraph& graph,
                                 const CollapsePlan& plan, const SimplifyOptions& options,
                                 const KnownFailure& known) {
  Transaction trial(context.mesh);
  TrialResult result = collapse_and_relax(context, graph, plan, options, known);
  if (result.accepted()) commit(context, trial);
  return result;
}

TrialResult weigh_collapse(TrialContext& context, const BaseComplex& bc, const CollapsePlan& plan,
                           const SimplifyOptions& options, CollapseOutcome& outcome,
                           const KnownFailure& known) {
  Transaction trial(context.mesh);
  const double before = context.distance.distance();
  TrialResult result = collapse_and_relax(context, bc.graph, plan, options, known);
  if (!result.accepted()) return result;
  outcome.distance_spent = (context.distance.distance() - before) / context.distance_limit;
  outcome.quality_spent = result.quality_spent;
  context.distance.rollback();
  BaseComplex after;
  result.refusal = check_structure(context, bc.components.size(), after);
  outcome.components = static_cast<int>(after.components.size());
  return result;
}

TrialResult try_collapse(TrialContext& context, const BaseComplex& bc, const CollapsePlan& plan,
                         const SimplifyOptions& options) {
  Transaction trial(context.mesh);
  TrialResult result = collapse_and_relax(context, bc.graph, plan, options);
  if (ends_simpler(context, bc.components.size(), result)) commit(context, trial);
  return result;
}

TrialResult try_collapse_after(const EarlierEdit& edit, TrialContext& context,
                               const BaseComplex& bc, int n_before, const CollapsePlan& plan,
                               const SimplifyOptions& options) {
  Transaction trial(context.mesh);
  TrialResult result = collapse_and_relax(context, bc.graph, plan, options, {}, &edit);
  if (ends_simpler(context, n_before, result)) commit(context, trial);
  return result;
}

}  // namespace hexweft
