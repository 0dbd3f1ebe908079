#include "simplify/plan_check.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "simplify/disjoint_sets.h"

namespace hexweft {
namespace {

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
      CellHandle cell;
      for (CellHandle c : mesh.cells(e)) {
        if (is_removed(plan, c)) continue;
        ++surviving;
        cell = c;
      }
      const int valence = graph.edge_valence[e.idx];
      const int error = std::abs(valence - graph.regular_valence(e));
      edges.push_back({a, b, surviving, graph.boundary_edge[e.idx] != 0, 1, error, valence, cell});
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
      if (e.cell.valid()) merged.cell = e.cell;
      merged.old_least = std::min(merged.old_least, e.old_least);
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

// Interior angle between the two sides of a cell at an edge, with the merged vertices in their new
// places, degrees.
double angle_at(const HexMesh& mesh, const PredictedEdge& e, const std::vector<int>& group_of,
                const CollapsePlan& plan, const std::vector<Eigen::Vector3d>& targets) {
  Eigen::Vector3d normals[2], middles[2];
  int n = 0;
  for (HalfFaceHandle side : mesh.halffaces(e.cell)) {
    Eigen::Vector3d p[4];
    int at_ends = 0, i = 0;
    for (VertexHandle v : mesh.vertices(side)) {
      const int g = group_of[v.idx];
      const VertexHandle stand_in = g < 0 ? v : plan.group(g)[0];
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

// A cell alone at a boundary edge fills the whole angle there: on a smooth surface it is flat.
bool opens_too_wide(const HexMesh& mesh, const SingularityGraph& graph, const CollapsePlan& plan,
                    const std::vector<int>& group_of, const std::vector<PredictedEdge>& edges,
                    double max_angle_deg) {
  const auto newly_alone = [](const PredictedEdge& e) {
    return e.boundary && e.valence == 1 && e.old_least > 1;
  };
  if (max_angle_deg >= 360 || std::none_of(edges.begin(), edges.end(), newly_alone)) return false;
  const std::vector<Eigen::Vector3d> targets = default_targets(mesh, graph, plan);
  return std::any_of(edges.begin(), edges.end(), [&](const PredictedEdge& e) {
    return newly_alone(e) && angle_at(mesh, e, group_of, plan, targets) > max_angle_deg;
  });
}

}  // namespace

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
  const std::vector<PredictedEdge> edges = predict(mesh, graph, plan, group_of);
  for (const PredictedEdge& e : edges) {
    if (e.valence == 0) return Refusal::vanishing;
    if (!within(e, limits)) return Refusal::valence;
  }
  if (opens_too_wide(mesh, graph, plan, group_of, edges, limits.max_angle_deg))
    return Refusal::angle;
  if (degenerates_a_cell(mesh, plan, group_of)) return Refusal::degenerate_cell;
  if (glues_boundary(mesh, graph, plan, group_of)) return Refusal::boundary;
  return Refusal::none;
}

}  // namespace hexweft
