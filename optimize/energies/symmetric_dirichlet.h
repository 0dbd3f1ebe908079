/// \file
/// The symmetric Dirichlet energy.
#pragma once

#include <string_view>

#include <Eigen/Core>

#include "optimize/energies/deformation.h"

namespace hexweft {

/// |J|² + |J⁻¹|². Minimum 6 at rotations, infinite as det J → 0⁺. Source [SmithSchaefer2015].
struct SymmetricDirichlet {
  static constexpr std::string_view name = "symmetric-dirichlet";
  static constexpr bool barrier = true;
  double minimum() const { return 6; }

  /// Stress 2 J − 2 J⁻ᵀ J⁻¹ J⁻ᵀ, written with the cofactor matrix C = det J⁻ᵀ.
  template <class T>
  HEXWEFT_INLINE T value_and_stress(const Deformation<T>& d, Mat3<T>& stress) const {
    const Vec3<T>*c = d.cofactor.col, *j = d.jacobian.col;
    const T inverse = 1.0 / d.det, inverse2 = inverse * inverse;
    const T c00 = dot(c[0], c[0]), c11 = dot(c[1], c[1]), c22 = dot(c[2], c[2]);
    const T c01 = dot(c[0], c[1]), c02 = dot(c[0], c[2]), c12 = dot(c[1], c[2]);
    const T f = -2.0 * inverse * inverse2, two = broadcast<T>(2);
    stress.col[0] = two * j[0] + f * (c00 * c[0] + c01 * c[1] + c02 * c[2]);
    stress.col[1] = two * j[1] + f * (c01 * c[0] + c11 * c[1] + c12 * c[2]);
    stress.col[2] = two * j[2] + f * (c02 * c[0] + c12 * c[1] + c22 * c[2]);
    return squared_norm(d.jacobian) + inverse2 * (c00 + c11 + c22);
  }

  /// Gauss–Newton of the residual J − J⁻ᵀ, which has the same value up to a constant and is exact
  /// at rest.
  template <class T>
  HEXWEFT_INLINE Curvature<T> curvature(const Deformation<T>& d) const {
    const T inverse2 = 1.0 / (d.det * d.det);
    return {broadcast<T>(2), 4.0 * inverse2, 2.0 * inverse2 * inverse2};
  }

  /// J − J⁻ᵀ.
  void residual(const Deformation<double>& d, Mat3<double>& r) const {
    r = combine<double>(1, d.jacobian, -1 / d.det, d.cofactor);
  }

  /// Along dJ = e_axis e_columnᵀ: dJ + J⁻ᵀ dJᵀ J⁻ᵀ.
  Mat3<double> residual_change(const Deformation<double>& d, int column, int axis) const {
    const Vec3<double>& b = d.cofactor.col[column];
    const auto entry = [axis](const Vec3<double>& v) {
      return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
    };
    Mat3<double> r;
    for (int k = 0; k < 3; ++k) {
      r.col[k] = (entry(d.cofactor.col[k]) / (d.det * d.det)) * b;
    }
    Vec3<double>& own = r.col[column];
    (axis == 0 ? own.x : axis == 1 ? own.y : own.z) += 1;
    return r;
  }

  Eigen::Vector3d d_sigma(const Eigen::Vector3d& sigma) const {
    return 2 * (sigma.array() - sigma.array().pow(-3)).matrix();
  }
};

}  // namespace hexweft
