/// \file
/// As rigid as possible: the distance to the closest rotation.
#pragma once

#include <string_view>

#include <Eigen/Core>

#include "optimize/energies/deformation.h"

namespace hexweft {

/// |J − R|², R the rotation closest to J: Σ (σ − 1)² with the least σ negative where det J < 0.
/// Minimum 0 at rotations, finite everywhere. Source [SorkineAlexa2007].
struct Arap {
  static constexpr std::string_view name = "arap";
  static constexpr bool barrier = false;
  double minimum() const { return 0; }

  template <class T>
  HEXWEFT_INLINE T value_and_stress(const Deformation<T>& d, Mat3<T>& stress) const {
    const Closest<T> r = closest_rotation(d);
    T value = broadcast<T>(0);
    for (int k = 0; k < 3; ++k) {
      const Vec3<T> off = d.jacobian.col[k] - r.rotation.col[k];
      value += dot(off, off);
      stress.col[k] = broadcast<T>(2) * off;
    }
    return value;
  }

  /// With R held: never less than the true one.
  template <class T>
  HEXWEFT_INLINE Curvature<T> curvature(const Deformation<T>&) const {
    return {broadcast<T>(2), broadcast<T>(0), broadcast<T>(0)};
  }

  Eigen::Vector3d d_sigma(const Eigen::Vector3d& sigma) const {
    return 2 * (sigma - Eigen::Vector3d::Ones());
  }

 private:
  template <class T>
  struct Closest {
    Mat3<T> rotation;
  };

  /// The sum f of the signed singular values is the largest root of
  ///     f⁴ − 2 |J|² f² − 8 det f + |J|⁴ − 4 |cof J|²,
  /// found by Newton's method from √3 |J|, an upper bound that is exact at rotations; R = ∂f/∂J.
  /// The root is double, and R one of many, where J is inverted with σ₃ = −σ₂. Source: the signs'
  /// four sums σ₁ ± σ₂ ± σ₃ with an even number of minus are the roots.
  template <class T>
  HEXWEFT_INLINE Closest<T> closest_rotation(const Deformation<T>& d) const {
    constexpr int kMaxSteps = 40;
    const T a = squared_norm(d.jacobian), b = squared_norm(d.cofactor), det = d.det;
    const T least = 1e-30 * a * square_root(a) + 1e-300;
    T f = square_root(3.0 * a);
    for (int step = 0; step < kMaxSteps; ++step) {
      const T f2 = f * f, slope = larger(f * (f2 - a) - 2.0 * det, least);
      const T excess = f2 * (f2 - 2.0 * a) - 8.0 * det * f + (a * a - 4.0 * b);
      const T change = larger(excess, broadcast<T>(0)) / (4.0 * slope);
      f = f - change;
      if (!(lane_max(change - 1e-15 * f) > 0)) break;
    }
    const T inverse = 1.0 / larger(f * (f * f - a) - 2.0 * det, 1e-12 * a * square_root(a) + least);
    const Mat3<T> g = gram_product(d.jacobian);
    Closest<T> r;
    for (int k = 0; k < 3; ++k) {
      r.rotation.col[k] = ((f * f + a) * inverse) * d.jacobian.col[k] +
                          (2.0 * f * inverse) * d.cofactor.col[k] - (2.0 * inverse) * g.col[k];
    }
    return r;
  }
};

}  // namespace hexweft
