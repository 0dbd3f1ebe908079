#include "optimize/smoothing_passes.h"

namespace hexweft {
namespace {

constexpr int kVolumePasses = 6;

/// The energy sums over the corners of a hexahedron, its quality is that of the least: the sharper
/// the energy, the closer the two. Others are what they are.
bool may_be_sharpened(const Energy& energy) { return energy.name() == InverseScaledJacobian::name; }

}  // namespace

ParametrizationOptions options_for_least(ParametrizationOptions o, double least) {
  constexpr double kFairStart = 0.2;
  if (!may_be_sharpened(o.energy) || least < kFairStart) return o;
  o.energy = InverseScaledJacobian{.size = 1, .sharpness = 4};
  o.quality_goal = 1;
  o.quality_exponent = 1;
  o.quality_weight_limit = 1e3;
  o.target.volume_passes = kVolumePasses;
  return o;
}

/// (Σ SJ⁻⁶)^(-1/6) over the corners of a hexahedron is close to their least. A weight of SJ⁷ would
/// make the sum of SJ⁻⁶ descend along the sum of these means; about half of that also keeps the
/// volumes even.
ParametrizationOptions options_for_mean(ParametrizationOptions o) {
  o.quality_goal = 1;
  o.quality_exponent = 0;
  if (may_be_sharpened(o.energy)) {
    o.energy = InverseScaledJacobian{.size = 1.5, .sharpness = 3};
    o.quality_exponent = -3;
    o.quality_weight_limit = 1e3;
  }
  o.target.volume_passes = kVolumePasses;
  o.max_iterations = 4;
  o.relaxation_iterations = 15;
  return o;
}

}  // namespace hexweft
