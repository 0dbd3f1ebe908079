/// \file
/// Energies of somebody else's, in a file of their own: README.md shows the first.
#pragma once

#include <string_view>

#include <Eigen/Core>
#include <Eigen/LU>

#include "optimize/energies/differentiated.h"
#include "optimize/energies/energy.h"

namespace someone_else {

using namespace hexweft;

/// |J|² + 2 / det J. Minimum 5 at rotations, infinite as det J → 0⁺.
struct InverseVolume {
  static constexpr std::string_view name = "inverse-volume";
  static constexpr bool barrier = true;
  double minimum() const { return 5; }
  template <class T>
  HEXWEFT_INLINE T value_and_stress(const Deformation<T>& d, Mat3<T>& stress) const {
    stress = combine<T>(broadcast<T>(2), d.jacobian, -2.0 / (d.det * d.det), d.cofactor);
    return squared_norm(d.jacobian) + 2.0 / d.det;
  }
  template <class T>
  HEXWEFT_INLINE Curvature<T> curvature(const Deformation<T>& d) const {
    return {broadcast<T>(2), 4.0 / (d.det * d.det * d.det), broadcast<T>(0)};
  }
  Eigen::Vector3d d_sigma(const Eigen::Vector3d& s) const {
    return 2 * (s - s.cwiseInverse() / s.prod());
  }
};

/// The same, of single numbers alone.
struct PlainInverseVolume {
  static constexpr std::string_view name = "plain-inverse-volume";
  static constexpr bool barrier = true;
  double minimum() const { return 5; }
  double value_and_stress(const Deformation<double>& d, Mat3<double>& stress) const {
    return InverseVolume{}.value_and_stress(d, stress);
  }
  Curvature<double> curvature(const Deformation<double>& d) const {
    return InverseVolume{}.curvature(d);
  }
  Eigen::Vector3d d_sigma(const Eigen::Vector3d& s) const { return InverseVolume{}.d_sigma(s); }
};

/// The same, by its value alone.
struct InverseVolumeValue {
  static constexpr std::string_view name = "inverse-volume-value";
  static constexpr bool barrier = true;
  double minimum() const { return 5; }
  template <class T>
  T value(const Eigen::Matrix<T, 3, 3>& j) const {
    return j.squaredNorm() + T(2) / j.determinant();
  }
};

}  // namespace someone_else
