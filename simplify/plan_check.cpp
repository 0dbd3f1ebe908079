#include "simplify/plan_check.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "ovm/detail/disjoint_sets.h"
#include "ovm/detail/sort_unique.h"

namespace hexweft {
namespace {

// What becomes of the vertices and cells of a plan.
struct Merging {
  Merging(const HexMesh& mesh, const CollapsePlan& p)
      : plan(p), group_of(mesh.vertex_slots(), -1), removed(mesh.cell_slots(), 0) {
    for (int g = 0; g < plan.n_groups(); ++g) {
      for (VertexHandle v : plan.group(g)) group_of[v.idx] = g;
    }
    for (CellHandle c : plan.removed) removed[c.idx] = 1;
  }
  VertexHandle stand_in(VertexHandle v) const {
    const int g = group_of[v.idx];
    return g < 0 ? v : plan.members[plan.group_begin[g]];
  }

  const CollapsePlan& plan;
  std::vector<int> group_of;  // by vertex, -1 for those of none
  std::vector<char> removed;  // by cell
};

// A cell that stays must not have two vertices of one group.
bool degenerates_a_cell(const HexMesh& mesh, const Merging& m) {
  for (VertexHandle v : m.plan.members) {
    for (CellHandle c : mesh.cells(v)) {
      if (m.removed[c.idx]) continue;
      int of_this_group = 0;
      for (VertexHandle w : mesh.vertices(c))
        of_this_group += m.group_of[w.idx] == m.group_of[v.idx];
      if (of_this_group > 1) return true;
    }
  }
  return false;
}

// The boundary vertices of a group must hang together through boundary sides that go away.
bool glues_boundary(const HexMesh& mesh, const SingularityGraph& graph, const Merging& m) {
  const CollapsePlan& plan = m.plan;
  std::vector<int> position(mesh.vertex_slots(), -1);
  for (std::size_t i = 0; i < plan.members.size(); ++i)
    position[plan.members[i].idx] = static_cast<int>(i);
  detail::DisjointSets linked(static_cast<int>(plan.members.size()));
  for (CellHandle c : plan.removed) {
    for (HalfFaceHandle hf : mesh.halffaces(c)) {
      if (!mesh.is_boundary(hf)) continue;
      const QuadVertices quad = mesh.vertices(hf);
      for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < i; ++j) {
          const int a = position[quad[i].idx], b = position[quad[j].idx];
          if (a >= 0 && b >= 0 && m.group_of[quad[i].idx] == m.group_of[quad[j].idx])
            linked.join(a, b);
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

// Edge e as it will be on its own, between a and b.
PredictedEdge survivor(const HexMesh& mesh, const SingularityGraph& graph, const Merging& m,
                       EdgeHandle e, VertexHandle a, VertexHandle b) {
  int surviving = 0;
  CellHandle cell;
  for (CellHandle c : mesh.cells(e)) {
    if (m.removed[c.idx]) continue;
    ++surviving;
    cell = c;
  }
  const int valence = graph.edge_valence[e.idx];
  const int error = std::abs(valence - graph.regular_valence(e));
  const bool exposed = m.plan.peels && surviving < valence;
  return {a, b, surviving, exposed || graph.boundary_edge[e.idx], 1, error, valence, cell};
}

void take_up(PredictedEdge& merged, const PredictedEdge& e) {
  merged.valence += e.valence;
  merged.boundary |= e.boundary;
  merged.merged += 1;
  if (e.cell.valid()) merged.cell = e.cell;
  merged.old_least = std::min(merged.old_least, e.old_least);
  merged.old_error = std::max(merged.old_error, e.old_error);
}

// Calls `take` with the edges there will be at each group, until it returns false. One between two
// groups is seen from the earlier group only. \return whether it never did
template <class Take>
bool for_each_predicted(const HexMesh& mesh, const SingularityGraph& graph, const Merging& m,
                        Take&& take) {
  std::vector<std::pair<VertexHandle, EdgeHandle>> around;  // by the stand-in of the other end
  for (int g = 0; g < m.plan.n_groups(); ++g) {
    around.clear();
    for (VertexHandle v : m.plan.group(g)) {
      for (EdgeHandle e : mesh.edges(v)) {
        const VertexHandle w = mesh.other_end(e, v);
        const int other = m.group_of[w.idx];
        if (other < 0 || other > g) around.emplace_back(m.stand_in(w), e);
      }
    }
    std::sort(around.begin(), around.end());
    const VertexHandle here = m.plan.group(g)[0];
    for (std::size_t i = 0; i < around.size();) {
      const auto [a, b] = std::minmax(here, around[i].first);
      PredictedEdge merged = survivor(mesh, graph, m, around[i].second, a, b);
      for (++i; i < around.size() && around[i].first == around[i - 1].first; ++i) {
        take_up(merged, survivor(mesh, graph, m, around[i].second, a, b));
      }
      if (merged.valence == 0 && m.plan.peels) continue;
      if (!take(merged)) return false;
    }
  }
  return true;
}

bool within(const PredictedEdge& e, const ValenceLimits& limits) {
  if (e.boundary)
    return e.valence >= 1 && (e.valence <= limits.max_boundary || e.error() <= e.old_error);
  return e.valence >= limits.min_interior &&
         (e.valence <= limits.max_interior || e.error() <= e.old_error);
}

// Interior angle between the two sides of a cell at an edge, with the merged vertices in their new
// places, degrees.
double angle_at(const HexMesh& mesh, const PredictedEdge& e, const Merging& m,
                const std::vector<Eigen::Vector3d>& targets) {
  Eigen::Vector3d normals[2], middles[2];
  int n = 0;
  for (HalfFaceHandle side : mesh.halffaces(e.cell)) {
    Eigen::Vector3d p[4];
    int at_ends = 0, i = 0;
    for (VertexHandle v : mesh.vertices(side)) {
      const int g = m.group_of[v.idx];
      const VertexHandle stand_in = m.stand_in(v);
      at_ends += stand_in == e.a || stand_in == e.b;
      p[i++] = g < 0 ? mesh.point(v) : targets[g];
    }
    if (at_ends < 2 || n == 2) continue;
    normals[n] = (p[2] - p[0]).cross(p[3] - p[1]).normalized();
    middles[n++] = (p[0] + p[1] + p[2] + p[3]) / 4;
  }
  const double turn = std::atan2(normals[0].cross(normals[1]).norm(), normals[0].dot(normals[1]));
  const bool convex = (middles[1] - middles[0]).dot(normals[0] - normals[1]) < 0;
  return 180 - (convex ? turn : -turn) * 180 / std::numbers::pi;
}

// The edges of cells that go which keep both ends lose these cells: those on a chord's other diagonal.
// What a peel takes away lies outside of the surface then.
bool leaves_too_few(const HexMesh& mesh, const SingularityGraph& graph, const Merging& m,
                    const ValenceLimits& limits) {
  if (m.plan.peels) return false;
  for (CellHandle c : m.plan.removed) {
    for (EdgeHandle e : mesh.edges(c)) {
      const auto [a, b] = mesh.vertices(e);
      if (m.group_of[a.idx] >= 0 || m.group_of[b.idx] >= 0) continue;
      if (!within(survivor(mesh, graph, m, e, a, b), limits)) return true;
    }
  }
  return false;
}

// A cell alone at a boundary edge fills the whole angle there: on a smooth surface it is flat.
bool opens_too_wide(const HexMesh& mesh, const SingularityGraph& graph, const Merging& m,
                    const std::vector<PredictedEdge>& newly_alone, double max_angle_deg) {
  if (newly_alone.empty()) return false;
  const std::vector<Eigen::Vector3d> targets = default_targets(mesh, graph, m.plan);
  return std::any_of(newly_alone.begin(), newly_alone.end(), [&](const PredictedEdge& e) {
    return angle_at(mesh, e, m, targets) > max_angle_deg;
  });
}

}  // namespace

std::vector<PredictedEdge> predict_edges(const HexMesh& mesh, const SingularityGraph& graph,
                                         const CollapsePlan& plan) {
  std::vector<PredictedEdge> edges;
  for_each_predicted(mesh, graph, Merging(mesh, plan), [&](const PredictedEdge& e) {
    edges.push_back(e);
    return true;
  });
  return edges;
}

std::vector<int> groups_out_of_limits(const HexMesh& mesh, const SingularityGraph& graph,
                                      const CollapsePlan& plan, const ValenceLimits& limits) {
  const Merging merging(mesh, plan);
  std::vector<int> groups;
  for_each_predicted(mesh, graph, merging, [&](const PredictedEdge& e) {
    if (within(e, limits)) return true;
    for (VertexHandle v : {e.a, e.b}) {
      if (merging.group_of[v.idx] >= 0) groups.push_back(merging.group_of[v.idx]);
    }
    return true;
  });
  detail::sort_unique(groups);
  return groups;
}

Refusal check_plan(const HexMesh& mesh, const SingularityGraph& graph, const CollapsePlan& plan,
                   const ValenceLimits& limits) {
  if (plan.removed.empty() || static_cast<int>(plan.removed.size()) == mesh.n_cells()) {
    return Refusal::vanishing;
  }
  const Merging merging(mesh, plan);
  std::vector<PredictedEdge> newly_alone;
  Refusal refusal = Refusal::none;
  const auto fits = [&](const PredictedEdge& e) {
    if (e.valence == 0) {
      refusal = Refusal::vanishing;
    } else if (!within(e, limits)) {
      refusal = Refusal::valence;
    }
    if (e.boundary && e.valence == 1 && e.old_least > 1) newly_alone.push_back(e);
    return refusal == Refusal::none;
  };
  if (!for_each_predicted(mesh, graph, merging, fits)) return refusal;
  if (leaves_too_few(mesh, graph, merging, limits)) return Refusal::valence;
  if (limits.max_angle_deg < 360 &&
      opens_too_wide(mesh, graph, merging, newly_alone, limits.max_angle_deg))
    return Refusal::angle;
  if (degenerates_a_cell(mesh, merging)) return Refusal::degenerate_cell;
  if (glues_boundary(mesh, graph, merging)) return Refusal::boundary;
  return Refusal::none;
}

}  // namespace hexweft
