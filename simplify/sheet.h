/// \file
/// Base-complex sheets: classes of parallel base edges, the layers of components they cross.
#pragma once

#include <string_view>
#include <vector>

#include "simplify/base_complex.h"

namespace hexweft {

/// How a sheet lies. Where several hold, the first of moebius, intersecting, tangent, closed
/// counts.
enum class SheetKind {
  open,          ///< meets the boundary
  closed,        ///< meets no boundary
  tangent,       ///< touches itself: two of its edges share a base vertex
  intersecting,  ///< crosses itself: some component is crossed along two axes
  moebius        ///< one-sided
};
std::string_view name(SheetKind kind);

/// A component crossed along one of its axes.
struct Crossing {
  int component;
  int axis;
};

struct Sheet {
  std::vector<int> edges;     ///< E_M: the parallel base edges, ascending
  std::vector<char> against;  ///< by edge: 1 where its chain runs against the sheet's direction
  std::vector<Crossing> crossings;  ///< by component, then axis
  int width = 0;                    ///< layers of cells: mesh edges in each of its base edges
  SheetKind kind = SheetKind::open;
};

/// Whether a component's axis runs against the direction of the sheet that crosses it there.
bool runs_against(const BaseComplex& bc, const Sheet& sheet, const Crossing& x);

/// All sheets, each base edge in exactly one; ordered by their lowest base edge. Cost O(#B_E).
std::vector<Sheet> extract_sheets(const BaseComplex& bc);

}  // namespace hexweft
