#include "optimize/hex_energy.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

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

double scaled(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const double lengths = a.norm() * b.norm() * c.norm();
  return lengths > 0 ? a.dot(b.cross(c)) / lengths : -1;
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
  for (std::size_t i = 0; i < hexes.size(); ++i) {
    least[i] = lane_min(kernels::corner_deformations(kernels::gather(points.data(), hexes[i]),
                                                     kernels::make_scale(targets[i]))
                            .det);
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
