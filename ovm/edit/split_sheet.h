/// \file
/// Refinement along a dual sheet: every hexahedron the sheet crosses is split across it.
///
///     const SheetSplit split = split_sheet(mesh, e);
///     for (const SplitVertex& s : split.vertices)
///       if (mesh.is_boundary(s.vertex)) project(mesh, s.vertex);
#pragma once

#include <array>
#include <span>
#include <vector>

#include "ovm/dual.h"
#include "ovm/hex_mesh.h"

namespace hexweft {

/// A new vertex at the mean of its parents: the 2 ends of an edge, the 4 corners of a face or the 8
/// corners of a cell.
struct SplitVertex {
  VertexHandle vertex;
  std::array<VertexHandle, 8> parents;
  int n_parents;
  std::span<const VertexHandle> parent_vertices() const {
    return {parents.data(), static_cast<std::size_t>(n_parents)};
  }
};

struct SheetSplit {
  std::vector<SplitVertex> vertices;
  std::vector<CellHandle> removed;  ///< the cells split, no longer live
  std::vector<CellHandle> cells;    ///< their children
  std::vector<CellHandle> parents;  ///< of each child, the cell it is a part of
};

/// Splits every cell of the sheet: in 2 where it is crossed once, in 4 where twice, in 8 where
/// three times. The mesh stays conforming. Children of cells, edges, faces and half-faces take over
/// the properties of their parents, new vertices the means of reals and of other numbers what their
/// parents have in common; new elements inside a cell or across a face have the defaults. Positions
/// are means of the parents, nothing is projected.
/// \throws InputError if the edge is deleted or the sheet is none of this mesh as it is now; nothing
///         changes
SheetSplit split_sheet(HexMesh& mesh, EdgeHandle e);
SheetSplit split_sheet(HexMesh& mesh, const DualSheet& sheet);

}  // namespace hexweft
