/// \file
/// Pillowing: a new sheet, one layer of hexahedra, between a set of cells and the rest.
///
///     const SheetInsertion pillow = insert_sheet(mesh, ball, {.include_boundary = true});
///     if (pillow.refusal != InsertRefusal::none) ...   // the mesh is as it was
#pragma once

#include <span>
#include <vector>

#include "ovm/hex_mesh.h"

namespace hexweft {

struct InsertSheetOptions {
  /// (0, 1), how far the inner copies of the vertices move, of the way to the middle of the inside.
  double depth_rel = 0.5;
  /// Cover also the sides of the set on the mesh boundary, so that the sheet closes round the set.
  /// If false the sheet ends on the mesh boundary.
  bool include_boundary = false;
};

enum class InsertRefusal {
  none,
  no_interface,  ///< nothing lies between the set and the rest
  not_manifold   ///< the interface touches itself, or lies at a degenerate place
};

struct SheetInsertion {
  struct Copy {
    VertexHandle outer;  ///< the vertex as it was
    VertexHandle inner;  ///< its new copy, used by the set
  };
  struct Replacement {
    CellHandle before, after;
  };
  InsertRefusal refusal = InsertRefusal::none;
  std::vector<CellHandle> layer;      ///< the new hexahedra; side 5 is towards the rest
  std::vector<Copy> copies;           ///< by outer vertex
  std::vector<Replacement> replaced;  ///< cells of the set that touch the layer have new handles
};

/// Elements that are replaced hand on their properties, and vertices to their copies; the rim of the
/// sheet on the mesh boundary takes over those of the boundary faces and edges it widens. What else is
/// new has the defaults.
/// \param inside  live cells, in any order
/// \throws InputError for a cell that is none of the mesh, or an option out of range
SheetInsertion insert_sheet(HexMesh& mesh, std::span<const CellHandle> inside,
                            const InsertSheetOptions& options = {});

}  // namespace hexweft
