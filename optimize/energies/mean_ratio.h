/// \file
/// The inverse mean ratio: Knupp's shape metric turned into an energy.
#pragma once

#include <cmath>
#include <string_view>

#include <Eigen/Core>

#include "optimize/energies/deformation.h"

namespace hexweft {

/// |J|² / (3 det^(2/3)), one over Knupp's shape metric. Minimum 1 at rotations, and at rotations
/// times any size; infinite as det J → 0⁺ unless J shrinks as a whole. Source [Knupp2003].
struct MeanRatio {
  static constexpr std::string_view name = "mean-ratio";
  static constexpr bool barrier = true;
  double minimum() const { return 1; }

  template <class T>
  HEXWEFT_INLINE T value_and_stress(const Deformation<T>& d, Mat3<T>& stress) const {
    const T root = inverse_cube_root(d.det), m = (1.0 / 3) * root * root;
    const T value = m * squared_norm(d.jacobian);
    stress = combine<T>(2.0 * m, d.jacobian, (-2.0 / 3) * value / d.det, d.cofactor);
    return value;
  }

  /// Second derivative with the product of the slopes of |J|² and det^(-2/3) at its value for the
  /// mean singular value; exact at rest.
  template <class T>
  HEXWEFT_INLINE Curvature<T> curvature(const Deformation<T>& d) const {
    const T root = inverse_cube_root(d.det), m = (1.0 / 3) * root * root;
    const T size2 = d.det * root, h = (10.0 / 9) * squared_norm(d.jacobian) - (8.0 / 3) * size2;
    return {2.0 * m, m * h / (d.det * d.det), broadcast<T>(0)};
  }

  Eigen::Vector3d d_sigma(const Eigen::Vector3d& sigma) const {
    const double m = std::pow(sigma.prod(), -2. / 3.) / 3;
    return 2 * m * (sigma - sigma.squaredNorm() / 3 * sigma.cwiseInverse());
  }
};

}  // namespace hexweft
