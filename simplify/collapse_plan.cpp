#include "simplify/collapse_plan.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>

#include "simplify/disjoint_sets.h"

namespace hexweft {
namespace {

// Collects the classes of vertices and the cells of a plan.
class PlanBuilder {
 public:
  explicit PlanBuilder(const HexMesh& mesh) : local_(mesh.vertex_slots(), -1) {}

  void join(VertexHandle a, VertexHandle b) { sets_.join(local(a), local(b)); }
  void remove(std::span<const CellHandle> cells) {
    plan_.removed.insert(plan_.removed.end(), cells.begin(), cells.end());
  }

  CollapsePlan finish(int width) {
    std::sort(plan_.removed.begin(), plan_.removed.end());
    plan_.removed.erase(std::unique(plan_.removed.begin(), plan_.removed.end()),
                        plan_.removed.end());
    std::vector<std::pair<int, VertexHandle>> by_class;
    for (int i = 0; i < sets_.size(); ++i) by_class.emplace_back(sets_.find(i), vertices_[i]);
    std::sort(by_class.begin(), by_class.end());
    for (std::size_t i = 0; i < by_class.size(); ++i) {
      if (i > 0 && by_class[i].first != by_class[i - 1].first) close_group();
      plan_.members.push_back(by_class[i].second);
    }
    if (!plan_.members.empty()) close_group();
    plan_.width = width;
    return std::move(plan_);
  }

 private:
  int local(VertexHandle v) {
    int& id = local_[v.idx];
    if (id < 0) {
      id = sets_.add();
      vertices_.push_back(v);
    }
    return id;
  }
  void close_group() { plan_.group_begin.push_back(static_cast<int>(plan_.members.size())); }

  std::vector<int> local_;  // by vertex handle
  std::vector<VertexHandle> vertices_;
  DisjointSets sets_;
  CollapsePlan plan_;
};

// group_of[v]: the group of each vertex, -1 for those of none.
std::vector<int> groups_of_vertices(const HexMesh& mesh, const CollapsePlan& plan) {
  std::vector<int> group_of(mesh.vertex_slots(), -1);
  for (int g = 0; g < plan.n_groups(); ++g) {
    for (VertexHandle v : plan.group(g)) group_of[v.idx] = g;
  }
  return group_of;
}

bool is_removed(const CollapsePlan& plan, CellHandle c) {
  return std::binary_search(plan.removed.begin(), plan.removed.end(), c);
}

// A cell that stays must not have two vertices of one group.
bool degenerates_a_cell(const HexMesh& mesh, const CollapsePlan& plan,
                        const std::vector<int>& group_of) {
  for (VertexHandle v : plan.members) {
    for (CellHandle c : mesh.cells(v)) {
      int of_this_group = 0;
      for (VertexHandle w : mesh.vertices(c)) of_this_group += group_of[w.idx] == group_of[v.idx];
      if (of_this_group > 1 && !is_removed(plan, c)) return true;
    }
  }
  return false;
}

// The boundary vertices of a group must hang together through boundary sides that go away.
bool glues_boundary(const HexMesh& mesh, const SingularityGraph& graph, const CollapsePlan& plan,
                    const std::vector<int>& group_of) {
  std::vector<int> position(mesh.vertex_slots(), -1);
  for (std::size_t i = 0; i < plan.members.size(); ++i)
    position[plan.members[i].idx] = static_cast<int>(i);
  DisjointSets linked(static_cast<int>(plan.members.size()));
  for (CellHandle c : plan.removed) {
    for (HalfFaceHandle hf : mesh.halffaces(c)) {
      if (!mesh.is_boundary(hf)) continue;
      const QuadVertices quad = mesh.vertices(hf);
      for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < i; ++j) {
          const int a = position[quad[i].idx], b = position[quad[j].idx];
          if (a >= 0 && b >= 0 && group_of[quad[i].idx] == group_of[quad[j].idx]) linked.join(a, b);
        }
      }
    }
  }
  for (int g = 0; g < plan.n_groups(); ++g) {
    int root = -1;
    for (int i = plan.group_begin[g]; i < plan.group_begin[g + 1]; ++i) {
      if (!graph.boundary_vertex[plan.members[i].idx]) continue;
      if (root >= 0 && linked.find(i) != root) return true;
      root = linked.find(i);
    }
  }
  return false;
}

