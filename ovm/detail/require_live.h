/// \file
/// Handles that an edit is given are those of live elements.
#pragma once

#include <string>

#include "ovm/errors.h"
#include "ovm/hex_mesh.h"

namespace hexweft::detail {

inline int slots(const HexMesh& mesh, VertexHandle) { return mesh.vertex_slots(); }
inline int slots(const HexMesh& mesh, EdgeHandle) { return mesh.edge_slots(); }
inline int slots(const HexMesh& mesh, CellHandle) { return mesh.cell_slots(); }

inline std::string name(VertexHandle v) { return "vertex " + std::to_string(v.idx); }
inline std::string name(EdgeHandle e) { return "edge " + std::to_string(e.idx); }
inline std::string name(CellHandle c) { return "cell " + std::to_string(c.idx); }

/// HexMesh::is_live() for any handle, be it invalid or of another mesh.
template <class HandleT>
bool is_live(const HexMesh& mesh, HandleT h) {
  return h.valid() && h.idx < slots(mesh, h) && mesh.is_live(h);
}

/// \param where  " of the sheet" or the like, for the message
/// \throws InputError unless the element is live
template <class HandleT>
void require_live(const HexMesh& mesh, HandleT h, const char* where = "") {
  if (!is_live(mesh, h)) throw InputError(name(h) + where + " is not a live one of the mesh");
}

}  // namespace hexweft::detail
