#include "simplify/pillowed_collapse.h"

#include <algorithm>

#include "ovm/neighborhood.h"
#include "simplify/region_relaxation.h"

namespace hexweft {
namespace {

Quality quality_round(const HexMesh& mesh, const BaseComplex& bc, const CollapsePlan& plan,
                      const Pillow& pillow, const SimplifyOptions& options) {
  std::vector<VertexHandle> vertices = wall_of(mesh, bc, pillow);
  vertices.insert(vertices.end(), plan.members.begin(), plan.members.end());
  return measure_quality(mesh, cells_around(mesh, vertices, rings_round(plan, options)));
}

}  // namespace

TrialResult try_pillowed_collapse(TrialContext& context, const BaseComplex& bc, const Sheet& sheet,
                                  const Pillow& pillow, const SimplifyOptions& options) {
  HexMesh& mesh = context.mesh;
  const int most_cells = std::max(context.most_cells, mesh.n_cells());
  const auto n_before = static_cast<int>(bc.components.size());
  const CollapsePlan plan = plan_sheet_collapse(mesh, bc, sheet);
  EarlierEdit edit;
  edit.quality = quality_round(mesh, bc, plan, pillow, options);
  TrialResult result;
  Transaction trial(mesh);
  const auto inserted = insert_pillow(mesh, bc, sheet, plan, pillow);
  const int n_cells =
      mesh.n_cells() - static_cast<int>(inserted ? inserted->plan.removed.size() : 0);
  if (!inserted || n_cells > most_cells) {
    result.refusal = inserted ? Refusal::structure : Refusal::topology;
    return result;
  }
  for (const auto& copy : inserted->layer.copies)
    edit.changed.insert(edit.changed.end(), {copy.outer, copy.inner});
  for (const auto& replaced : inserted->layer.replaced) edit.removed.push_back(replaced.before);
  context.labels.reset();
  result =
      try_collapse_after(edit, context, inserted->base_complex, n_before, inserted->plan, options);
  if (result.accepted()) trial.commit();
  context.labels.reset();
  return result;
}

}  // namespace hexweft
