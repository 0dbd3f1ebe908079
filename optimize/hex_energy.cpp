#include "optimize/hex_energy.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "optimize/energies/kernels.h"
#include "ovm/errors.h"
#include "ovm/hex_numbering.h"

namespace hexweft {
namespace {

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

/// Scaled determinant of three edges: -1 where one has no length.
template <class T>
HEXWEFT_INLINE T scaled(const Mat3<T>& m) {
  const T lengths2 = dot(m.col[0], m.col[0]) * dot(m.col[1], m.col[1]) * dot(m.col[2], m.col[2]);
  const T det = dot(m.col[0], cross(m.col[1], m.col[2]));
  return lengths2 > 0.0 ? det / square_root(lengths2) : broadcast<T>(-1);
}

/// The sum of the eight lanes, in every lane.
HEXWEFT_INLINE Lanes sum_to_all(Lanes v) {
  v += kernels::across<0>(v);
  v += kernels::across<1>(v);
  return v + kernels::across<2>(v);
}

/// Four times the edges of the parallelepiped in the middle of the hexahedron.
HEXWEFT_INLINE Mat3<double> middle_edges(const Mat3<Lanes>& corners) {
  Mat3<double> m;
  for (int k = 0; k < 3; ++k) {
    const Vec3<Lanes>& c = corners.col[k];
    m.col[k] = {sum_to_all(c.x)[0], sum_to_all(c.y)[0], sum_to_all(c.z)[0]};
  }
  return m;
}

struct LeastDeterminants {
  HEXWEFT_INLINE static void run(const double* points, const std::span<const HexCorners>& hexes,
                                 const std::span<const TargetCuboid>& targets, double* least) {
    for (std::size_t i = 0; i < hexes.size(); ++i) {
      const Vec3<Lanes> x = kernels::gather(points, hexes[i]);
      least[i] = lane_min(kernels::corner_deformations(x, kernels::make_scale(targets[i])).det);
    }
  }
};

struct ScaledJacobians {
  HEXWEFT_INLINE static void run(const double* points, const std::span<const HexCorners>& hexes,
                                 double* least) {
    for (std::size_t i = 0; i < hexes.size(); ++i) {
      const Mat3<Lanes> edges = kernels::corner_edges(kernels::gather(points, hexes[i]));
      const double corners = lane_min(scaled(edges)), middle = scaled(middle_edges(edges));
      const double worst = corners < middle ? corners : middle;
      least[i] = worst < 1 ? worst : 1;
    }
  }
};

struct ShapeMetrics {
  HEXWEFT_INLINE static void run(const double* points, const std::span<const HexCorners>& hexes,
                                 double* shape) {
    for (std::size_t i = 0; i < hexes.size(); ++i) {
      const Mat3<Lanes> edges = kernels::corner_edges(kernels::gather(points, hexes[i]));
      const Lanes det = dot(edges.col[0], cross(edges.col[1], edges.col[2]));
      const Lanes root = inverse_cube_root(det > 0.0 ? det : broadcast<Lanes>(1));
      const double sum = lane_sum(squared_norm(edges) * root * root);
      shape[i] = lane_min(det) > 0 ? 24 / sum : 0;
    }
  }
};

/// Runs a kernel of points, hexahedra and a result for each of them.
template <class Kernel>
std::vector<double> measure_cells(const HexMesh& mesh, std::span<const CellHandle> cells) {
  constexpr std::size_t kAtOnce = 64;  // their points stay in the first cache
  Eigen::Matrix<double, 3, 8 * kAtOnce> points;
  std::array<HexCorners, kAtOnce> hexes;
  for (std::size_t i = 0; i < kAtOnce; ++i)
    std::iota(hexes[i].begin(), hexes[i].end(), static_cast<int>(8 * i));
  const InstructionSet set = available(InstructionSet::automatic);
  std::vector<double> result(cells.size());
  for (std::size_t begin = 0; begin < cells.size(); begin += kAtOnce) {
    const std::size_t n = std::min(kAtOnce, cells.size() - begin);
    Eigen::Index to = 0;
    for (CellHandle c : cells.subspan(begin, n)) {
      for (VertexHandle v : mesh.vertices(c)) points.col(to++) = mesh.point(v);
    }
    kernels::run<Kernel>(set, points.data(), std::span<const HexCorners>(hexes.data(), n),
                         result.data() + begin);
  }
  return result;
}

}  // namespace

InstructionSet available(InstructionSet wanted) {
  static const InstructionSet best = best_instruction_set();
  if (wanted == InstructionSet::automatic) return best;
  if (wanted > best) throw InputError("this machine lacks the instruction set asked for");
  return wanted;
}

double hex_energy(const Energy& energy, const Eigen::Matrix3Xd& points,
                  std::span<const HexCorners> hexes, std::span<const TargetCuboid> targets,
                  Eigen::Matrix3Xd* gradient, InstructionSet set, bool stay_valid) {
  return energy.model().batch_energy({points.data(), hexes, targets, stay_valid},
                                     gradient ? gradient->data() : nullptr, available(set));
}

void add_hex_curvature(const Energy& energy, const Eigen::Matrix3Xd& points,
                       std::span<const HexCorners> hexes, std::span<const TargetCuboid> targets,
                       Eigen::Matrix<double, 6, Eigen::Dynamic>& blocks) {
  energy.model().add_curvature({points.data(), hexes, targets}, blocks.data(),
                               available(InstructionSet::automatic));
}

double hex_edge_terms(const Energy& energy, const Eigen::Matrix3Xd& points,
                      std::span<const HexCorners> hexes, std::span<const TargetCuboid> targets,
                      std::span<const HexEdges> edges, EdgeTerms& terms, InstructionSet set,
                      bool stay_valid) {
  return energy.model().edge_terms({points.data(), hexes, targets, stay_valid}, edges, terms.data(),
                                   available(set));
}

std::vector<double> min_relative_determinants(const Eigen::Matrix3Xd& points,
                                              std::span<const HexCorners> hexes,
                                              std::span<const TargetCuboid> targets) {
  std::vector<double> least(hexes.size());
  kernels::run<LeastDeterminants>(available(InstructionSet::automatic), points.data(), hexes,
                                  targets, least.data());
  return least;
}

std::vector<double> scaled_jacobians(const Eigen::Matrix3Xd& points,
                                     std::span<const HexCorners> hexes) {
  std::vector<double> least(hexes.size());
  kernels::run<ScaledJacobians>(available(InstructionSet::automatic), points.data(), hexes,
                                least.data());
  return least;
}

std::vector<double> scaled_jacobians(const HexMesh& mesh, std::span<const CellHandle> cells) {
  return measure_cells<ScaledJacobians>(mesh, cells);
}

Quality quality_of(std::span<const double> scaled_jacobians) {
  if (scaled_jacobians.empty()) return {};
  const auto n = static_cast<double>(scaled_jacobians.size());
  Quality q{1, 0};
  for (const double sj : scaled_jacobians) {
    q.least = std::min(q.least, sj);
    q.mean += sj / n;
  }
  return q;
}

Quality measure_quality(const HexMesh& mesh, std::span<const CellHandle> cells) {
  return quality_of(scaled_jacobians(mesh, cells));
}

std::vector<double> shape_metrics(const HexMesh& mesh, std::span<const CellHandle> cells) {
  return measure_cells<ShapeMetrics>(mesh, cells);
}

}  // namespace hexweft
