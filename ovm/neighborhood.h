/// \file
/// Lists of elements, and walks between neighbours that need no storage of the mesh: within a cell,
/// over a sheet, round a vertex. A cell's sides are side_at(c, axis, 0) and side_at(c, axis, 1),
/// back and front of its local x, y and z.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "ovm/hex_mesh.h"

namespace hexweft {

/// Side of the cell where its local coordinate along the axis is `end` (0 or 1).
inline HalfFaceHandle side_at(CellHandle c, int axis, int end) {
  return HalfFaceHandle(6 * c.idx + 2 * axis + end);
}

/// The half-face across the same cell.
inline HalfFaceHandle opposite_in_cell(HalfFaceHandle hf) { return HalfFaceHandle(hf.idx ^ 1); }

/// The half-edges of a side, half-edge i from its vertex i to vertex i + 1, counter-clockwise from
/// outside; the next one of half-edge i is (i + 1) % 4.
std::array<HalfEdgeHandle, 4> halfedges(const HexMesh& mesh, HalfFaceHandle hf);

/// The live cells, ascending.
std::vector<CellHandle> all_cells(const HexMesh& mesh);

/// The cells themselves, then those that share a vertex with them, and so on `rings` times.
std::vector<CellHandle> grow_cells(const HexMesh& mesh, std::span<const CellHandle> cells,
                                   int rings);

/// The cells within `rings` of the vertices; ring 1 touches them. Ascending.
std::vector<CellHandle> cells_around(const HexMesh& mesh, std::span<const VertexHandle> vertices,
                                     int rings);

/// The side of c with these vertices in any order, invalid if there is none.
HalfFaceHandle find_halfface_in_cell(const HexMesh& mesh, CellHandle c, const QuadVertices& quad);

/// Of the cell across side k, by side; invalid on the boundary.
std::array<CellHandle, 6> neighbors(const HexMesh& mesh, CellHandle c);

/// The vertices that an edge joins to v.
std::vector<VertexHandle> neighbors(const HexMesh& mesh, VertexHandle v);

/// The faces at v, sorted.
std::vector<FaceHandle> faces(const HexMesh& mesh, VertexHandle v);

/// The half-face of the next cell that continues hf across e: both lie on the same side of the
/// layer of cells. Invalid where the layer ends at e.
HalfFaceHandle adjacent_on_sheet(const HexMesh& mesh, HalfFaceHandle hf, EdgeHandle e);

/// All that adjacent_on_sheet() reaches from hf, hf first: one side of its layer of cells, or both
/// where the layer is one-sided.
std::vector<HalfFaceHandle> halffaces_on_sheet(const HexMesh& mesh, HalfFaceHandle hf);

/// The cells of the sheet across the axis of c, sorted.
std::vector<CellHandle> cells_on_sheet(const HexMesh& mesh, CellHandle c, int axis);

}  // namespace hexweft
