/// \file
/// The loops over hexahedra, eight corners at a time, for one energy and every instruction set.
///
/// An energy of the table never meets these: they are compiled once, in table.cpp. A header has them
/// because an energy of somebody else's needs them compiled in somebody else's file.
#pragma once

#include <cstddef>
#include <limits>

#include "optimize/energies/deformation.h"
#include "optimize/hex_batch.h"
#include "ovm/hex_numbering.h"

namespace hexweft::kernels {

/// The lane of the corner across axis A.
template <int A>
HEXWEFT_INLINE Lanes across(const Lanes& v) {
  if constexpr (A == 0) return __builtin_shufflevector(v, v, 1, 0, 3, 2, 5, 4, 7, 6);
  if constexpr (A == 1) return __builtin_shufflevector(v, v, 3, 2, 1, 0, 7, 6, 5, 4);
  if constexpr (A == 2) return __builtin_shufflevector(v, v, 4, 5, 6, 7, 0, 1, 2, 3);
}
static_assert(kCornerAcross[0][0] == 1 && kCornerAcross[0][1] == 3 && kCornerAcross[0][2] == 4 &&
              kCornerAcross[6][0] == 7 && kCornerAcross[6][1] == 5 && kCornerAcross[6][2] == 2);

template <int A>
HEXWEFT_INLINE Vec3<Lanes> across(const Vec3<Lanes>& v) {
  return {across<A>(v.x), across<A>(v.y), across<A>(v.z)};
}

/// +1 at the corners where local coordinate `axis` is 0, -1 where it is 1.
HEXWEFT_INLINE Lanes axis_sign(int axis) {
  if (axis == 0) return Lanes{1, -1, -1, 1, 1, -1, -1, 1};
  if (axis == 1) return Lanes{1, 1, -1, -1, 1, 1, -1, -1};
  return Lanes{1, 1, 1, 1, -1, -1, -1, -1};
}

HEXWEFT_INLINE Vec3<Lanes> gather(const double* p, const HexCorners& h) {
  const double* c[8];
  for (int i = 0; i < 8; ++i) c[i] = p + 3 * static_cast<std::ptrdiff_t>(h[i]);
  return {Lanes{c[0][0], c[1][0], c[2][0], c[3][0], c[4][0], c[5][0], c[6][0], c[7][0]},
          Lanes{c[0][1], c[1][1], c[2][1], c[3][1], c[4][1], c[5][1], c[6][1], c[7][1]},
          Lanes{c[0][2], c[1][2], c[2][2], c[3][2], c[4][2], c[5][2], c[6][2], c[7][2]}};
}

/// The three edges at every corner, each along its axis.
HEXWEFT_INLINE Mat3<Lanes> corner_edges(const Vec3<Lanes>& x) {
  return {{axis_sign(0) * (across<0>(x) - x), axis_sign(1) * (across<1>(x) - x),
           axis_sign(2) * (across<2>(x) - x)}};
}

/// Signed inverse target lengths: they turn "across minus here" into a column of the Jacobian.
struct Scale {
  Lanes axis[3];
};

HEXWEFT_INLINE Scale make_scale(const TargetCuboid& t) {
  return {{axis_sign(0) * (1.0 / t.lengths[0]), axis_sign(1) * (1.0 / t.lengths[1]),
           axis_sign(2) * (1.0 / t.lengths[2])}};
}

HEXWEFT_INLINE Deformation<Lanes> corner_deformations(const Vec3<Lanes>& x, const Scale& s) {
  Mat3<Lanes> j;
  j.col[0] = s.axis[0] * (across<0>(x) - x);
  j.col[1] = s.axis[1] * (across<1>(x) - x);
  j.col[2] = s.axis[2] * (across<2>(x) - x);
  return make_deformation(j);
}

HEXWEFT_INLINE Vec3<double> lane(const Vec3<Lanes>& v, int i) { return {v.x[i], v.y[i], v.z[i]}; }
HEXWEFT_INLINE Deformation<double> lane(const Deformation<Lanes>& d, int i) {
  const auto matrix = [i](const Mat3<Lanes>& m) {
    return Mat3<double>{{lane(m.col[0], i), lane(m.col[1], i), lane(m.col[2], i)}};
  };
  return {matrix(d.jacobian), matrix(d.cofactor), d.det[i]};
}

template <class E>
concept OnLanes = requires(const E& e, const Deformation<Lanes>& d, Mat3<Lanes>& s) {
  e.value_and_stress(d, s);
};
template <class E>
concept CurvatureOnLanes = requires(const E& e, const Deformation<Lanes>& d) {
  e.curvature(d);
};

/// All corners at once, or one after the other where an energy knows single numbers only.
template <class E>
HEXWEFT_INLINE Lanes value_and_stress(const E& e, const Deformation<Lanes>& d,
                                      Mat3<Lanes>& stress) {
  if constexpr (OnLanes<E>) {
    return e.value_and_stress(d, stress);
  } else {
    Lanes value{};
    for (int i = 0; i < 8; ++i) {
      Mat3<double> s;
      value[i] = e.value_and_stress(lane(d, i), s);
      for (int k = 0; k < 3; ++k) {
        stress.col[k].x[i] = s.col[k].x;
        stress.col[k].y[i] = s.col[k].y;
        stress.col[k].z[i] = s.col[k].z;
      }
    }
    return value;
  }
}

template <class E>
HEXWEFT_INLINE Curvature<Lanes> curvature(const E& e, const Deformation<Lanes>& d) {
  if constexpr (CurvatureOnLanes<E>) {
    return e.curvature(d);
  } else {
    Curvature<Lanes> k{};
    for (int i = 0; i < 8; ++i) {
      const Curvature<double> one = e.curvature(lane(d, i));
      k.identity[i] = one.identity;
      k.normal[i] = one.normal;
      k.cofactor[i] = one.cofactor;
    }
    return k;
  }
}

/// w times the curvature model along u gᵀ, with b = cof g, as a packed symmetric 3 × 3 block.
HEXWEFT_INLINE void pack_curvature(const Curvature<Lanes>& k, const Mat3<Lanes>& cof,
                                   const Lanes& g2, const Vec3<Lanes>& b, const Lanes& w,
                                   Lanes (&out)[6]) {
  const Lanes diagonal = w * k.identity * g2, outer = w * k.normal;
  const Lanes full = w * k.cofactor * dot(b, b);
  const Vec3<Lanes> c[3] = {cof.col[0], cof.col[1], cof.col[2]};
  out[0] =
      diagonal + outer * b.x * b.x + full * (c[0].x * c[0].x + c[1].x * c[1].x + c[2].x * c[2].x);
  out[1] = outer * b.x * b.y + full * (c[0].x * c[0].y + c[1].x * c[1].y + c[2].x * c[2].y);
  out[2] = outer * b.x * b.z + full * (c[0].x * c[0].z + c[1].x * c[1].z + c[2].x * c[2].z);
  out[3] =
      diagonal + outer * b.y * b.y + full * (c[0].y * c[0].y + c[1].y * c[1].y + c[2].y * c[2].y);
  out[4] = outer * b.y * b.z + full * (c[0].y * c[0].z + c[1].y * c[1].z + c[2].y * c[2].z);
  out[5] =
      diagonal + outer * b.z * b.z + full * (c[0].z * c[0].z + c[1].z * c[1].z + c[2].z * c[2].z);
}

/// Σ weight · mean over corners; adds to the gradient (3 × #points) if there is one.
struct BatchEnergy {
  template <class E>
  HEXWEFT_INLINE static double run(const E& energy, const HexBatch& b, double* gradient) {
    const bool positive_only = E::barrier || b.stay_valid;
    Lanes total{};
    for (std::size_t i = 0; i < b.hexes.size(); ++i) {
      const HexCorners& h = b.hexes[i];
      const Scale s = make_scale(b.targets[i]);
      const Deformation<Lanes> d = corner_deformations(gather(b.points, h), s);
      if (positive_only && !(lane_min(d.det) > 0)) return std::numeric_limits<double>::infinity();
      Mat3<Lanes> stress;
      const Lanes weight = broadcast<Lanes>(b.targets[i].weight / 8);
      total += weight * value_and_stress(energy, d, stress);
      if (!gradient) continue;
      const Vec3<Lanes> t0 = (weight * s.axis[0]) * stress.col[0];
      const Vec3<Lanes> t1 = (weight * s.axis[1]) * stress.col[1];
      const Vec3<Lanes> t2 = (weight * s.axis[2]) * stress.col[2];
      const Vec3<Lanes> g = (across<0>(t0) - t0) + (across<1>(t1) - t1) + (across<2>(t2) - t2);
      for (int c = 0; c < 8; ++c) {
        double* to = gradient + 3 * static_cast<std::ptrdiff_t>(h[c]);
        to[0] += g.x[c];
        to[1] += g.y[c];
        to[2] += g.z[c];
      }
    }
    return lane_sum(total);
  }
};

/// Adds each vertex's block of the curvature model (6 × #points).
struct AddCurvature {
  template <class E>
  HEXWEFT_INLINE static void run(const E& energy, const HexBatch& batch, double* blocks) {
    Lanes packed[6];
    for (std::size_t i = 0; i < batch.hexes.size(); ++i) {
      const HexCorners& h = batch.hexes[i];
      const Scale s = make_scale(batch.targets[i]);
      const Deformation<Lanes> d = corner_deformations(gather(batch.points, h), s);
      const Curvature<Lanes> k = curvature(energy, d);
      const Lanes w = broadcast<Lanes>(batch.targets[i].weight / 8);
      Vec3<Lanes> own{};  // cof g of the corner itself, which moves all three columns the other way
      Lanes own_g2{};
      for (int a = 0; a < 3; ++a) {
        const Vec3<Lanes> b = s.axis[a] * d.cofactor.col[a];
        const Lanes g2 = s.axis[a] * s.axis[a];
        own = own - b;
        own_g2 += g2;
        pack_curvature(k, d.cofactor, g2, b, w, packed);
        for (int c = 0; c < 8; ++c) {
          double* to = blocks + 6 * static_cast<std::ptrdiff_t>(h[kCornerAcross[c][a]]);
          for (int e = 0; e < 6; ++e) to[e] += packed[e][c];
        }
      }
      pack_curvature(k, d.cofactor, own_g2, own, w, packed);
      for (int c = 0; c < 8; ++c) {
        double* to = blocks + 6 * static_cast<std::ptrdiff_t>(h[c]);
        for (int e = 0; e < 6; ++e) to[e] += packed[e][c];
      }
    }
  }
};

/// The energy by mesh edges. An edge vector is a column of the Jacobian at both its ends, so the
/// curvature model along dJ = u e_kᵀ, summed over the corners at the edge, is a metric of the edge.
/// Adds to each edge's 9 numbers: ∂ energy / ∂ (edge vector, along its axis), then the metric,
/// packed. \return the energy
struct EdgeTerms {
  template <class E>
  HEXWEFT_INLINE static double run(const E& energy, const HexBatch& batch,
                                   std::span<const HexEdges> edges, double* terms) {
    const bool positive_only = E::barrier || batch.stay_valid;
    Lanes total{};
    for (std::size_t i = 0; i < batch.hexes.size(); ++i) {
      const Scale s = make_scale(batch.targets[i]);
      const Deformation<Lanes> d = corner_deformations(gather(batch.points, batch.hexes[i]), s);
      if (positive_only && !(lane_min(d.det) > 0)) return std::numeric_limits<double>::infinity();
      const Lanes w = broadcast<Lanes>(batch.targets[i].weight / 8);
      Mat3<Lanes> stress;
      total += w * value_and_stress(energy, d, stress);
      const Curvature<Lanes> k = curvature(energy, d);
      add_axis<0>(k, d, stress, s, w, edges[i], terms);
      add_axis<1>(k, d, stress, s, w, edges[i], terms);
      add_axis<2>(k, d, stress, s, w, edges[i], terms);
    }
    return lane_sum(total);
  }

