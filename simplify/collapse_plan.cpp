#include "simplify/collapse_plan.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>

#include "simplify/detail/plan_builder.h"

namespace hexweft {

using detail::PlanBuilder;

CollapsePlan plan_sheet_collapse(const HexMesh& mesh, const BaseComplex& bc, const Sheet& sheet) {
  PlanBuilder builder(mesh);
  for (const Crossing& x : sheet.crossings) {
    const Component& c = bc.components[x.component];
    const int u = (x.axis + 1) % 3, v = (x.axis + 2) % 3;
    std::array<int, 3> at;
    for (at[u] = 0; at[u] <= c.n[u]; ++at[u]) {
      for (at[v] = 0; at[v] <= c.n[v]; ++at[v]) {
        at[x.axis] = 0;
        const VertexHandle first = bc.vertex(c, at[0], at[1], at[2]);
        for (at[x.axis] = 1; at[x.axis] <= c.n[x.axis]; ++at[x.axis]) {
          builder.join(first, bc.vertex(c, at[0], at[1], at[2]));
        }
      }
    }
    builder.remove(bc.cells(c));
  }
  return builder.finish(sheet.width);
}

namespace {

// The axes of a link's cross-section, in the order that numbers its parallel edges: 0 and 3 are at
// (0, 0) and (n, n).
std::array<int, 2> section_axes(const ChordLink& l) {
  return {l.axis == 0 ? 1 : 0, l.axis == 2 ? 1 : 2};
}

// The sheet across the longer side of a chord's cross-section; -1 if the sides are equal.
int sheet_to_shorten(const BaseComplex& bc, const Chord& chord, const std::vector<Sheet>& sheets) {
  const ChordLink& l = chord.links.front();
  const Component& c = bc.components[l.component];
  const auto [u, v] = section_axes(l);
  if (c.n[u] == c.n[v]) return -1;
  const int edge = c.edges[4 * (c.n[u] > c.n[v] ? u : v)];
  int id = 0;
  while (!std::binary_search(sheets[id].edges.begin(), sheets[id].edges.end(), edge)) ++id;
  return id;
}

// Cells along the shorter side of its cross-section.
int side_of(const BaseComplex& bc, const Chord& chord) {
  const auto [u, v] = section_axes(chord.links.front());
  const auto& n = bc.components[chord.links.front().component].n;
  return std::min(n[u], n[v]);
}

// Which layers of a sheet go, in its direction: the thinnest.
std::vector<char> thinnest_layers(const HexMesh& mesh, const BaseComplex& bc, const Sheet& sheet,
                                  int n) {
  std::vector<std::pair<double, int>> by_length(sheet.width);
  for (int i = 0; i < sheet.width; ++i) by_length[i] = {0.0, i};
  for (std::size_t i = 0; i < sheet.edges.size(); ++i) {
    const auto chain = bc.chain(bc.edges[sheet.edges[i]]);
    for (int k = 0; k < sheet.width; ++k) {
      const int layer = sheet.against[i] ? sheet.width - 1 - k : k;
      by_length[layer].first += (mesh.point(chain[k + 1]) - mesh.point(chain[k])).norm();
    }
  }
  std::sort(by_length.begin(), by_length.end());
  std::vector<char> removed(sheet.width, 0);
  for (int i = 0; i < n; ++i) removed[by_length[i].second] = 1;
  return removed;
}

// Some layers of a sheet that go away, the others close up.
class LayerRemoval {
 public:
  LayerRemoval(const BaseComplex& bc, const Sheet& sheet, std::vector<char> removed)
      : bc_(bc), sheet_(sheet), removed_(std::move(removed)) {}

  /// Whether layer i of a component along this axis, counted in the component's direction, goes.
  bool removes(const Crossing& x, int i) const {
    return removed_[runs_against(bc_, sheet_, x) ? sheet_.width - 1 - i : i];
  }

  /// Grid coordinates along the axis of which none is closed up with an earlier one.
  std::vector<int> remaining(const Crossing& x) const {
    std::vector<int> result = {0};
    for (int i = 0; i < sheet_.width; ++i) {
      if (!removes(x, i)) result.push_back(i + 1);
    }
    return result;
  }

  void add_to(PlanBuilder& builder) const {
    for (const Crossing& x : sheet_.crossings) {
      for (int i = 0; i < sheet_.width; ++i) {
        if (removes(x, i)) add_layer(builder, x, i);
      }
    }
  }

 private:
  void add_layer(PlanBuilder& builder, const Crossing& x, int layer) const {
    const Component& c = bc_.components[x.component];
    const int u = (x.axis + 1) % 3, v = (x.axis + 2) % 3;
    std::array<int, 3> at;
    for (at[u] = 0; at[u] <= c.n[u]; ++at[u]) {
      for (at[v] = 0; at[v] <= c.n[v]; ++at[v]) {
        std::array<int, 3> low = at, high = at;
        low[x.axis] = layer, high[x.axis] = layer + 1;
        builder.join(bc_.vertex(c, low[0], low[1], low[2]),
                     bc_.vertex(c, high[0], high[1], high[2]));
        if (at[u] == c.n[u] || at[v] == c.n[v]) continue;
        const CellHandle cell = bc_.cell(c, low[0], low[1], low[2]);
        builder.remove({&cell, 1});
      }
    }
  }

