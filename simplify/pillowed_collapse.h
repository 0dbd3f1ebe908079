/// \file
/// The trial of a sheet's collapse with a pillow beside what is in its way.
#pragma once

#include "simplify/pillow.h"
#include "simplify/trial.h"

namespace hexweft {

/// Puts in the pillow, relaxes round it and collapses the sheet, with all checks of try_collapse(); on
/// refusal the mesh and the distance are as before.
TrialResult try_pillowed_collapse(TrialContext& context, const BaseComplex& bc, const Sheet& sheet,
                                  const Pillow& pillow, const SimplifyOptions& options);

}  // namespace hexweft
