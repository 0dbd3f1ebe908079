/// \file
/// The exponential of another energy: it lets the worst elements count more than all the others.
#pragma once

#include <cmath>

#include <Eigen/Core>

#include "optimize/energies/deformation.h"

namespace hexweft {

/// exp(s (W − min W)) of an energy W with sharpness s. Minimum 1 where W has its own. Where the
/// exponent is over 20 the curve goes on as its second-order series there: a poor start, with
/// exponents in the hundreds, would overflow otherwise, and has no use for their exact size.
template <class Base>
struct ExponentialOf {
  static constexpr bool barrier = Base::barrier;
  Base base = {};
  double sharpness = 1;  ///< > 0

  double minimum() const { return 1; }

  template <class T>
  HEXWEFT_INLINE T value_and_stress(const Deformation<T>& d, Mat3<T>& stress) const {
    const Curve<T> c = curve(base.value_and_stress(d, stress));
    const T slope = sharpness * c.slope;
    for (int k = 0; k < 3; ++k) stress.col[k] = slope * stress.col[k];
    return c.value;
  }

  /// Chain rule. The term with (stress g)² is put down as one along b: the stress points that way
  /// where an element is squeezed, which is where the term is large.
  template <class T>
  HEXWEFT_INLINE Curvature<T> curvature(const Deformation<T>& d) const {
    Mat3<T> stress;
    const Curve<T> c = curve(base.value_and_stress(d, stress));
    const Curvature<T> k = base.curvature(d);
    const T slope = sharpness * c.slope, bend = (sharpness * sharpness) * c.bend;
    const T outer = bend * squared_norm(stress) / squared_norm(d.cofactor);
    return {slope * k.identity, slope * k.normal + outer, slope * k.cofactor};
  }

  Eigen::Vector3d d_sigma(const Eigen::Vector3d& sigma) const {
    Mat3<double> j{}, stress;
    j.col[0].x = sigma[0];
    j.col[1].y = sigma[1];
    j.col[2].z = sigma[2];
    const Curve<double> c = curve(base.value_and_stress(make_deformation(j), stress));
    return sharpness * c.slope * base.d_sigma(sigma);
  }

 private:
  template <class T>
  struct Curve {
    T value, slope, bend;
  };

  template <class T>
  HEXWEFT_INLINE Curve<T> curve(const T& energy) const {
    constexpr double kLimit = 20;
    const T exponent = sharpness * (energy - base.minimum());
    const T inside = exponent < kLimit ? exponent : broadcast<T>(kLimit);
    const T beyond = exponent - inside, bend = exponential(inside);
    const T slope = bend * (1.0 + beyond);
    return {bend * (1.0 + beyond * (1.0 + 0.5 * beyond)), slope, bend};
  }
};

}  // namespace hexweft
