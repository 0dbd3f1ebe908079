/// \file
/// What a distortion energy sees and what it answers, for one scalar type: double, or eight corners
/// at once.
///
/// An energy is a struct with
///     static constexpr std::string_view name;    // its name on the command line
///     static constexpr bool barrier;             // infinite as det J -> 0+, not defined beyond
///     double minimum() const;                    // its value at rotations
///     template <class T> T value_and_stress(const Deformation<T>&, Mat3<T>& stress) const;
///     template <class T> Curvature<T> curvature(const Deformation<T>&) const;
///     Eigen::Vector3d d_sigma(const Eigen::Vector3d& sigma) const;
/// and a row in table.h. Nothing else has to know it.
#pragma once

#include "optimize/lanes.h"

namespace hexweft {

/// A Jacobian J (columns), its cofactor matrix (cof = det J^-T) and its determinant.
template <class T>
struct Deformation {
  Mat3<T> jacobian;
  Mat3<T> cofactor;
  T det;
};

template <class T>
HEXWEFT_INLINE Deformation<T> make_deformation(const Mat3<T>& j) {
  Deformation<T> d;
  d.jacobian = j;
  d.cofactor.col[0] = cross(j.col[1], j.col[2]);
  d.cofactor.col[1] = cross(j.col[2], j.col[0]);
  d.cofactor.col[2] = cross(j.col[0], j.col[1]);
  d.det = dot(j.col[0], d.cofactor.col[0]);
  return d;
}

/// A positive model of the second derivative along rank-one changes dJ = u gᵀ, the only ones one
/// vertex can make. With b = cof g:
///     uᵀ H u,  H = identity |g|² I + normal b bᵀ + cofactor |b|² cof cofᵀ.
/// Serves as preconditioner; it need not be exact, but positive where the energy is defined.
template <class T>
struct Curvature {
  T identity, normal, cofactor;
};

}  // namespace hexweft
