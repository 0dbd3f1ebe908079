#include "optimize/smoothing_passes.h"

#include <algorithm>

namespace hexweft {

bool may_be_sharpened(const Energy& energy) { return energy.name() == InverseScaledJacobian::name; }

ParametrizationOptions options_for_least(ParametrizationOptions o, double floor) {
  o.least_on_projection = std::max(o.least_on_projection, floor);
  if (!may_be_sharpened(o.energy)) return o;
  o.energy = InverseScaledJacobian{.size = 0.3, .sharpness = 4};
  o.quality_goal = 1;
  o.quality_exponent = 1;
  o.quality_weight_limit = 1e3;
  return o;
}

/// (Σ SJ⁻⁶)^(-1/6) over the corners of a hexahedron is close to their least. A weight of SJ⁷ would
/// make the sum of SJ⁻⁶ descend along the sum of these means; about half of that does not give up
/// the poor ones for it. The weight of the lengths trades the mean for flat hexahedra: with 0.1 it is
/// 0.002 higher, and half as many again are fifty times as long as thick.
ParametrizationOptions options_for_mean(ParametrizationOptions o, double floor) {
  o.least_on_projection = std::max(o.least_on_projection, floor);
  o.quality_goal = 1;
  o.quality_exponent = 0;
  if (may_be_sharpened(o.energy)) {
    o.energy = InverseScaledJacobian{.size = 0.25, .sharpness = 3};
    o.quality_exponent = -3;
    o.quality_weight_limit = 1e3;
  }
  o.max_iterations = 4;
  o.relaxation_iterations = 15;
  return o;
}

}  // namespace hexweft
