/// \file
/// What becomes of handles when the gaps of deleted elements are closed.
#pragma once

#include <vector>

#include "ovm/handles.h"

namespace hexweft {

/// New handles for old ones, in the same order; invalid ones for those of elements that are gone.
///
///     const Renumbering now = mesh.collect_garbage();
///     for (VertexHandle& v : mine) v = now[v];
struct Renumbering {
  std::vector<int> vertices, edges, faces, cells;  ///< new index by old one, -1 where it is gone

  VertexHandle operator[](VertexHandle v) const { return VertexHandle(at(vertices, v.idx)); }
  EdgeHandle operator[](EdgeHandle e) const { return EdgeHandle(at(edges, e.idx)); }
  FaceHandle operator[](FaceHandle f) const { return FaceHandle(at(faces, f.idx)); }
  CellHandle operator[](CellHandle c) const { return CellHandle(at(cells, c.idx)); }
  HalfEdgeHandle operator[](HalfEdgeHandle h) const {
    return HalfEdgeHandle(slot(edges, h.idx, 2));
  }
  HalfFaceHandle operator[](HalfFaceHandle h) const {
    return HalfFaceHandle(slot(cells, h.idx, 6));
  }

 private:
  static int at(const std::vector<int>& new_of_old, int i) { return i < 0 ? -1 : new_of_old[i]; }
  static int slot(const std::vector<int>& new_of_old, int i, int per_element) {
    if (i < 0 || new_of_old[i / per_element] < 0) return -1;
    return per_element * new_of_old[i / per_element] + i % per_element;
  }
};

}  // namespace hexweft
