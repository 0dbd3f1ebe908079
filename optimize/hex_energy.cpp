#include "optimize/hex_energy.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "optimize/lanes.h"
#include "ovm/hex_numbering.h"

namespace hexweft {
namespace {

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

/// One call's data, so that the three instruction sets share a signature.
struct Batch {
  const double* points;
  std::span<const HexCorners> hexes;
  std::span<const TargetCuboid> targets;
  double* gradient;
};

template <class E>
HEXWEFT_INLINE double energy_of_batch(const E& energy, const Batch& b) {
  Lanes total{};
  for (std::size_t i = 0; i < b.hexes.size(); ++i) {
    const HexCorners& h = b.hexes[i];
    const Scale s = make_scale(b.targets[i]);
    const Deformation<Lanes> d = corner_deformations(gather(b.points, h), s);
    if (E::barrier && !(lane_min(d.det) > 0)) return std::numeric_limits<double>::infinity();
    Mat3<Lanes> stress;
    const Lanes weight = broadcast<Lanes>(b.targets[i].weight / 8);
    total += weight * energy.value_and_stress(d, stress);
    if (!b.gradient) continue;
    const Vec3<Lanes> t0 = (weight * s.axis[0]) * stress.col[0];
    const Vec3<Lanes> t1 = (weight * s.axis[1]) * stress.col[1];
    const Vec3<Lanes> t2 = (weight * s.axis[2]) * stress.col[2];
    const Vec3<Lanes> g = (across<0>(t0) - t0) + (across<1>(t1) - t1) + (across<2>(t2) - t2);
    for (int c = 0; c < 8; ++c) {
      double* to = b.gradient + 3 * static_cast<std::ptrdiff_t>(h[c]);
      to[0] += g.x[c];
      to[1] += g.y[c];
      to[2] += g.z[c];
    }
  }
  return lane_sum(total);
}

template <class E>
double energy_portable(const E& energy, const Batch& b) {
  return energy_of_batch(energy, b);
}
#if defined(__x86_64__)
template <class E>
__attribute__((target("avx2,fma"))) double energy_avx2(const E& energy, const Batch& b) {
  return energy_of_batch(energy, b);
}
template <class E>
__attribute__((target("avx512f,avx512dq,avx512vl,fma"))) double energy_avx512(const E& energy,
                                                                              const Batch& b) {
  return energy_of_batch(energy, b);
}
#endif

InstructionSet best_instruction_set() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl")) {
    return InstructionSet::avx512;
  }
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return InstructionSet::avx2;
#endif
  return InstructionSet::portable;
}

InstructionSet checked(InstructionSet wanted) {
  static const InstructionSet best = best_instruction_set();
  if (wanted == InstructionSet::automatic) return best;
  if (wanted > best) throw InputError("this machine lacks the instruction set asked for");
  return wanted;
}

/// Adds w times the curvature model along u gᵀ, with b = cof g, to a packed symmetric 3 × 3 block.
HEXWEFT_INLINE void pack_curvature(const Curvature<Lanes>& k, const Mat3<Lanes>& cof,
                                   const Lanes& g2, const Vec3<Lanes>& b, const Lanes& w,
                                   Lanes (&out)[6]) {
  const Lanes diagonal = w * k.identity * g2, outer = w * k.normal;
  const Lanes full = w * k.cofactor * dot(b, b);
  const Vec3<Lanes>* c = cof.col;
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

template <class E>
void add_curvature(const E& energy, const Batch& batch, double* blocks) {
  Lanes packed[6];
  for (std::size_t i = 0; i < batch.hexes.size(); ++i) {
    const HexCorners& h = batch.hexes[i];
    const Scale s = make_scale(batch.targets[i]);
    const Deformation<Lanes> d = corner_deformations(gather(batch.points, h), s);
    const Curvature<Lanes> k = energy.curvature(d);
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

double scaled(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const double lengths = a.norm() * b.norm() * c.norm();
  return lengths > 0 ? a.dot(b.cross(c)) / lengths : -1;
}

}  // namespace

double hex_energy(const Energy& energy, const Eigen::Matrix3Xd& points,
                  std::span<const HexCorners> hexes, std::span<const TargetCuboid> targets,
                  Eigen::Matrix3Xd* gradient, InstructionSet set) {
  const Batch batch{points.data(), hexes, targets, gradient ? gradient->data() : nullptr};
  const InstructionSet use = checked(set);
  return std::visit(
      [&](const auto& e) {
#if defined(__x86_64__)
        if (use == InstructionSet::avx512) return energy_avx512(e, batch);
        if (use == InstructionSet::avx2) return energy_avx2(e, batch);
#endif
        return energy_portable(e, batch);
      },
      energy);
}

void add_hex_curvature(const Energy& energy, const Eigen::Matrix3Xd& points,
                       std::span<const HexCorners> hexes, std::span<const TargetCuboid> targets,
                       Eigen::Matrix<double, 6, Eigen::Dynamic>& blocks) {
  const Batch batch{points.data(), hexes, targets, nullptr};
  std::visit([&](const auto& e) { add_curvature(e, batch, blocks.data()); }, energy);
}

std::vector<double> min_relative_determinants(const Eigen::Matrix3Xd& points,
                                              std::span<const HexCorners> hexes,
                                              std::span<const TargetCuboid> targets) {
  std::vector<double> least(hexes.size());
  for (std::size_t i = 0; i < hexes.size(); ++i) {
    least[i] =
        lane_min(corner_deformations(gather(points.data(), hexes[i]), make_scale(targets[i])).det);
  }
  return least;
}

std::vector<double> scaled_jacobians(const Eigen::Matrix3Xd& points,
                                     std::span<const HexCorners> hexes) {
  std::vector<double> least(hexes.size());
  for (std::size_t i = 0; i < hexes.size(); ++i) {
    double worst = 1;
    Eigen::Vector3d middle[3] = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                                 Eigen::Vector3d::Zero()};
    for (int c = 0; c < 8; ++c) {
      Eigen::Vector3d e[3];
      for (int a = 0; a < 3; ++a) {
        const int sign = kCornerCoords[c][a] ? -1 : 1;
        e[a] = sign * (points.col(hexes[i][kCornerAcross[c][a]]) - points.col(hexes[i][c]));
        middle[a] += e[a];
      }
      worst = std::min(worst, scaled(e[0], e[1], e[2]));
    }
    least[i] = std::min(worst, scaled(middle[0], middle[1], middle[2]));
  }
  return least;
}

}  // namespace hexweft