 private:
  template <int A>
  HEXWEFT_INLINE static void add_axis(const Curvature<Lanes>& k, const Deformation<Lanes>& d,
                                      const Mat3<Lanes>& stress, const Scale& s, const Lanes& w,
                                      const HexEdges& edges, double* terms) {
    const Lanes inverse_length = s.axis[A] * axis_sign(A);
    Lanes packed[6];
    pack_curvature(k, d.cofactor, inverse_length * inverse_length,
                   inverse_length * d.cofactor.col[A], w, packed);
    for (Lanes& p : packed) p += across<A>(p);
    Vec3<Lanes> g = (w * inverse_length) * stress.col[A];
    g = g + across<A>(g);
    for (int e = 0; e < 4; ++e) {
      const int c = kEdgeCorners[4 * A + e][0], id = edges[4 * A + e];
      const double sign = id < 0 ? -1 : 1;
      double* to = terms + 9 * static_cast<std::ptrdiff_t>(id < 0 ? ~id : id);
      to[0] += sign * g.x[c];
      to[1] += sign * g.y[c];
      to[2] += sign * g.z[c];
      for (int m = 0; m < 6; ++m) to[3 + m] += packed[m][c];
    }
  }
};

template <class Kernel, class... Args>
auto run_portable(const Args&... args) {
  return Kernel::run(args...);
}
#if defined(__x86_64__)
template <class Kernel, class... Args>
__attribute__((target("avx2,fma"), flatten)) auto run_avx2(const Args&... args) {
  return Kernel::run(args...);
}
template <class Kernel, class... Args>
__attribute__((target("avx512f,avx512dq,avx512vl,fma"), flatten)) auto run_avx512(
    const Args&... args) {
  return Kernel::run(args...);
}
#endif

/// Runs a kernel compiled for the instruction set, which is one that this machine has.
template <class Kernel, class... Args>
auto run(InstructionSet set, const Args&... args) {
#if defined(__x86_64__)
  if (set == InstructionSet::avx512) return run_avx512<Kernel>(args...);
  if (set == InstructionSet::avx2) return run_avx2<Kernel>(args...);
#endif
  return run_portable<Kernel>(args...);
}

}  // namespace hexweft::kernels
