/// \file
/// Which sheets could be collapsed with a pillow.
///
///     const std::vector<Sheet> sheets = extract_sheets(bc);
///     for (const PillowedSheet& p : find_pillows(mesh, bc, sheets, {}))
///       try_pillowed_collapse(context, bc, sheets[p.sheet], p.pillow, options);
#pragma once

#include <limits>
#include <vector>

#include "simplify/pillow.h"
#include "simplify/plan_check.h"

namespace hexweft {

/// A sheet that can be collapsed with a pillow, and not without.
struct PillowedSheet {
  int sheet = 0;  ///< place in extract_sheets()
  Pillow pillow;
  int gain = 0;  ///< components of the sheet less those of the pillow
};

/// Those that gain at least two components, those that gain most first; of one sheet there may be two,
/// with pillows on either side. Nothing is moved: whether the surface stays near is for a trial to tell.
/// Cost O(#sheets * #cells), and some passes over the mesh for each pillow; less where `most` are known
/// that gain more than those of small sheets can.
/// \param mesh    is edited, and then as before
/// \param sheets  all of this base complex
/// \param most    that are wanted, at least 1
std::vector<PillowedSheet> find_pillows(HexMesh& mesh, const BaseComplex& bc,
                                        const std::vector<Sheet>& sheets,
                                        const ValenceLimits& limits,
                                        int most = std::numeric_limits<int>::max());

}  // namespace hexweft
