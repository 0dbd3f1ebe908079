/// \file
/// Every distortion energy that comes with hexweft, one row each. A new one is a header in this
/// folder and a row here; one of your own needs neither, see energy.h.
#pragma once

#include <string_view>
#include <vector>

#include "optimize/energies/arap.h"
#include "optimize/energies/conformal_amips.h"
#include "optimize/energies/energy.h"
#include "optimize/energies/exponential_conformal_amips.h"
#include "optimize/energies/exponential_symmetric_dirichlet.h"
#include "optimize/energies/foldover_free.h"
#include "optimize/energies/hencky.h"
#include "optimize/energies/inverse_scaled_jacobian.h"
#include "optimize/energies/log_dirichlet.h"
#include "optimize/energies/mean_ratio.h"
#include "optimize/energies/symmetric_dirichlet.h"
#include "ovm/errors.h"

// clang-format off
#define HEXWEFT_ENERGIES(ROW)         \
  ROW(SymmetricDirichlet)             \
  ROW(ExponentialSymmetricDirichlet)  \
  ROW(Arap)                           \
  ROW(ConformalAmips)                 \
  ROW(ExponentialConformalAmips)      \
  ROW(LogDirichlet)                   \
  ROW(Hencky)                         \
  ROW(MeanRatio)                      \
  ROW(InverseScaledJacobian)          \
  ROW(FoldoverFree)
// clang-format on

namespace hexweft {

#define HEXWEFT_DECLARE(Kind) extern template class EnergyModelOf<Kind>;
HEXWEFT_ENERGIES(HEXWEFT_DECLARE)
#undef HEXWEFT_DECLARE

/// One of each, in the order of the table, with its default parameters.
std::vector<Energy> all_energies();

/// \throws InputError if no energy has this name; the message lists those there are.
Energy make_energy(std::string_view wanted);

}  // namespace hexweft
