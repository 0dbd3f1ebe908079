/// \file
/// What the passes of smooth() make of the options they are given.
#pragma once

#include "optimize/local_parametrization.h"

namespace hexweft {

/// Whether these passes take the energy in a sharper form: the default one. It sums over the corners of a
/// hexahedron, whose quality is that of the least: the sharper the energy, the closer the two.
bool may_be_sharpened(const Energy& energy);

/// For passes that raise the least scaled Jacobian. The default energy is taken sharper.
/// \param floor  a scaled Jacobian; no vertex goes all the way to the surface where that would take a
///               hexahedron below it: the next relaxation would be spent on what that has spoilt
ParametrizationOptions options_for_least(ParametrizationOptions options, double floor);

/// For passes that raise the mean scaled Jacobian. \param floor  as above
ParametrizationOptions options_for_mean(ParametrizationOptions options, double floor);

}  // namespace hexweft
