/// \file
/// A cell with a chosen corner and order of axes, carried from cell to cell: how structured grids
/// are walked in a mesh whose cells are numbered each in its own way.
#pragma once

#include <array>

#include "ovm/hex_mesh.h"

namespace hexweft {

/// Frame coordinates (0 or 1 along frame axes 0, 1, 2) of a cell's corners; corner 0 is the origin.
struct CellFrame {
  CellHandle cell;
  int origin = 0;                       ///< the cell's own number of the origin corner
  std::array<int, 3> axes = {0, 1, 2};  ///< the cell's own axis of each frame axis

  /// The cell's number of the corner whose frame coordinates are the bits of `bits` (axis 0
  /// lowest).
  int corner(int bits) const {
    int c = origin;
    for (int i = 0; i < 3; ++i) {
      if (bits >> i & 1) c = kCornerAcross[c][axes[i]];
    }
    return c;
  }
  /// The cell's side where frame coordinate `axis` is `end`.
  int side(int axis, int end) const {
    const int own = axes[axis];
    return 2 * own + (kCornerCoords[origin][own] ^ end);
  }
};

inline HalfFaceHandle halfface(const HexMesh& mesh, const CellFrame& f, int axis, int end) {
  return mesh.halfface(f.cell, f.side(axis, end));
}
inline VertexHandle vertex(const HexMesh& mesh, const CellFrame& f, int bits) {
  return mesh.vertices(f.cell)[f.corner(bits)];
}
/// The mesh edge from the corner `bits` along a frame axis.
inline EdgeHandle edge(const HexMesh& mesh, const CellFrame& f, int bits, int axis) {
  const int c = f.corner(bits);
  return mesh.edges(f.cell)[kEdgeBetween[c][kCornerAcross[c][f.axes[axis]]]];
}

/// The frame of the cell behind side (axis, end), axes parallel to these. \pre that side is not
/// boundary
inline CellFrame step(const HexMesh& mesh, const CellFrame& f, int axis, int end) {
  const HalfFaceHandle mate = mesh.opposite(halfface(mesh, f, axis, end));
  CellFrame next;
  next.cell = mesh.cell(mate);
  next.axes[axis] = side_axis(HexMesh::side(mate));
  // The corner of the shared side that lies over the origin, and its two neighbours on that side.
  const int base = end << axis;
  const int on_side = mesh.corner_of(next.cell, vertex(mesh, f, base));
  for (int i = 0; i < 3; ++i) {
    if (i == axis) continue;
    const int across = mesh.corner_of(next.cell, vertex(mesh, f, base | 1 << i));
    next.axes[i] = edge_axis(kEdgeBetween[on_side][across]);
  }
  // Stepping up, the shared side is the next cell's lower one; stepping down, its upper one.
  next.origin = end == 1 ? on_side : kCornerAcross[on_side][next.axes[axis]];
  return next;
}

}  // namespace hexweft
