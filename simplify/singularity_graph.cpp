#include "simplify/singularity_graph.h"

#include <algorithm>
#include <array>

namespace hexweft {
namespace {

void mark_boundary_and_valence(const HexMesh& mesh, SingularityGraph& g) {
  for (CellHandle c : mesh.cells()) {
    for (EdgeHandle e : mesh.edges(c)) ++g.edge_valence[e.idx];
    for (HalfFaceHandle hf : mesh.halffaces(c)) {
      if (!mesh.is_boundary(hf)) continue;
      for (EdgeHandle e : mesh.edges(hf)) g.boundary_edge[e.idx] = 1;
      for (VertexHandle v : mesh.vertices(hf)) g.boundary_vertex[v.idx] = 1;
    }
  }
}

// Singular edges at each vertex: how many, and the first two.
struct EdgesAtVertex {
  int n = 0;
  std::array<EdgeHandle, 2> first;
};

std::vector<EdgesAtVertex> singular_edges_at_vertices(const HexMesh& mesh, SingularityGraph& g) {
  std::vector<EdgesAtVertex> at(mesh.vertex_slots());
  for (EdgeHandle e : mesh.edges()) {
    g.singular_edge[e.idx] = g.edge_valence[e.idx] != g.regular_valence(e);
    if (!g.singular_edge[e.idx]) continue;
    for (VertexHandle v : mesh.vertices(e)) {
      if (at[v.idx].n < 2) at[v.idx].first[at[v.idx].n] = e;
      ++at[v.idx].n;
    }
  }
  return at;
}

// Walks from edge `start`, leaving through `v`, to a singular vertex or back to the start.
void walk(const HexMesh& mesh, const SingularityGraph& g, const std::vector<EdgesAtVertex>& at,
          EdgeHandle start, VertexHandle v, SingularCurve& curve) {
  EdgeHandle e = start;
  curve.vertices.push_back(v);
  while (!g.singular_vertex[v.idx]) {
    const auto& pair = at[v.idx].first;
    e = pair[0] == e ? pair[1] : pair[0];
    if (e == start) {
      curve.closed = true;
      return;
    }
    v = mesh.other_end(e, v);
    curve.edges.push_back(e);
    curve.vertices.push_back(v);
  }
}

SingularCurve trace(const HexMesh& mesh, const SingularityGraph& g,
                    const std::vector<EdgesAtVertex>& at, EdgeHandle start) {
  const auto ends = mesh.vertices(start);
  SingularCurve forward, backward;
  forward.valence = g.edge_valence[start.idx];
  forward.boundary = g.boundary_edge[start.idx];
  walk(mesh, g, at, start, ends[1], forward);
  if (forward.closed) {
    // The walk came back to the start's first vertex: its last one.
    forward.edges.push_back(start);
    return forward;
  }
  walk(mesh, g, at, start, ends[0], backward);
  std::reverse(backward.vertices.begin(), backward.vertices.end());
  std::reverse(backward.edges.begin(), backward.edges.end());
  backward.edges.push_back(start);
  backward.vertices.insert(backward.vertices.end(), forward.vertices.begin(),
                           forward.vertices.end());
  backward.edges.insert(backward.edges.end(), forward.edges.begin(), forward.edges.end());
  backward.valence = forward.valence;
  backward.boundary = forward.boundary;
  return backward;
}

}  // namespace

SingularityGraph extract_singularity_graph(const HexMesh& mesh) {
  SingularityGraph g;
  g.edge_valence.assign(mesh.edge_slots(), 0);
  g.boundary_edge.assign(mesh.edge_slots(), 0);
  g.boundary_vertex.assign(mesh.vertex_slots(), 0);
  g.singular_edge.assign(mesh.edge_slots(), 0);
  g.singular_vertex.assign(mesh.vertex_slots(), 0);
  g.curve_of_edge.assign(mesh.edge_slots(), -1);
  mark_boundary_and_valence(mesh, g);
  const auto at = singular_edges_at_vertices(mesh, g);
  for (VertexHandle v : mesh.vertices()) {
    const auto& [n, e] = at[v.idx];
    const bool passes = n == 2 && g.edge_valence[e[0].idx] == g.edge_valence[e[1].idx] &&
                        g.boundary_edge[e[0].idx] == g.boundary_edge[e[1].idx];
    g.singular_vertex[v.idx] = n > 0 && !passes;
  }
  for (EdgeHandle e : mesh.edges()) {
    if (!g.singular_edge[e.idx] || g.curve_of_edge[e.idx] >= 0) continue;
    g.curves.push_back(trace(mesh, g, at, e));
    for (EdgeHandle on : g.curves.back().edges) {
      g.curve_of_edge[on.idx] = static_cast<int>(g.curves.size()) - 1;
    }
  }
  return g;
}

}  // namespace hexweft
