/// \file
/// An energy made from a value alone: ceres differentiates it.
///
///     struct Volume {                                            // any scalar with + - * / sqrt ...
///       static constexpr std::string_view name = "volume";
///       static constexpr bool barrier = false;
///       double minimum() const { return 0; }
///       template <class T> T value(const Eigen::Matrix<T, 3, 3>& j) const {
///         const T off = j.determinant() - T(1);
///         return off * off;
///       }
///     };
///     relax(problem, Differentiated<Volume>{}, {.formulation = Formulation::residual_blocks});
///
/// To try out an idea. One corner at a time with nine derivatives in tow, it costs many times what a
/// written-out derivative does. Needs the headers of ceres where it is included.
#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>

#include <Eigen/Core>
#include <Eigen/LU>
#include <ceres/jet.h>

#include "optimize/energies/energy.h"

namespace hexweft {

/// \tparam V  as above: name, barrier, minimum(), and a value with its minimum at rotations
template <class V>
class Differentiated {
 public:
  static constexpr std::string_view name = V::name;
  static constexpr bool barrier = V::barrier;

  explicit Differentiated(const V& energy = {})
      : energy_(energy), stiffness_(stiffness_at_rest()) {}

  double minimum() const { return energy_.minimum(); }

  double value_and_stress(const Deformation<double>& d, Mat3<double>& stress) const {
    Eigen::Matrix3d j;
    for (int k = 0; k < 3; ++k) {
      const Vec3<double>& c = d.jacobian.col[k];
      j.col(k) = Eigen::Vector3d(c.x, c.y, c.z);
    }
    const Jet value = value_of(j);
    for (int k = 0; k < 3; ++k) {
      stress.col[k] = {value.v[3 * k], value.v[3 * k + 1], value.v[3 * k + 2]};
    }
    return value.a;
  }

  /// The largest second derivative at rest, in every direction; with a barrier, as much again for
  /// the logarithm of the determinant.
  Curvature<double> curvature(const Deformation<double>& d) const {
    return {stiffness_, barrier ? stiffness_ / (d.det * d.det) : 0, 0};
  }

  Eigen::Vector3d d_sigma(const Eigen::Vector3d& sigma) const {
    const Jet value = value_of(sigma.asDiagonal());
    return {value.v[0], value.v[4], value.v[8]};
  }

 private:
  using Jet = ceres::Jet<double, 9>;

  Jet value_of(const Eigen::Matrix3d& j) const {
    Eigen::Matrix<Jet, 3, 3> jets;
    for (int i = 0; i < 9; ++i) jets(i) = Jet(j(i), i);
    return energy_.value(jets);
  }

  /// Along e₁ e₁ᵀ and e₁ e₂ᵀ; all other directions follow from these by rotation.
  double stiffness_at_rest() const {
    constexpr double kStep = 1e-5;
    double largest = 1e-6;
    for (const int i : {0, 1}) {
      Eigen::Matrix3d above = Eigen::Matrix3d::Identity(), below = above;
      above(i) += kStep;
      below(i) -= kStep;
      largest = std::max(largest, (value_of(above).v[i] - value_of(below).v[i]) / (2 * kStep));
    }
    return largest;
  }

  V energy_;
  double stiffness_;
};

}  // namespace hexweft
