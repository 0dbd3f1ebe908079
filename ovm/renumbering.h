/// \file
/// What becomes of handles when the gaps of deleted elements are closed.
#pragma once

#include <vector>

#include "ovm/handles.h"

namespace hexweft {

namespace detail {
/// \param new_of_old  index of an element, -1 where it is gone
/// \param i           of a slot of which every element has so many, or -1
inline int renumbered(const std::vector<int>& new_of_old, int i, int per_element = 1) {
  if (i < 0 || new_of_old[i / per_element] < 0) return -1;
  return per_element * new_of_old[i / per_element] + i % per_element;
}
}  // namespace detail

/// New handles for old ones, in the same order; invalid ones for those of elements that are gone.
///
///     const Renumbering now = mesh.collect_garbage();
///     for (VertexHandle& v : mine) v = now[v];
struct Renumbering {
  std::vector<int> vertices, edges, faces, cells;  ///< new index by old one, -1 where it is gone

  VertexHandle operator[](VertexHandle v) const {
    return VertexHandle(detail::renumbered(vertices, v.idx));
  }
  EdgeHandle operator[](EdgeHandle e) const { return EdgeHandle(detail::renumbered(edges, e.idx)); }
  FaceHandle operator[](FaceHandle f) const { return FaceHandle(detail::renumbered(faces, f.idx)); }
  CellHandle operator[](CellHandle c) const { return CellHandle(detail::renumbered(cells, c.idx)); }
  HalfEdgeHandle operator[](HalfEdgeHandle h) const {
    return HalfEdgeHandle(detail::renumbered(edges, h.idx, 2));
  }
  HalfFaceHandle operator[](HalfFaceHandle h) const {
    return HalfFaceHandle(detail::renumbered(cells, h.idx, 6));
  }
};

}  // namespace hexweft
