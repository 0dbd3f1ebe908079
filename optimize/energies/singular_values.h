/// \file
/// Singular values of a 3 × 3 matrix, for one number or for eight lanes at once.
#pragma once

#include "optimize/lanes.h"

namespace hexweft {

/// J V, whose columns are orthogonal, and V, a rotation. The length of a column of J V is a singular
/// value σ, the column divided by σ a left singular vector.
template <class T>
struct OneSided {
  Mat3<T> scaled_left, right;
};

/// One-sided Jacobi: columns are turned against each other until all are orthogonal. Small singular
/// values are as exact as large ones.
template <class T>
HEXWEFT_INLINE OneSided<T> singular_vectors(const Mat3<T>& j) {
  constexpr int kMaxSweeps = 10;
  constexpr double kOrthogonal2 = 1e-31;  // of the squared cosine between two columns
  const T zero = broadcast<T>(0), one = broadcast<T>(1), tiny = broadcast<T>(1e-300);
  OneSided<T> s{j, {{{one, zero, zero}, {zero, one, zero}, {zero, zero, one}}}};
  const auto turn = [](Vec3<T>& a, Vec3<T>& b, const T& c, const T& t) {
    const Vec3<T> kept = a;
    a = c * (kept - t * b);
    b = c * (t * kept + b);
  };
  for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
    T worst = zero;
    for (int pair = 0; pair < 3; ++pair) {
      const int p = pair == 2 ? 1 : 0, q = pair == 0 ? 1 : 2;
      Vec3<T>&a = s.scaled_left.col[p], &b = s.scaled_left.col[q];
      const T aa = dot(a, a), bb = dot(b, b), ab = dot(a, b), gap = bb - aa;
      worst = larger(worst, ab * ab / (aa * bb + tiny));
      const T size = larger(gap, -gap) + square_root(gap * gap + 4.0 * ab * ab) + tiny;
      const T t = 2.0 * (gap < zero ? -ab : ab) / size;
      const T c = 1.0 / square_root(1.0 + t * t);
      turn(a, b, c, t);
      turn(s.right.col[p], s.right.col[q], c, t);
    }
    if (!(lane_max(worst) > kOrthogonal2)) break;
  }
  return s;
}

}  // namespace hexweft
