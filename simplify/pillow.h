/// \file
/// Pillows for sheets that a few places keep from being collapsed: where two curves of valence 3 would
/// become one of valence 2, an edge would get too many cells or two faces two common edges. A pillow round
/// the components on one side of these places, put in first, keeps the two sides of the sheet apart: it
/// takes the sheet's place there, but turns round those components instead of going on as the sheet does.
/// What the sheet has elsewhere goes. Tangled sheets can be taken apart so where no chord goes.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "ovm/edit/insert_sheet.h"
#include "simplify/collapse_plan.h"

namespace hexweft {

struct Pillow {
  std::vector<int> inside;  ///< components, ascending
  int added = 0;            ///< components of the pillow itself: base faces round the inside
};

/// A mesh with a pillow in it, before its sheet is collapsed.
struct InsertedPillow {
  SheetInsertion layer;
  BaseComplex base_complex;
  CollapsePlan plan;  ///< of the sheet, which has the same cells as before
};
/// Puts it in. What lies outside makes room for it, the sheet that is to go among it; what lies inside
/// stays as it is. None (and the mesh then needs to be rolled back) where the pillow would touch itself or
/// the sheet would become another.
/// \param plan  of the sheet in the mesh as it is
std::optional<InsertedPillow> insert_pillow(HexMesh& mesh, const BaseComplex& bc,
                                            const Sheet& sheet, const CollapsePlan& plan,
                                            const Pillow& pillow);

/// The smallest pillow on one side of a sheet that keeps groups of its plan apart; none where the sheet
/// touches itself at these.
/// \param groups  of the plan
/// \param side    0 or 1
std::optional<Pillow> smallest_pillow(const HexMesh& mesh, const BaseComplex& bc,
                                      const Sheet& sheet, const CollapsePlan& plan,
                                      std::span<const int> groups, int side);

/// The vertices that a pillow is put in at: between its inside and the rest.
std::vector<VertexHandle> wall_of(const HexMesh& mesh, const BaseComplex& bc, const Pillow& pillow);

/// The components that a sheet crosses, ascending.
std::vector<int> components_of(const Sheet& sheet);

/// By vertex handle, the sides of a sheet that the vertex lies on: 1, 2, 3 for both, 0 for neither.
std::vector<char> sides_of_sheet(const HexMesh& mesh, const BaseComplex& bc, const Sheet& sheet);

}  // namespace hexweft
