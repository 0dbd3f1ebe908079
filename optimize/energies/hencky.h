/// \file
/// The Hencky energy: squared logarithmic strain.
#pragma once

#include <string_view>

#include <Eigen/Core>

#include "optimize/energies/deformation.h"
#include "optimize/energies/singular_values.h"

namespace hexweft {

/// |log √(JᵀJ)|² = Σ log² σ. Minimum 0 at rotations, infinite as det J → 0⁺, though slowly; not
/// convex far from rotations. Source [Hencky1928]; also [Rabinovich2017, Table 1].
struct Hencky {
  static constexpr std::string_view name = "hencky";
  static constexpr bool barrier = true;
  double minimum() const { return 0; }

  template <class T>
  HEXWEFT_INLINE T value_and_stress(const Deformation<T>& d, Mat3<T>& stress) const {
    const OneSided<T> s = singular_vectors(d.jacobian);
    T value = broadcast<T>(0);
    stress = {};
    for (int i = 0; i < 3; ++i) {
      const Vec3<T>&us = s.scaled_left.col[i], &v = s.right.col[i];
      const T sigma2 = dot(us, us), log_sigma = 0.5 * logarithm(sigma2);
      value += log_sigma * log_sigma;
      const Vec3<T> w = (2.0 * log_sigma / sigma2) * us;
      stress.col[0] = stress.col[0] + v.x * w;
      stress.col[1] = stress.col[1] + v.y * w;
      stress.col[2] = stress.col[2] + v.z * w;
    }
    return value;
  }

  /// Exact at rest; (1 − log σ) / σ² in the direction that is squeezed, where the energy is convex.
  template <class T>
  HEXWEFT_INLINE Curvature<T> curvature(const Deformation<T>& d) const {
    const T inverse2 = 1.0 / (d.det * d.det);
    const T squeezed2 = larger(squared_norm(d.cofactor) * inverse2 * (1.0 / 3), broadcast<T>(1));
    return {3.0 / squared_norm(d.jacobian), (1.0 + 0.5 * logarithm(squeezed2)) * inverse2,
            broadcast<T>(0)};
  }

  Eigen::Vector3d d_sigma(const Eigen::Vector3d& sigma) const {
    return (2 * sigma.array().log() / sigma.array()).matrix();
  }
};

}  // namespace hexweft
