#include "simplify/cut_surfaces.h"

#include <algorithm>
#include <bit>

namespace hexweft {
namespace {

// The edge that continues e straight through its end v; none where that leads out of the mesh. v is
// regular: whichever cell at e one looks in, it is the edge behind the side at v that e ends on.
EdgeHandle straight_on(const HexMesh& mesh, EdgeHandle e, VertexHandle v) {
  const auto it = mesh.cells(e).begin();
  const int edge = it.slot() % 12;
  const int end = mesh.vertices(*it)[kEdgeCorners[edge][1]] == v;
  const HalfFaceHandle side = mesh.halfface(*it, 2 * edge_axis(edge) + end);
  if (mesh.is_boundary(side)) return EdgeHandle();
  const HalfFaceHandle behind = mesh.opposite(side);
  const CellHandle c = mesh.cell(behind);
  for (int i = 0; i < 4; ++i) {
    const int across = 4 * side_axis(behind.idx % 6) + i;
    for (int corner : kEdgeCorners[across]) {
      if (mesh.vertices(c)[corner] == v) return mesh.edges(c)[across];
    }
  }
  return EdgeHandle();
}

}  // namespace

CutSurfaces::CutSurfaces(const HexMesh& mesh, SingularityGraph& graph)
    : mesh_(mesh),
      graph_(graph),
      cut_(mesh.face_slots(), 0),
      traced_(mesh.edge_slots(), 0),
      on_singular_edge_(mesh.vertex_slots(), 0) {
  std::vector<EdgeHandle> seeds;
  for (EdgeHandle e : mesh.edges()) {
    const auto [a, b] = mesh.vertices(e);
    const bool singular = graph.singular_edge[e.idx];
    if (singular) on_singular_edge_[a.idx] = on_singular_edge_[b.idx] = 1;
    if (singular || graph.singular_vertex[a.idx] || graph.singular_vertex[b.idx])
      seeds.push_back(e);
  }
  trace(seeds);
  for (const SingularCurve& curve : graph.curves) {
    if (curve.closed) add_nodes(curve);
  }
}

// Base edges run straight on from the seeds through regular vertices; surfaces start on all of
// them.
void CutSurfaces::trace(std::span<const EdgeHandle> seeds) {
  std::vector<EdgeHandle> found;
  const auto add = [&](EdgeHandle e) {
    if (traced_[e.idx]) return;
    traced_[e.idx] = 1;
    found.push_back(e);
  };
  for (EdgeHandle e : seeds) add(e);
  for (std::size_t next = 0; next < found.size(); ++next) {
    const EdgeHandle e = found[next];
    for (VertexHandle v : mesh_.vertices(e)) {
      if (graph_.singular_vertex[v.idx] || on_singular_edge_[v.idx]) continue;
      if (const EdgeHandle on = straight_on(mesh_, e, v); on.valid()) add(on);
    }
  }
  // Where they are many, a pass over the cells takes less than going round every one of them.
  if (static_cast<int>(found.size()) > mesh_.n_cells() / 2) {
    cut_at_all_traced();
  } else {
    for (EdgeHandle e : found) cut_at(e);
  }
  spread();
}

void CutSurfaces::cut(FaceHandle f) {
  begin_at(mesh_.halfface(f));
  spread();
}

void CutSurfaces::begin_at(HalfFaceHandle hf) {
  const FaceHandle f = mesh_.face(hf);
  if (cut_[f.idx] || mesh_.is_boundary(hf)) return;
  cut_[f.idx] = 1;
  front_.push_back(f);
}

void CutSurfaces::cut_at(EdgeHandle e) {
  const auto cells = mesh_.cells(e);
  for (auto it = cells.begin(); it != cells.end(); ++it) {
    for (int s : kEdgeSides[it.slot() % 12]) begin_at(mesh_.halfface(*it, s));
  }
}

void CutSurfaces::cut_at_all_traced() {
  for (CellHandle c : mesh_.cells()) {
    unsigned sides = 0;  // bits
    const auto& edges = mesh_.edges(c);
    for (int k = 0; k < kHexEdges; ++k) {
      if (traced_[edges[k].idx]) sides |= 1u << kEdgeSides[k][0] | 1u << kEdgeSides[k][1];
    }
    for (; sides != 0; sides &= sides - 1) begin_at(mesh_.halfface(c, std::countr_zero(sides)));
  }
}

void CutSurfaces::spread() {
  while (!front_.empty()) {
    const HalfFaceHandle hf = mesh_.halfface(front_.back());
    front_.pop_back();
    for (EdgeHandle e : mesh_.edges(hf)) {
      // Surfaces end at singular and boundary edges; round traced ones, the singular among them, all is
      // cut already.
      if (traced_[e.idx] || graph_.boundary_edge[e.idx]) continue;
      // Two quarter turns round an edge of four cells lead straight across it.
      const HalfFaceHandle turned = mesh_.opposite(mesh_.adjacent_in_cell(hf, e));
      const FaceHandle across = mesh_.face(mesh_.adjacent_in_cell(turned, e));
      if (cut_[across.idx]) continue;
      cut_[across.idx] = 1;
      front_.push_back(across);
    }
  }
}

// A surface crosses a curve at its vertex i if a cut face there has no edge of the curve.
bool CutSurfaces::is_crossed(const SingularCurve& curve, int i) const {
  const int n = static_cast<int>(curve.edges.size());
  const EdgeHandle before = curve.edges[(i + n - 1) % n], after = curve.edges[i];
  for (EdgeHandle e : mesh_.edges(curve.vertices[i])) {
    if (e == before || e == after) continue;
    for (FaceHandle f : mesh_.faces(e)) {
      const auto edges = mesh_.edges(f);
      const bool along = std::any_of(edges.begin(), edges.end(),
                                     [&](EdgeHandle x) { return x == before || x == after; });
      const auto v = mesh_.vertices(f);
      const bool at = std::find(v.begin(), v.end(), curve.vertices[i]) != v.end();
      if (at && !along && cut_[f.idx]) return true;
    }
  }
  return false;
}

// Nodes where surfaces from elsewhere cross, then in the middle of the longest gaps, or at thirds.
void CutSurfaces::add_nodes(const SingularCurve& curve) {
  const int n = static_cast<int>(curve.vertices.size());
  std::vector<int> nodes;
  for (int i = 0; i < n; ++i) {
    if (is_crossed(curve, i)) nodes.push_back(i);
  }
  if (nodes.empty()) nodes.push_back(0);
  if (nodes.size() == 1) {
    nodes.push_back((nodes[0] + n / 3) % n);
    nodes.push_back((nodes[0] + 2 * n / 3) % n);
  } else if (nodes.size() == 2) {
    const int gap = nodes[1] - nodes[0];
    const bool inner = gap >= n - gap;
    nodes.push_back(inner ? nodes[0] + gap / 2 : (nodes[1] + (n - gap) / 2) % n);
  }
  std::vector<EdgeHandle> seeds;
  for (int i : nodes) {
    const VertexHandle v = curve.vertices[i];
    graph_.singular_vertex[v.idx] = 1;
    for (EdgeHandle e : mesh_.edges(v)) seeds.push_back(e);
  }
  trace(seeds);
}

}  // namespace hexweft