  const BaseComplex& bc_;
  const Sheet& sheet_;
  std::vector<char> removed_;
};

// Folds one component of a chord; the coordinates of its cross-section that remain are given.
void fold(PlanBuilder& builder, const BaseComplex& bc, const ChordLink& l, bool other,
          const std::array<std::vector<int>, 2>& remaining) {
  const Component& c = bc.components[l.component];
  const auto [u, v] = section_axes(l);
  const int side = static_cast<int>(remaining[0].size()) - 1;
  std::array<int, 3> at;
  for (at[l.axis] = 0; at[l.axis] <= c.n[l.axis]; ++at[l.axis]) {
    for (int i = 0; i < side; ++i) {
      for (int j = 0; j < side; ++j) {
        // One cell's folding diagonal; along the lines these make, all become one.
        std::array<int, 3> from = at, to = at;
        from[u] = remaining[0][i], to[u] = remaining[0][i + 1];
        from[v] = remaining[1][other ? j + 1 : j], to[v] = remaining[1][other ? j : j + 1];
        builder.join(bc.vertex(c, from[0], from[1], from[2]), bc.vertex(c, to[0], to[1], to[2]));
      }
    }
  }
  builder.remove(bc.cells(c));
}

std::vector<int> all_coordinates(int n) {
  std::vector<int> result(n + 1);
  std::iota(result.begin(), result.end(), 0);
  return result;
}

}  // namespace

Shortening find_shortening(const HexMesh& mesh, const BaseComplex& bc, const Chord& chord,
                           const std::vector<Sheet>& sheets) {
  const int id = sheet_to_shorten(bc, chord, sheets);
  if (id < 0) return {};
  return {&sheets[id],
          thinnest_layers(mesh, bc, sheets[id], sheets[id].width - side_of(bc, chord))};
}

Refusal can_plan(const BaseComplex& bc, const Chord& chord, const std::vector<Sheet>& sheets) {
  if (chord.twisted || chord.self_crossing) return Refusal::twisted;
  const int id = sheet_to_shorten(bc, chord, sheets);
  const bool simple =
      id < 0 || sheets[id].kind == SheetKind::open || sheets[id].kind == SheetKind::closed;
  return simple ? Refusal::none : Refusal::unequal_sides;
}

CollapsePlan plan_chord_collapse(const HexMesh& mesh, const BaseComplex& bc, const Chord& chord,
                                 Diagonal diagonal, const std::vector<Sheet>& sheets) {
  PlanBuilder builder(mesh);
  const int side = side_of(bc, chord);
  std::optional<LayerRemoval> shorten;
  if (Shortening s = find_shortening(mesh, bc, chord, sheets); s.sheet) {
    shorten.emplace(bc, *s.sheet, std::move(s.removed));
    shorten->add_to(builder);
  }
  for (const ChordLink& l : chord.links) {
    const auto section = section_axes(l);
    std::array<std::vector<int>, 2> remaining;
    for (int i = 0; i < 2; ++i) {
      const int cells = bc.components[l.component].n[section[i]];
      remaining[i] =
          cells == side ? all_coordinates(cells) : shorten->remaining({l.component, section[i]});
    }
    fold(builder, bc, l, l.turned != (diagonal == Diagonal::second), remaining);
  }
  return builder.finish(side);
}

std::vector<VertexHandle> apply_plan(HexMesh& mesh, const CollapsePlan& plan,
                                     std::span<const Eigen::Vector3d> targets) {
  for (CellHandle c : plan.removed) mesh.delete_cell(c);
  std::vector<VertexMerge> merges;
  for (int g = 0; g < plan.n_groups(); ++g) {
    const auto members = plan.group(g);
    for (VertexHandle v : members.subspan(1)) merges.push_back({members[0], v});
  }
  mesh.merge_vertices(merges);
  std::vector<VertexHandle> left;
  for (int g = 0; g < plan.n_groups(); ++g) {
    const VertexHandle v = plan.group(g)[0];
    mesh.set_point(v, targets[g]);
    if (mesh.cells(v).empty()) {
      mesh.delete_vertex(v);
    } else {
      left.push_back(v);
    }
  }
  return left;
}

std::vector<Eigen::Vector3d> default_targets(const HexMesh& mesh, const SingularityGraph& graph,
                                             const CollapsePlan& plan) {
  if (!plan.places.empty()) return plan.places;
  std::vector<Eigen::Vector3d> targets(plan.n_groups());
  for (int g = 0; g < plan.n_groups(); ++g) {
    Eigen::Vector3d all = Eigen::Vector3d::Zero(), boundary = all;
    int n_boundary = 0;
    for (VertexHandle v : plan.group(g)) {
      all += mesh.point(v);
      if (!graph.boundary_vertex[v.idx]) continue;
      boundary += mesh.point(v);
      ++n_boundary;
    }
    const auto n = static_cast<double>(plan.group(g).size());
    targets[g] = n_boundary > 0 ? Eigen::Vector3d(boundary / n_boundary) : Eigen::Vector3d(all / n);
  }
  return targets;
}

}  // namespace hexweft
