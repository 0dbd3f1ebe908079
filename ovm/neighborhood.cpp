#include "ovm/neighborhood.h"

#include <algorithm>

#include "ovm/detail/sort_unique.h"
#include "ovm/dual.h"

namespace hexweft {

std::array<HalfEdgeHandle, 4> halfedges(const HexMesh& mesh, HalfFaceHandle hf) {
  const auto v = mesh.vertices(hf);
  const auto e = mesh.edges(hf);
  std::array<HalfEdgeHandle, 4> result;
  for (int i = 0; i < 4; ++i) {
    result[i] = HalfEdgeHandle(2 * e[i].idx + (mesh.vertices(e[i])[0] == v[i] ? 0 : 1));
  }
  return result;
}

std::vector<CellHandle> all_cells(const HexMesh& mesh) {
  std::vector<CellHandle> cells;
  cells.reserve(mesh.n_cells());
  for (CellHandle c : mesh.cells()) cells.push_back(c);
  return cells;
}

std::vector<CellHandle> grow_cells(const HexMesh& mesh, std::span<const CellHandle> cells,
                                   int rings) {
  std::vector<CellHandle> grown;
  std::vector<char> inside(mesh.cell_slots(), 0);
  const auto take = [&](CellHandle c) {
    if (!inside[c.idx]) grown.push_back(c);
    inside[c.idx] = 1;
  };
  for (CellHandle c : cells) take(c);
  std::size_t first = 0;
  for (int ring = 0; ring < rings; ++ring) {
    const std::size_t end = grown.size();
    for (; first < end; ++first) {
      for (VertexHandle v : mesh.vertices(grown[first])) {
        for (CellHandle c : mesh.cells(v)) take(c);
      }
    }
  }
  return grown;
}

std::vector<CellHandle> cells_around(const HexMesh& mesh, std::span<const VertexHandle> vertices,
                                     int rings) {
  std::vector<char> seen_vertex(mesh.vertex_slots(), 0), seen_cell(mesh.cell_slots(), 0);
  std::vector<VertexHandle> front(vertices.begin(), vertices.end()), next;
  std::vector<CellHandle> result;
  for (VertexHandle v : front) seen_vertex[v.idx] = 1;
  for (int ring = 0; ring < rings && !front.empty(); ++ring) {
    next.clear();
    for (VertexHandle v : front) {
      for (CellHandle c : mesh.cells(v)) {
        if (seen_cell[c.idx]) continue;
        seen_cell[c.idx] = 1;
        result.push_back(c);
        for (VertexHandle w : mesh.vertices(c)) {
          if (seen_vertex[w.idx]) continue;
          seen_vertex[w.idx] = 1;
          next.push_back(w);
        }
      }
    }
    front.swap(next);
  }
  // In order: by looking through all cells of the mesh, unless it has so many that sorting is faster.
  constexpr int kAllPerOne = 32;
  if (std::ssize(seen_cell) > kAllPerOne * std::ssize(result)) {
    std::sort(result.begin(), result.end());
    return result;
  }
  result.clear();
  for (int i = 0; i < mesh.cell_slots(); ++i) {
    if (seen_cell[i]) result.push_back(CellHandle(i));
  }
  return result;
}

HalfFaceHandle find_halfface_in_cell(const HexMesh& mesh, CellHandle c, const QuadVertices& quad) {
  for (HalfFaceHandle hf : mesh.halffaces(c)) {
    const auto v = mesh.vertices(hf);
    if (std::is_permutation(v.begin(), v.end(), quad.begin())) return hf;
  }
  return HalfFaceHandle();
}

std::array<CellHandle, 6> neighbors(const HexMesh& mesh, CellHandle c) {
  std::array<CellHandle, 6> result;
  for (int s = 0; s < kSides; ++s) result[s] = mesh.cell(mesh.opposite(mesh.halfface(c, s)));
  return result;
}

std::vector<VertexHandle> neighbors(const HexMesh& mesh, VertexHandle v) {
  std::vector<VertexHandle> result;
  for (EdgeHandle e : mesh.edges(v)) result.push_back(mesh.other_end(e, v));
  return result;
}

std::vector<FaceHandle> faces(const HexMesh& mesh, VertexHandle v) {
  std::vector<FaceHandle> result;
  const auto cells = mesh.cells(v);
  for (auto it = cells.begin(); it != cells.end(); ++it) {
    const auto& x = kCornerCoords[it.slot() % 8];
    for (int a = 0; a < 3; ++a) result.push_back(mesh.face(side_at(*it, a, x[a])));
  }
  detail::sort_unique(result);
  return result;
}

HalfFaceHandle adjacent_on_sheet(const HexMesh& mesh, HalfFaceHandle hf, EdgeHandle e) {
  const HalfFaceHandle between = mesh.opposite(mesh.adjacent_in_cell(hf, e));
  return between.valid() ? mesh.adjacent_in_cell(between, e) : HalfFaceHandle();
}

std::vector<HalfFaceHandle> halffaces_on_sheet(const HexMesh& mesh, HalfFaceHandle hf) {
  std::vector<char> reached(6 * static_cast<std::size_t>(mesh.cell_slots()), 0);
  std::vector<HalfFaceHandle> result{hf};
  reached[hf.idx] = 1;
  for (std::size_t i = 0; i < result.size(); ++i) {
    for (EdgeHandle e : mesh.edges(result[i])) {
      const HalfFaceHandle next = adjacent_on_sheet(mesh, result[i], e);
      if (!next.valid() || reached[next.idx]) continue;
      reached[next.idx] = 1;
      result.push_back(next);
    }
  }
  return result;
}

std::vector<CellHandle> cells_on_sheet(const HexMesh& mesh, CellHandle c, int axis) {
  return dual_sheet(mesh, mesh.edges(c)[4 * axis]).cells();
}

}  // namespace hexweft
