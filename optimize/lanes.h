/// \file
/// Eight doubles side by side: the eight corners of a hexahedron as the lanes of one vector.
///
/// `Lanes` is a compiler vector, so the same code becomes SSE2, AVX2 or AVX-512 instructions,
/// whichever the function it is inlined into is compiled for. Everything here is forced inline for
/// that reason: a call would fall back to the instruction set of the translation unit. `Vec3` and
/// `Mat3` hold columns of any scalar (double or Lanes), so that a distortion energy is written
/// once.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>

#define HEXWEFT_INLINE inline __attribute__((always_inline))

namespace hexweft {

using Lanes = double __attribute__((vector_size(64)));
using IntLanes = std::int64_t __attribute__((vector_size(64)));

/// A column vector of scalars T.
template <class T>
struct Vec3 {
  T x, y, z;
};

/// A 3 x 3 matrix by its columns.
template <class T>
struct Mat3 {
  Vec3<T> col[3];
};

template <class T>
HEXWEFT_INLINE Vec3<T> operator+(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
HEXWEFT_INLINE Vec3<T> operator-(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
HEXWEFT_INLINE Vec3<T> operator*(const T& s, const Vec3<T>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class T>
HEXWEFT_INLINE T dot(const Vec3<T>& a, const Vec3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
HEXWEFT_INLINE Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
HEXWEFT_INLINE T squared_norm(const Mat3<T>& m) {
  return dot(m.col[0], m.col[0]) + dot(m.col[1], m.col[1]) + dot(m.col[2], m.col[2]);
}

/// The same number in every lane; the number itself for double.
template <class T>
HEXWEFT_INLINE T broadcast(double s) {
  return T{} + s;
}

HEXWEFT_INLINE double square_root(double a) { return std::sqrt(a); }
HEXWEFT_INLINE Lanes square_root(const Lanes& a) {
  Lanes r;
  for (int i = 0; i < 8; ++i) r[i] = __builtin_sqrt(a[i]);
  return r;
}

HEXWEFT_INLINE double larger(double a, double b) { return a > b ? a : b; }
HEXWEFT_INLINE Lanes larger(const Lanes& a, const Lanes& b) { return a > b ? a : b; }

/// a^(-1/3) of positive numbers: a guess from the exponent bits, then Newton on y^-3 = a. Four
/// steps leave a relative error near 1e-15.
HEXWEFT_INLINE Lanes inverse_cube_root(const Lanes& a) {
  IntLanes bits;
  std::memcpy(&bits, &a, sizeof bits);
  for (int i = 0; i < 8; ++i) bits[i] = 0x553ef0ff289dd796LL - bits[i] / 3;
  Lanes y;
  std::memcpy(&y, &bits, sizeof y);
  for (int step = 0; step < 4; ++step) y = y * (4.0 - a * y * y * y) * (1.0 / 3.0);
  return y;
}
HEXWEFT_INLINE double inverse_cube_root(double a) { return 1.0 / std::cbrt(a); }

HEXWEFT_INLINE double lane_sum(const Lanes& a) {
  double s = 0;
  for (int i = 0; i < 8; ++i) s += a[i];
  return s;
}
HEXWEFT_INLINE double lane_min(const Lanes& a) {
  double s = a[0];
  for (int i = 1; i < 8; ++i) s = a[i] < s ? a[i] : s;
  return s;
}

}  // namespace hexweft
