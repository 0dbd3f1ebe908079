#include "ovm/topology_summary.h"

#include <algorithm>

namespace hexweft {
namespace {

int count_boundary_components(const HexMesh& mesh, const std::vector<HalfFaceHandle>& boundary) {
  std::vector<char> reached(6 * static_cast<std::size_t>(mesh.cell_slots()), 0);
  std::vector<HalfFaceHandle> stack;
  int n = 0;
  for (HalfFaceHandle seed : boundary) {
    if (reached[seed.idx]) continue;
    ++n;
    reached[seed.idx] = 1;
    stack.assign(1, seed);
    while (!stack.empty()) {
      const HalfFaceHandle hf = stack.back();
      stack.pop_back();
      for (EdgeHandle e : mesh.edges(hf)) {
        const HalfFaceHandle next = mesh.adjacent_on_boundary(hf, e);
        if (!next.valid() || reached[next.idx]) continue;
        reached[next.idx] = 1;
        stack.push_back(next);
      }
    }
  }
  return n;
}

int n_used_vertices(const HexMesh& mesh) {
  int n = 0;
  for (VertexHandle v : mesh.vertices()) n += !mesh.cells(v).empty();
  return n;
}

}  // namespace

int euler_characteristic(const HexMesh& mesh) {
  return n_used_vertices(mesh) - mesh.n_edges() + mesh.n_faces() - mesh.n_cells();
}

std::vector<int> parts_of_cells(const HexMesh& mesh) {
  std::vector<int> part(mesh.cell_slots(), -1);
  std::vector<CellHandle> stack;
  int n = 0;
  for (CellHandle seed : mesh.cells()) {
    if (part[seed.idx] >= 0) continue;
    part[seed.idx] = n;
    stack.assign(1, seed);
    while (!stack.empty()) {
      const CellHandle c = stack.back();
      stack.pop_back();
      for (HalfFaceHandle hf : mesh.halffaces(c)) {
        const CellHandle next = mesh.cell(mesh.opposite(hf));
        if (!next.valid() || part[next.idx] >= 0) continue;
        part[next.idx] = n;
        stack.push_back(next);
      }
    }
    ++n;
  }
  return part;
}

TopologySummary summarize_topology(const HexMesh& mesh) {
  TopologySummary s;
  s.n_vertices = n_used_vertices(mesh);
  s.n_edges = mesh.n_edges();
  s.n_faces = mesh.n_faces();
  s.n_cells = mesh.n_cells();
  s.euler_characteristic = s.n_vertices - s.n_edges + s.n_faces - s.n_cells;

  const auto boundary = mesh.boundary_halffaces();
  std::vector<char> on_vertex(mesh.vertex_slots(), 0), on_edge(mesh.edge_slots(), 0);
  for (HalfFaceHandle hf : boundary) {
    for (VertexHandle v : mesh.vertices(hf)) on_vertex[v.idx] = 1;
    for (EdgeHandle e : mesh.edges(hf)) on_edge[e.idx] = 1;
  }
  s.n_boundary_vertices = static_cast<int>(std::count(on_vertex.begin(), on_vertex.end(), 1));
  s.n_boundary_edges = static_cast<int>(std::count(on_edge.begin(), on_edge.end(), 1));
  s.n_boundary_faces = static_cast<int>(boundary.size());
  s.n_boundary_components = count_boundary_components(mesh, boundary);
  const auto part = parts_of_cells(mesh);
  s.n_parts = part.empty() ? 0 : *std::max_element(part.begin(), part.end()) + 1;
  // The Euler number of a closed orientable surface of genus g is 2 - 2g.
  s.genus = s.n_parts - (s.n_boundary_vertices - s.n_boundary_edges + s.n_boundary_faces) / 2;
  return s;
}

}  // namespace hexweft
