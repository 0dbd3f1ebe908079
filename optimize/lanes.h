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
#include <limits>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#define HEXWEFT_INLINE inline __attribute__((always_inline))

namespace hexweft {

using Lanes = double __attribute__((vector_size(64)));
using IntLanes = std::int64_t __attribute__((vector_size(64)));
using BitLanes = std::uint64_t __attribute__((vector_size(64)));

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
/// Where the library's square root sets errno it costs a branch a lane; the instruction does not.
HEXWEFT_INLINE Lanes square_root(const Lanes& a) {
  Lanes r;
#if defined(__SSE2__) && !defined(__NO_MATH_ERRNO__)
  for (int i = 0; i < 8; i += 2) {
    const __m128d root = _mm_sqrt_pd(__m128d{a[i], a[i + 1]});
    r[i] = root[0];
    r[i + 1] = root[1];
  }
#else
  for (int i = 0; i < 8; ++i) r[i] = __builtin_sqrt(a[i]);
#endif
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

HEXWEFT_INLINE Lanes lanes_of_bits(const BitLanes& bits) {
  Lanes a;
  std::memcpy(&a, &bits, sizeof a);
  return a;
}
HEXWEFT_INLINE BitLanes bits_of_lanes(const Lanes& a) {
  BitLanes bits;
  std::memcpy(&bits, &a, sizeof bits);
  return bits;
}

/// ln 2 in two parts; the first has so many zero bits that its product with an exponent is exact.
inline constexpr double kLn2High = 0x1.62e42feep-1, kLn2Low = 0x1.a39ef35793c76p-33;

/// Natural logarithm of positive normal numbers: exponent · ln 2 + 2 artanh((m − 1) / (m + 1)) with
/// m in [√½, √2), by its series; relative error near 1e-15 (absolute where a is close to 1).
HEXWEFT_INLINE Lanes logarithm(const Lanes& a) {
  constexpr std::uint64_t kOne = 0x3ff0000000000000, kRootOfHalf = 0x3fe6a09e667f3bcd;
  constexpr std::uint64_t kTwoTo52 = 0x4330000000000000;
  const BitLanes bits = bits_of_lanes(a);
  const BitLanes biased = (bits + (kOne - kRootOfHalf)) >> 52;
  const Lanes m = lanes_of_bits(bits - ((biased - 1023) << 52));
  const Lanes exponent = lanes_of_bits(biased | kTwoTo52) - (0x1p52 + 1023);
  const Lanes s = (m - 1.0) / (m + 1.0), z = s * s;
  constexpr double kSeries[] = {1. / 21, 1. / 19, 1. / 17, 1. / 15, 1. / 13, 1. / 11,
                                1. / 9,  1. / 7,  1. / 5,  1. / 3,  1.};
  Lanes sum = broadcast<Lanes>(1. / 23);
  for (const double term : kSeries) sum = sum * z + term;
  return exponent * kLn2High + (2.0 * s * sum + exponent * kLn2Low);
}
HEXWEFT_INLINE double logarithm(double a) { return std::log(a); }

/// e^a by the series of the remainder after whole powers of 2; infinite beyond 709, next to nothing
/// below -708.
HEXWEFT_INLINE Lanes exponential(const Lanes& a) {
  constexpr double kRound = 0x1.8p52, kLog2OfE = 0x1.71547652b82fep0;
  const Lanes low = broadcast<Lanes>(-708), high = broadcast<Lanes>(709);
  const Lanes x = a < low ? low : (a > high ? high : a);
  const Lanes shifted = x * kLog2OfE + kRound, n = shifted - kRound;
  const Lanes r = (x - n * kLn2High) - n * kLn2Low;
  constexpr double kInverses[] = {1. / 14, 1. / 13, 1. / 12, 1. / 11, 1. / 10, 1. / 9, 1. / 8,
                                  1. / 7,  1. / 6,  1. / 5,  1. / 4,  1. / 3,  1. / 2, 1.};
  Lanes sum = broadcast<Lanes>(1);
  for (const double inverse : kInverses) sum = sum * (r * inverse) + 1.0;
  const Lanes power = lanes_of_bits((bits_of_lanes(shifted) + 1023) << 52);
  return a > high ? broadcast<Lanes>(std::numeric_limits<double>::infinity()) : sum * power;
}
HEXWEFT_INLINE double exponential(double a) { return std::exp(a); }

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
HEXWEFT_INLINE double lane_max(const Lanes& a) { return -lane_min(-a); }
HEXWEFT_INLINE double lane_max(double a) { return a; }

}  // namespace hexweft
