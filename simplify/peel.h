/// \file
/// Peels: what lies of a sheet right under one face of the surface. Octree meshers wrap a sheet round
/// the whole of a part, and one bad place is enough to keep such a sheet from being collapsed. It can
/// still be taken off those faces of the part that do without: their cells go, and what lay under them
/// comes up to the surface. The sheet then ends at the edges of the face.
#pragma once

#include <span>
#include <vector>

#include "simplify/collapse_plan.h"
#include "simplify/sheet.h"

namespace hexweft {

/// A component that has one of its sides on the boundary, and not the opposite one.
struct PeeledComponent {
  int component;
  int side;  ///< on the boundary; hex_numbering.h
};

struct Peel {
  std::vector<PeeledComponent> components;  ///< by component, then side
  int width = 0;                            ///< layers of cells
  SheetKind kind = SheetKind::open;         ///< of its sheet
};

/// All peels that are no whole sheet, those of the most components first. Components of a sheet next
/// to each other belong to the same peel unless they meet at a feature line.
/// \param on_feature  by base edge
std::vector<Peel> extract_peels(const BaseComplex& bc, const std::vector<Sheet>& sheets,
                                const std::vector<char>& on_feature);

/// Vertices that only the peel's cells have merge with those under them, in their place. Where the
/// sheet goes on beyond the peel its vertices stay; those under the rim come up beside them, a third
/// of a cell away.
CollapsePlan plan_peel(const HexMesh& mesh, const BaseComplex& bc, const Peel& peel);

}  // namespace hexweft
