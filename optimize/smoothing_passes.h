/// \file
/// What the passes of smooth() over the whole mesh make of the options they are given.
#pragma once

#include "optimize/local_parametrization.h"

namespace hexweft {

/// For passes that raise the least scaled Jacobian. The default energy is taken sharper; from a poor
/// start that would see the very worst corners only, so not there.
/// \param least  scaled Jacobian of the mesh
ParametrizationOptions options_for_least(ParametrizationOptions options, double least);

/// For passes that raise the mean scaled Jacobian and even the volumes.
ParametrizationOptions options_for_mean(ParametrizationOptions options);

}  // namespace hexweft
