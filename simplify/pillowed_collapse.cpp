#include "simplify/pillowed_collapse.h"

#include <algorithm>

#include "ovm/neighborhood.h"
#include "simplify/region_relaxation.h"

namespace hexweft {
namespace {

// What the pillow has pushed aside; not at all where it then leaves the surface, on which it stays
// otherwise but for warped sides. The distance is to be committed if it succeeds.
Refusal relax_round(TrialContext& context, const SheetInsertion& layer, double floor,
                    const SimplifyOptions& options) {
  HexMesh& mesh = context.mesh;
  std::vector<VertexHandle> copies;
  for (const auto& copy : layer.copies) copies.insert(copies.end(), {copy.outer, copy.inner});
  const std::vector<CellHandle> region = cells_around(mesh, copies, options.rings);
  std::vector<CellHandle> touched = region;
  for (const auto& replaced : layer.replaced) touched.push_back(replaced.before);
  ParametrizationOptions p = trial_parametrization(options);
  p.min_scaled_jacobian = floor;
  Transaction relaxed(mesh);
  if (parametrize(mesh, region, context.reference, p).valid() &&
      stays_on_surface(context, touched)) {
    relaxed.commit();
    return Refusal::none;
  }
  relaxed.rollback();
  if (measure_quality(mesh, region).least < floor) return Refusal::quality;
  return stays_on_surface(context, touched) ? Refusal::none : Refusal::hausdorff;
}

}  // namespace

TrialResult try_pillowed_collapse(TrialContext& context, const BaseComplex& bc, const Sheet& sheet,
                                  const Pillow& pillow, const SimplifyOptions& options) {
  HexMesh& mesh = context.mesh;
  const double floor =
      std::min(options.min_scaled_jacobian, measure_quality(mesh, all_cells(mesh)).least);
  const int most_cells = std::max(context.most_cells, mesh.n_cells());
  TrialResult result;
  Transaction trial(mesh);
  const auto inserted = insert_pillow(mesh, bc, sheet, pillow);
  if (!inserted) {
    result.refusal = Refusal::topology;
    return result;
  }
  const SurfaceDistance before = context.distance;
  result.refusal = relax_round(context, inserted->layer, floor, options);
  context.labels.reset();
  if (result.accepted()) {
    context.distance.commit();
    result = try_collapse_locally(context, inserted->base_complex.graph, inserted->plan, options);
  }
  if (result.accepted())
    result.refusal = check_structure(context, bc.components.size(), result.base_complex);
  if (result.accepted() && mesh.n_cells() > most_cells) result.refusal = Refusal::structure;
  context.labels.reset();
  if (result.accepted()) {
    trial.commit();
  } else {
    context.distance = before;
    result.base_complex = {};
  }
  return result;
}

}  // namespace hexweft