std::vector<PredictedEdge> predict(const HexMesh& mesh, const SingularityGraph& graph,
                                   const CollapsePlan& plan, const std::vector<int>& group_of) {
  const auto stand_in = [&](VertexHandle v) {
    return group_of[v.idx] < 0 ? v : plan.members[plan.group_begin[group_of[v.idx]]];
  };
  std::vector<PredictedEdge> edges;
  for (VertexHandle v : plan.members) {
    for (EdgeHandle e : mesh.edges(v)) {
      const auto ends = mesh.vertices(e);
      VertexHandle a = stand_in(ends[0]), b = stand_in(ends[1]);
      // An edge inside a group goes away; one between two groups is seen from its first end only.
      if (a == b || (v == ends[1] && group_of[ends[0].idx] >= 0)) continue;
      if (b < a) std::swap(a, b);
      int surviving = 0;
      for (CellHandle c : mesh.cells(e)) surviving += !is_removed(plan, c);
      const int error = std::abs(graph.edge_valence[e.idx] - graph.regular_valence(e));
      edges.push_back({a, b, surviving, graph.boundary_edge[e.idx] != 0, 1, error});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const PredictedEdge& x, const PredictedEdge& y) {
    return std::pair(x.a, x.b) < std::pair(y.a, y.b);
  });
  std::size_t n = 0;
  for (const PredictedEdge& e : edges) {
    if (n > 0 && edges[n - 1].a == e.a && edges[n - 1].b == e.b) {
      PredictedEdge& merged = edges[n - 1];
      merged.valence += e.valence;
      merged.boundary |= e.boundary;
      merged.merged += 1;
      merged.old_error = std::max(merged.old_error, e.old_error);
    } else {
      edges[n++] = e;
    }
  }
  edges.resize(n);
  return edges;
}

bool within(const PredictedEdge& e, const ValenceLimits& limits) {
  if (e.boundary)
    return e.valence >= 1 && (e.valence <= limits.max_boundary || e.error() <= e.old_error);
  return e.valence >= limits.min_interior &&
         (e.valence <= limits.max_interior || e.error() <= e.old_error);
}

}  // namespace

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

// Some layers of a sheet that go away, the others close up.
class LayerRemoval {
 public:
  LayerRemoval(const HexMesh& mesh, const BaseComplex& bc, const Sheet& sheet, int n_removed)
      : bc_(bc), sheet_(sheet), removed_(sheet.width, 0) {
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
    for (int i = 0; i < n_removed; ++i) removed_[by_length[i].second] = 1;
  }

  /// Whether layer i of a component along this axis, counted in the component's direction, goes.
  bool removes(const Crossing& x, int i) const {
    const Component& c = bc_.components[x.component];
    const int id = c.edges[4 * x.axis];
    const auto at = std::lower_bound(sheet_.edges.begin(), sheet_.edges.end(), id);
    const bool along = bc_.edges[id].ends[0] == c.corners[kEdgeCorners[4 * x.axis][0]];
    const bool same = along != (sheet_.against[at - sheet_.edges.begin()] != 0);
    return removed_[same ? i : sheet_.width - 1 - i];
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
  const auto axes = section_axes(chord.links.front());
  const auto& n = bc.components[chord.links.front().component].n;
  const int side = std::min(n[axes[0]], n[axes[1]]);
  std::optional<LayerRemoval> shorten;
  if (const int id = sheet_to_shorten(bc, chord, sheets); id >= 0) {
    shorten.emplace(mesh, bc, sheets[id], sheets[id].width - side);
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

std::vector<PredictedEdge> predict_edges(const HexMesh& mesh, const SingularityGraph& graph,
                                         const CollapsePlan& plan) {
  return predict(mesh, graph, plan, groups_of_vertices(mesh, plan));
}

Refusal check_plan(const HexMesh& mesh, const SingularityGraph& graph, const CollapsePlan& plan,
                   const ValenceLimits& limits) {
  if (plan.removed.empty() || static_cast<int>(plan.removed.size()) == mesh.n_cells()) {
    return Refusal::vanishing;
  }
  const std::vector<int> group_of = groups_of_vertices(mesh, plan);
  for (const PredictedEdge& e : predict(mesh, graph, plan, group_of)) {
    if (e.valence == 0) return Refusal::vanishing;
    if (!within(e, limits)) return Refusal::valence;
  }
  if (degenerates_a_cell(mesh, plan, group_of)) return Refusal::degenerate_cell;
  if (glues_boundary(mesh, graph, plan, group_of)) return Refusal::boundary;
  return Refusal::none;
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
