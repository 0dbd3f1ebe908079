/// \file
/// A regularized barrier energy that is finite on inverted elements: the untangling energy.
#pragma once

#include <cmath>
#include <string_view>

#include <Eigen/Core>

#include "optimize/energies/deformation.h"

namespace hexweft {

/// |J|² / χ^(2/3) + λ (det² + 1) / χ with χ(det) = (det + √(ε² + det²)) / 2.
/// Finite everywhere for ε > 0; as ε → 0 it becomes a barrier energy with minimum 3 + 2 λ at
/// rotations. Source [Garanzha2021].
struct FoldoverFree {
  static constexpr std::string_view name = "foldover-free";
  static constexpr bool barrier = false;
  double epsilon = 1e-3;  ///< > 0, in units of the target's volume
  double lambda = 1.0;    ///< > 0, weight of the volume term

  double minimum() const { return 3 / std::pow(chi(1), 2. / 3.) + 2 * lambda / chi(1); }
  double chi(double det) const { return (det + std::sqrt(epsilon * epsilon + det * det)) / 2; }

  /// The ε that leaves the worst corner a gradient worth following. \param min_det least
  /// determinant, relative to the target's volume.
  static double epsilon_for(double min_det) {
    return min_det > 0 ? 1e-4 : std::sqrt(1e-8 + 0.04 * min_det * min_det);
  }

  template <class T>
  HEXWEFT_INLINE T value_and_stress(const Deformation<T>& d, Mat3<T>& stress) const {
    const Regularized<T> r = regularize(d.det);
    const T shape = squared_norm(d.jacobian), shape_factor = r.inverse_root2;
    const T volume = lambda * (d.det * d.det + 1.0) * r.inverse;
    const T d_det = (2.0 * lambda) * d.det * r.inverse -
                    (volume + (2.0 / 3.0) * shape * shape_factor) * r.slope_over_chi;
    for (int k = 0; k < 3; ++k) {
      stress.col[k] = (2.0 * shape_factor) * d.jacobian.col[k] + d_det * d.cofactor.col[k];
    }
    return shape * shape_factor + volume;
  }

  template <class T>
  HEXWEFT_INLINE Curvature<T> curvature(const Deformation<T>& d) const {
    const Regularized<T> r = regularize(d.det);
    const T shape = squared_norm(d.jacobian);
    const T h =
        2.0 * lambda * (d.det * d.det + 1.0) * r.inverse + (10.0 / 9.0) * shape * r.inverse_root2;
    return {2.0 * r.inverse_root2, h * r.slope_over_chi * r.slope_over_chi, broadcast<T>(0)};
  }

  Eigen::Vector3d d_sigma(const Eigen::Vector3d& s) const {
    const double det = s.prod(), x = chi(det), slope = x / std::sqrt(epsilon * epsilon + det * det);
    const double root2 = std::pow(x, -2. / 3.);
    const double d_det =
        2 * lambda * det / x -
        (lambda * (det * det + 1) / x + 2. / 3. * s.squaredNorm() * root2) * slope / x;
    return 2 * root2 * s + d_det * Eigen::Vector3d(s[1] * s[2], s[2] * s[0], s[0] * s[1]);
  }

 private:
  /// 1/χ, χ^(-2/3) and χ'/χ = 1/√(ε² + det²).
  template <class T>
  struct Regularized {
    T inverse, inverse_root2, slope_over_chi;
  };

  /// For det < 0 the sum in χ cancels; χ = ε² / (2 (√(ε² + det²) − det)) does not.
  template <class T>
  HEXWEFT_INLINE Regularized<T> regularize(const T& det) const {
    const T e2 = broadcast<T>(epsilon * epsilon), root = square_root(e2 + det * det);
    const T magnitude = larger(det, -det), large = 0.5 * (root + magnitude);
    const T chi_value = det > 0.0 ? large : 0.25 * e2 / large;
    const T inverse_root = inverse_cube_root(chi_value);
    return {1.0 / chi_value, inverse_root * inverse_root, 1.0 / root};
  }
};

}  // namespace hexweft
