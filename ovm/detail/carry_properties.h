/// \file
/// Hands the property values of elements on to the elements that replace them. Works from deleted
/// elements too: their values stay in place until garbage is collected.
#pragma once

#include <span>
#include <vector>

#include "ovm/hex_mesh.h"

namespace hexweft::detail {

/// Half-edge of cell c that runs along its edge k in the direction of its axis.
inline HalfEdgeHandle half_edge_of(const HexMesh& mesh, CellHandle c, int k) {
  const EdgeHandle e = mesh.edges(c)[k];
  const bool forward = mesh.vertices(e)[0] == mesh.vertices(c)[kEdgeCorners[k][0]];
  return HalfEdgeHandle(2 * e.idx + (forward ? 0 : 1));
}

template <class Tag>
void carry(HexMesh& mesh, Handle<Tag> from, Handle<Tag> to) {
  if (from != to) property_registry<Tag>(mesh)->copy_element(from.idx, to.idx);
}

/// To a vertex amid others: the mean of reals, of other numbers what the others have in common.
inline void carry_mean(HexMesh& mesh, std::span<const VertexHandle> from, VertexHandle to) {
  std::vector<int> parents;
  for (VertexHandle v : from) parents.push_back(v.idx);
  property_registry<VertexTag>(mesh)->take_mean(parents, to.idx);
}

/// Values of the edge and of both its half-edges, the direction kept.
inline void carry_edge(HexMesh& mesh, HalfEdgeHandle from, HalfEdgeHandle to) {
  if (from.idx / 2 == to.idx / 2) return;
  carry(mesh, EdgeHandle(from.idx / 2), EdgeHandle(to.idx / 2));
  carry(mesh, from, to);
  carry(mesh, HalfEdgeHandle(from.idx ^ 1), HalfEdgeHandle(to.idx ^ 1));
}

/// Values of the half-face, and of its face, which is given since the half-face may be deleted.
inline void carry_side(HexMesh& mesh, HalfFaceHandle from, FaceHandle from_face,
                       HalfFaceHandle to) {
  carry(mesh, from_face, mesh.face(to));
  carry(mesh, from, to);
}

}  // namespace hexweft::detail
