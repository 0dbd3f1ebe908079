#include "simplify/refine.h"

#include <algorithm>
#include <array>

#include "ovm/edit/split_sheet.h"
#include "ovm/neighborhood.h"
#include "ovm/quality.h"
#include "ovm/transaction.h"
#include "simplify/surface_check.h"

namespace hexweft {
namespace {

struct Measured {
  EdgeHandle first;     // lowest edge of the sheet
  int cells = 0;        // crossed; one that is crossed twice counts twice
  double length = 0;    // mean across, model units
  double distance = 0;  // mean over its boundary sides
};

std::vector<Measured> measure_sheets(const HexMesh& mesh, const SurfaceDistance& distance) {
  const DualSheets sheets = extract_dual_sheets(mesh);
  std::vector<Measured> result(sheets.n_sheets);
  std::vector<int> edges(sheets.n_sheets, 0), sides(sheets.n_sheets, 0);
  for (EdgeHandle e : mesh.edges()) {
    const int sheet = sheets[e];
    result[sheet].length += edge_length(mesh, e);
    if (edges[sheet]++ == 0) result[sheet].first = e;
  }
  for (CellHandle c : mesh.cells()) {
    std::array<int, 3> across;
    for (int axis = 0; axis < 3; ++axis) {
      across[axis] = sheets[mesh.edges(c)[4 * axis]];
      ++result[across[axis]].cells;
    }
    for (HalfFaceHandle hf : mesh.halffaces(c)) {
      if (!mesh.is_boundary(hf)) continue;
      const double d = distance.distance_at(hf);
      for (int axis = 0; axis < 3; ++axis) {
        if (axis == side_axis(HexMesh::side(hf))) continue;
        result[across[axis]].distance += d;
        ++sides[across[axis]];
      }
    }
  }
  for (int i = 0; i < sheets.n_sheets; ++i) {
    result[i].length /= edges[i];
    if (sides[i] > 0) result[i].distance /= sides[i];
  }
  return result;
}

// Relaxes the new vertices, which then meet the surface better. A split changes no shape by much: a
// narrow region and few iterations do. Kept, with the split, only where it does no harm.
bool relax_added(TrialContext& context, std::span<const VertexHandle> added,
                 std::span<const CellHandle> removed, const SimplifyOptions& options) {
  HexMesh& mesh = context.mesh;
  const std::vector<CellHandle> region = cells_around(mesh, added, (options.rings + 1) / 2);
  ParametrizationOptions p = options.parametrization;
  p.max_iterations = 1;
  p.min_scaled_jacobian =
      std::min(options.min_scaled_jacobian, measure_quality(mesh, region).least);
  Transaction relaxed(mesh);
  if (!parametrize(mesh, region, context.reference, p).valid()) return false;
  std::vector<CellHandle> touched = region;
  touched.insert(touched.end(), removed.begin(), removed.end());
  if (!stays_on_surface(context, touched)) return false;
  relaxed.commit();
  return true;
}

}  // namespace

std::vector<EdgeHandle> list_sheets_to_refine(const HexMesh& mesh, const SurfaceDistance& distance,
                                              const RefineOptions& options,
                                              std::span<const EdgeHandle> excluded) {
  const double long_enough = options.min_length_rel * mean_edge_length(mesh);
  std::vector<Measured> candidates;
  for (const Measured& m : measure_sheets(mesh, distance)) {
    const bool known = std::find(excluded.begin(), excluded.end(), m.first) != excluded.end();
    if (m.cells <= options.max_cells && !known && m.length > long_enough) candidates.push_back(m);
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Measured& a, const Measured& b) { return a.distance > b.distance; });
  std::vector<EdgeHandle> order;
  std::vector<Measured> farthest;  // of those left
  for (std::size_t next = 0; order.size() < candidates.size();) {
    while (next < candidates.size() &&
           (farthest.empty() || std::ssize(farthest) < options.by_distance))
      farthest.push_back(candidates[next++]);
    const auto longest =
        std::max_element(farthest.begin(), farthest.end(),
                         [](const Measured& a, const Measured& b) { return a.length < b.length; });
    order.push_back(longest->first);
    farthest.erase(longest);
  }
  return order;
}

bool try_refine(TrialContext& context, const DualSheet& sheet, const SimplifyOptions& options) {
  HexMesh& mesh = context.mesh;
  std::vector<CellHandle> crossed;
  for (const CellAxis& x : sheet.crossings) crossed.push_back(x.cell);
  const double floor = std::min(options.min_scaled_jacobian, measure_quality(mesh, crossed).least);
  Transaction trial(mesh);
  const SheetSplit split = split_sheet(mesh, sheet);
  std::vector<VertexHandle> added;
  for (const SplitVertex& s : split.vertices) added.push_back(s.vertex);
  const std::vector<CellHandle> around = cells_around(mesh, added, 1);
  if (measure_quality(mesh, around).least < floor * (1 - 1e-9)) return false;
  if (!relax_added(context, added, split.removed, options)) {
    // The split alone leaves the surface as it is, but for warped sides.
    std::vector<CellHandle> touched = around;
    touched.insert(touched.end(), split.removed.begin(), split.removed.end());
    if (!stays_on_surface(context, touched)) return false;
  }
  commit(context, trial);
  context.labels.reset();
  return true;
}

}  // namespace hexweft
