/// \file
/// What a distortion energy sees and what it answers, for one scalar type: double, or eight corners
/// at once.
///
/// energy.h states what a struct needs to be an energy.
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

/// M Mᵀ M. With the cofactor matrix C it gives the derivative of |J⁻¹|² = |C|² / det²,
/// which is −2 C Cᵀ C / det³.
template <class T>
HEXWEFT_INLINE Mat3<T> gram_product(const Mat3<T>& m) {
  const Vec3<T>* c = m.col;
  const T c00 = dot(c[0], c[0]), c11 = dot(c[1], c[1]), c22 = dot(c[2], c[2]);
  const T c01 = dot(c[0], c[1]), c02 = dot(c[0], c[2]), c12 = dot(c[1], c[2]);
  return {{c00 * c[0] + c01 * c[1] + c02 * c[2],  //
           c01 * c[0] + c11 * c[1] + c12 * c[2],  //
           c02 * c[0] + c12 * c[1] + c22 * c[2]}};
}

/// a M + b N.
template <class T>
HEXWEFT_INLINE Mat3<T> combine(const T& a, const Mat3<T>& m, const T& b, const Mat3<T>& n) {
  return {{a * m.col[0] + b * n.col[0], a * m.col[1] + b * n.col[1], a * m.col[2] + b * n.col[2]}};
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
