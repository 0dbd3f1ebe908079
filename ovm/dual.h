/// \file
/// The dual of a hexahedral mesh: sheets and chords.
///
/// The four edges of a hexahedron along one of its axes are parallel; a dual *sheet* is a maximal
/// set of parallel mesh edges, the surface through their middles. Two opposite sides of a
/// hexahedron are in line; a dual *chord* is a maximal row of such faces, the curve through their
/// middles. Every edge is in one sheet, every face in one chord; a cell is crossed by three sheets
/// and by three chords, not necessarily different ones.
///
///     const DualSheets sheets = extract_dual_sheets(mesh);
///     const DualSheet sheet = dual_sheet(mesh, mesh.edges(c)[0]);
#pragma once

#include <vector>

#include "ovm/hex_mesh.h"

namespace hexweft {

/// A cell and one of its local axes: edges 4a to 4a + 3 and sides 2a, 2a + 1 belong to axis a.
struct CellAxis {
  CellHandle cell;
  int axis;
  friend constexpr auto operator<=>(const CellAxis&, const CellAxis&) = default;
};

/// One sheet, both lists sorted.
struct DualSheet {
  std::vector<EdgeHandle> edges;
  std::vector<CellAxis> crossings;  ///< the axis is the direction across the sheet

  /// The cells crossed, each once.
  std::vector<CellHandle> cells() const;
  /// True if some cell is crossed more than once.
  bool crosses_itself() const;
};

/// One chord. Face i + 1 is opposite to face i in cell i; a closed chord has as many cells as
/// faces, an open one a face more.
struct DualChord {
  std::vector<FaceHandle> faces;
  std::vector<CellAxis> crossings;  ///< the axis is the direction along the chord
  bool closed = false;
};

/// All sheets, numbered in order of their lowest edge.
struct DualSheets {
  int n_sheets = 0;
  std::vector<int> of_edge;  ///< by edge slot; -1 for deleted edges
  int operator[](EdgeHandle e) const { return of_edge[e.idx]; }
};

/// All chords, numbered in order of their lowest face.
struct DualChords {
  int n_chords = 0;
  std::vector<int> of_face;  ///< by face slot; -1 for deleted faces
  int operator[](FaceHandle f) const { return of_face[f.idx]; }
};

/// Cost O(size of the sheet), logarithmic factors aside, and one byte an edge of the mesh cleared.
DualSheet dual_sheet(const HexMesh& mesh, EdgeHandle e);
/// An open chord starts at a boundary face, a closed one at f. Cost O(size of the chord).
DualChord dual_chord(const HexMesh& mesh, FaceHandle f);

/// Cost O(#cells).
DualSheets extract_dual_sheets(const HexMesh& mesh);
DualChords extract_dual_chords(const HexMesh& mesh);

/// The sheets as lists, in order of their numbers.
std::vector<DualSheet> list_dual_sheets(const HexMesh& mesh);

}  // namespace hexweft
