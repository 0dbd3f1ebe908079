#include "optimize/target_shape.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace hexweft {
namespace {

/// Mean length of each set of four parallel edges.
Eigen::Vector3d mean_lengths(const Eigen::Matrix3Xd& points, const HexCorners& hex) {
  Eigen::Vector3d lengths = Eigen::Vector3d::Zero();
  for (int e = 0; e < kHexEdges; ++e) {
    const auto& [a, b] = kEdgeCorners[e];
    lengths[edge_axis(e)] += (points.col(hex[a]) - points.col(hex[b])).norm() / 4;
  }
  return lengths;
}

/// Volume as the mean of the corner determinants, which is enough to scale a target.
double corner_volume(const Eigen::Matrix3Xd& points, const HexCorners& hex) {
  double volume = 0;
  for (int c = 0; c < kCorners; ++c) {
    Eigen::Matrix3d edges;
    for (int k = 0; k < 3; ++k) {
      edges.col(k) = points.col(hex[kCornerNeighbors[c][k]]) - points.col(hex[c]);
    }
    volume += edges.determinant() / kCorners;
  }
  return volume;
}

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
  double mean = 0;
  for (std::size_t h = 0; h < targets.size(); ++h) {
    targets[h].lengths = mean_lengths(region.points, region.hexes[h]);
    mean += targets[h].lengths.mean() / static_cast<double>(targets.size());
  }
  const double least = options.least_length_rel * mean + 1e-300;
  for (std::size_t h = 0; h < targets.size(); ++h) {
    Eigen::Vector3d& lengths = targets[h].lengths;
    lengths = lengths.cwiseMax(least);
    const double fill = corner_volume(region.points, region.hexes[h]) / lengths.prod();
    lengths *=
        std::cbrt(std::clamp(fill, 0.2, 1.0));  // a collapsed volume says nothing about the target
  }
  for (int i = 0; i < options.blend_passes; ++i)
    blend_along_axes(region, options.size_blend, targets);
  return targets;
}

}  // namespace hexweft
