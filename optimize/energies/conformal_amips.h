/// \file
/// The conformal AMIPS energy: shape without size.
#pragma once

#include <string_view>

#include <Eigen/Core>

#include "optimize/energies/deformation.h"

namespace hexweft {

/// (|J|² |J⁻¹|² − 1) / 8 = Π over pairs of (σi/σj + σj/σi) / 2. Minimum 1 at rotations, and at
/// rotations times any size; infinite as det J → 0⁺ unless J shrinks as a whole.
/// Source [Fu2015, §3].
struct ConformalAmips {
  static constexpr std::string_view name = "conformal-amips";
  static constexpr bool barrier = true;
  double minimum() const { return 1; }

  template <class T>
  HEXWEFT_INLINE T value_and_stress(const Deformation<T>& d, Mat3<T>& stress) const {
    const T inverse = 1.0 / d.det, inverse2 = inverse * inverse;
    const T a = squared_norm(d.jacobian), b = squared_norm(d.cofactor) * inverse2;
    stress =
        combine<T>(0.25 * b, d.jacobian, -0.25 * a * inverse2 * inverse, gram_product(d.cofactor));
    return 0.125 * (a * b - 1.0);
  }

  /// Second derivative with J⁻ᵀ J⁻¹ and J g replaced by their means; exact at rest.
  template <class T>
  HEXWEFT_INLINE Curvature<T> curvature(const Deformation<T>& d) const {
    const T inverse2 = 1.0 / (d.det * d.det);
    const T a = squared_norm(d.jacobian), b = squared_norm(d.cofactor) * inverse2;
    return {0.25 * b, (a * b * (1.0 / 6) - 1.0) * inverse2, 0.25 * a * inverse2 * inverse2};
  }

  Eigen::Vector3d d_sigma(const Eigen::Vector3d& sigma) const {
    const double a = sigma.squaredNorm(), b = sigma.cwiseInverse().squaredNorm();
    return 0.25 * (b * sigma.array() - a * sigma.array().pow(-3)).matrix();
  }
};

}  // namespace hexweft
