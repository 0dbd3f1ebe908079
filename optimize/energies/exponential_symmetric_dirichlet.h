/// \file
/// The exponential symmetric Dirichlet energy.
#pragma once

#include <string_view>

#include "optimize/energies/exponential.h"
#include "optimize/energies/symmetric_dirichlet.h"

namespace hexweft {

/// exp(s (|J|² + |J⁻¹|² − 6)). Minimum 1 at rotations, infinite as det J → 0⁺.
/// Source [Rabinovich2017, Table 1]. Differs: scaled to 1 at its minimum, see exponential.h.
struct ExponentialSymmetricDirichlet : ExponentialOf<SymmetricDirichlet> {
  static constexpr std::string_view name = "exponential-symmetric-dirichlet";
};

}  // namespace hexweft
