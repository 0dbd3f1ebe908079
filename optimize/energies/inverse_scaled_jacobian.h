/// \file
/// The inverse square of the scaled Jacobian: the energy of what hexahedra are judged by.
#pragma once

#include <string_view>

#include <Eigen/Core>

#include "optimize/energies/deformation.h"

namespace hexweft {

/// (|J₁|² |J₂|² |J₃|² / det²)ⁿ + size (|J|² + |J⁻¹|²) with the columns J_k of J: the mesh edges at a
/// corner. The first term is 1 / SJ²ⁿ of the corner [Knupp2003], 1 where the edges are at right
/// angles and blind to their lengths; the symmetric Dirichlet energy next to it keeps these near
/// the target's. The sharper, the more the least corner of a hexahedron counts among its eight, as
/// it does in the quality of the hexahedron. Minimum 1 + 6 size at rotations, infinite as
/// det J → 0⁺. It knows the axes of the target cuboid, so a rotation on their side changes it.
struct InverseScaledJacobian {
  static constexpr std::string_view name = "inverse-scaled-jacobian";
  static constexpr bool barrier = true;
  static constexpr bool isotropic = false;
  double size = 0.1;  ///< > 0, weight of the lengths
  int sharpness = 1;  ///< > 0, n above

  double minimum() const { return 1 + 6 * size; }

  template <class T>
  HEXWEFT_INLINE T value_and_stress(const Deformation<T>& d, Mat3<T>& stress) const {
    const Vec3<T>*c = d.cofactor.col, *j = d.jacobian.col;
    const T inverse = 1.0 / d.det, inverse2 = inverse * inverse;
    const T n0 = dot(j[0], j[0]), n1 = dot(j[1], j[1]), n2 = dot(j[2], j[2]);
    const T c00 = dot(c[0], c[0]), c11 = dot(c[1], c[1]), c22 = dot(c[2], c[2]);
    const T c01 = dot(c[0], c[1]), c02 = dot(c[0], c[2]), c12 = dot(c[1], c[2]);
    const T base = n0 * n1 * n2 * inverse2;
    T angles = base;
    for (int n = 1; n < sharpness; ++n) angles = angles * base;
    const T twice = (2.0 * sharpness) * angles, fall = twice * inverse;
    const T f = (-2.0 * size) * inverse * inverse2, stay = broadcast<T>(2 * size);
    stress.col[0] =
        (stay + twice / n0) * j[0] + (f * c00 - fall) * c[0] + f * (c01 * c[1] + c02 * c[2]);
    stress.col[1] =
        (stay + twice / n1) * j[1] + (f * c11 - fall) * c[1] + f * (c01 * c[0] + c12 * c[2]);
    stress.col[2] =
        (stay + twice / n2) * j[2] + (f * c22 - fall) * c[2] + f * (c02 * c[0] + c12 * c[1]);
    return angles + size * (n0 + n1 + n2 + inverse2 * (c00 + c11 + c22));
  }

  /// Generous where only lengths change: the second term's, with the first as if every change of an
  /// edge turned it.
  template <class T>
  HEXWEFT_INLINE Curvature<T> curvature(const Deformation<T>& d) const {
    const T inverse2 = 1.0 / (d.det * d.det);
    return {broadcast<T>(2.0 * sharpness), (4.0 * sharpness) * inverse2,
            (2.0 * sharpness) * inverse2 * inverse2};
  }

  /// For J = diag(σ), where all angles are right.
  Eigen::Vector3d d_sigma(const Eigen::Vector3d& sigma) const {
    return 2 * size * (sigma.array() - sigma.array().pow(-3)).matrix();
  }
};

}  // namespace hexweft
