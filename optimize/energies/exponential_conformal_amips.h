/// \file
/// The exponential of the conformal AMIPS energy.
#pragma once

#include <string_view>

#include "optimize/energies/conformal_amips.h"
#include "optimize/energies/exponential.h"

namespace hexweft {

/// exp(s (W − 1)) with W = (|J|² |J⁻¹|² − 1) / 8. Minimum 1 at rotations times any size; infinite as
/// det J → 0⁺ unless J shrinks as a whole. Source [Fu2015, §3]. Differs: scaled to 1 at its minimum,
/// see exponential.h.
struct ExponentialConformalAmips : ExponentialOf<ConformalAmips> {
  static constexpr std::string_view name = "exponential-conformal-amips";
};

}  // namespace hexweft
