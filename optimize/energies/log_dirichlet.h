/// \file
/// The Dirichlet energy with a logarithmic barrier.
#pragma once

#include <string_view>

#include <Eigen/Core>

#include "optimize/energies/deformation.h"

namespace hexweft {

/// |J|² − 2 log det J = Σ (σ² − 2 log σ). Minimum 3 at rotations, infinite as det J → 0⁺, though
/// slowly. Up to its scale the simplest compressible neo-Hookean material [BonetWood2008, §6.4.3]
/// without its volume term.
struct LogDirichlet {
  static constexpr std::string_view name = "log-dirichlet";
  static constexpr bool barrier = true;
  double minimum() const { return 3; }

  template <class T>
  HEXWEFT_INLINE T value_and_stress(const Deformation<T>& d, Mat3<T>& stress) const {
    stress = combine<T>(broadcast<T>(2), d.jacobian, -2.0 / d.det, d.cofactor);
    return squared_norm(d.jacobian) - 2.0 * logarithm(d.det);
  }

  /// Exact: the determinant is linear along rank-one changes.
  template <class T>
  HEXWEFT_INLINE Curvature<T> curvature(const Deformation<T>& d) const {
    return {broadcast<T>(2), 2.0 / (d.det * d.det), broadcast<T>(0)};
  }

  Eigen::Vector3d d_sigma(const Eigen::Vector3d& sigma) const {
    return 2 * (sigma - sigma.cwiseInverse());
  }
};

}  // namespace hexweft
