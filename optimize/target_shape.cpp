#include "optimize/target_shape.h"

#include <algorithm>
#include <cmath>

#include "optimize/energies/kernels.h"

namespace hexweft {
namespace {

/// Mean length of each set of four parallel edges, and the volume as the mean of the corner
/// determinants, which is enough to scale a target. Each edge is met at both its ends.
struct LengthsAndVolumes {
  HEXWEFT_INLINE static void run(const double* points, const std::span<const HexCorners>& hexes,
                                 TargetCuboid* targets, double* volumes) {
    for (std::size_t h = 0; h < hexes.size(); ++h) {
      const Mat3<Lanes> edges = kernels::corner_edges(kernels::gather(points, hexes[h]));
      for (int a = 0; a < 3; ++a) {
        targets[h].lengths[a] = lane_sum(square_root(dot(edges.col[a], edges.col[a]))) / kCorners;
      }
      volumes[h] = lane_sum(dot(edges.col[0], cross(edges.col[1], edges.col[2]))) / kCorners;
    }
  }
};

void blend_along_axes(const Region& region, double blend, std::vector<TargetCuboid>& targets) {
  const std::vector<TargetCuboid> before = targets;
  for (std::size_t h = 0; h < targets.size(); ++h) {
    for (int a = 0; a < 3; ++a) {
      double sum = before[h].lengths[a];
      int n = 1;
      for (int side : {2 * a, 2 * a + 1}) {
        const int other = region.neighbor_side[6 * h + side];
        if (other < 0) continue;
        sum += before[other / 6].lengths[side_axis(other % 6)];
        ++n;
      }
      targets[h].lengths[a] += blend * (sum / n - before[h].lengths[a]);
    }
  }
}

}  // namespace

std::vector<TargetCuboid> target_cuboids(const Region& region, const TargetShapeOptions& options) {
  std::vector<TargetCuboid> targets(region.hexes.size());
  std::vector<double> volumes(targets.size());
  kernels::run<LengthsAndVolumes>(available(InstructionSet::automatic), region.points.data(),
                                  std::span<const HexCorners>(region.hexes), targets.data(),
                                  volumes.data());
  double mean = 0;
  for (const TargetCuboid& t : targets) mean += t.lengths.mean();
  mean /= static_cast<double>(std::max<std::size_t>(1, targets.size()));
  const double least = options.least_length_rel * mean + 1e-300;
  for (std::size_t h = 0; h < targets.size(); ++h) {
    Eigen::Vector3d& lengths = targets[h].lengths;
    lengths = lengths.cwiseMax(least);
    const double fill = volumes[h] / lengths.prod();
    lengths *=
        std::cbrt(std::clamp(fill, 0.2, 1.0));  // a collapsed volume says nothing about the target
  }
  for (int i = 0; i < options.blend_passes; ++i)
    blend_along_axes(region, options.size_blend, targets);
  return targets;
}

}  // namespace hexweft
