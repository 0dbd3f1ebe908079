#include "simplify/coarsen.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "ovm/quality.h"
#include "simplify/detail/plan_builder.h"
#include "simplify/sheet.h"

namespace hexweft {
namespace {

double mean_length(const HexMesh& mesh, std::span<const EdgeHandle> edges) {
  double sum = 0;
  for (EdgeHandle e : edges) sum += edge_length(mesh, e);
  return sum / static_cast<double>(edges.size());
}

}  // namespace

std::vector<std::vector<EdgeHandle>> list_spare_layers(const HexMesh& mesh, const BaseComplex& bc) {
  std::vector<std::pair<double, std::vector<EdgeHandle>>> by_length;
  for (const Sheet& sheet : extract_sheets(bc)) {
    if (sheet.kind != SheetKind::open && sheet.kind != SheetKind::closed) continue;
    const auto chain = bc.chain(bc.edges[sheet.edges.front()]);
    for (int i = 1; i < sheet.width; i += 2) {
      DualSheet layer = dual_sheet(mesh, mesh.find_edge(chain[i], chain[i + 1]));
      by_length.emplace_back(mean_length(mesh, layer.edges), std::move(layer.edges));
    }
  }
  std::sort(by_length.begin(), by_length.end());
  std::vector<std::vector<EdgeHandle>> spare;
  spare.reserve(by_length.size());
  for (auto& [length, edges] : by_length) spare.push_back(std::move(edges));
  return spare;
}

std::vector<char> count_ends(const HexMesh& mesh, const BaseComplex& bc) {
  std::vector<char> ends(mesh.vertex_slots(), 0);
  for (const Component& c : bc.components) {
    std::array<int, 3> at;
    const auto is_end = [&](int axis) { return at[axis] == 0 || at[axis] == c.n[axis]; };
    for (at[2] = 0; at[2] <= c.n[2]; ++at[2]) {
      for (at[1] = 0; at[1] <= c.n[1]; ++at[1]) {
        for (at[0] = 0; at[0] <= c.n[0]; ++at[0])
          ends[bc.vertex(c, at[0], at[1], at[2]).idx] =
              static_cast<char>(is_end(0) + is_end(1) + is_end(2));
      }
    }
  }
  return ends;
}

CollapsePlan plan_layer_collapse(const HexMesh& mesh, const DualSheet& layer,
                                 std::span<const char> ends) {
  detail::PlanBuilder builder(mesh);
  for (EdgeHandle e : layer.edges) {
    const auto [a, b] = mesh.vertices(e);
    builder.join(a, b);
  }
  builder.remove(layer.cells());
  CollapsePlan plan = builder.finish(1);
  for (int g = 0; g < plan.n_groups(); ++g) {
    const auto group = plan.group(g);
    const VertexHandle a = group.front(), b = group.back();
    plan.places.push_back(ends[a.idx] > ends[b.idx]   ? mesh.point(a)
                          : ends[a.idx] < ends[b.idx] ? mesh.point(b)
                                                      : (mesh.point(a) + mesh.point(b)) / 2);
  }
  return plan;
}

bool try_coarsen(TrialContext& context, const SingularityGraph& graph, const CollapsePlan& layer,
                 const SimplifyOptions& options) {
  if (context.reference.curves().n_lines() > 0) context.feature_labels();  // for later layers too
  TrialContext strict = context;
  strict.distance_limit *= kNegligible;
  strict.final_limit *= kNegligible;
  // A layer that goes changes no shape by much, as one that is split off.
  SimplifyOptions quick = options;
  quick.splits_per_trial = 0;
  quick.rings = (options.rings + 1) / 2;
  quick.parametrization.max_iterations = 2;
  return try_collapse_locally(strict, graph, layer, quick).accepted();
}

int coarsen(TrialContext& context, const BaseComplex& bc, const SimplifyOptions& options,
            const std::function<bool()>& should_stop) {
  const HexMesh& mesh = context.mesh;
  SingularityGraph graph = bc.graph;
  std::vector<char> stays(mesh.edge_slots(), 0);  // its layer could not go
  int gone = 0;
  const auto take_out = [&](const DualSheet& layer, std::vector<char>& ends) {
    const CollapsePlan plan = plan_layer_collapse(mesh, layer, ends);
    if (!try_coarsen(context, graph, plan, options)) {
      stays.resize(mesh.edge_slots(), 0);
      for (EdgeHandle e : layer.edges) stays[e.idx] = 1;
      return false;
    }
    for (int g = 0; g < plan.n_groups(); ++g) {
      const auto group = plan.group(g);
      ends[group.front().idx] = std::max(ends[group.front().idx], ends[group.back().idx]);
    }
    graph = extract_singularity_graph(mesh);
    context.labels.reset();
    return true;
  };
  for (BaseComplex now = bc;; now = extract_base_complex(mesh)) {
    const int before = gone;
    stays.resize(mesh.edge_slots(), 0);
    std::vector<char> ends = count_ends(mesh, now);
    for (const std::vector<EdgeHandle>& edges : list_spare_layers(mesh, now)) {
      if (should_stop()) return gone;
      const auto left =
          std::find_if(edges.begin(), edges.end(), [&](EdgeHandle e) { return mesh.is_live(e); });
      if (left == edges.end() || stays[left->idx]) continue;
      gone += take_out(dual_sheet(mesh, *left), ends);
    }
    if (gone == before) return gone;
  }
}

}  // namespace hexweft
