/// \file
/// Boxes along the axes, which tell cheaply that something is too far to matter.
#pragma once

#include <span>

#include <Eigen/Core>

namespace hexweft {

/// All points between two corners.
struct Box3 {
  Eigen::Vector3d lower, upper;

  /// 0 inside. Never more than the squared distance of a point in the box.
  double squared_distance(const Eigen::Vector3d& p) const {
    return (lower - p).cwiseMax(p - upper).cwiseMax(0).squaredNorm();
  }
};

/// \param points  at least one
inline Box3 box_of(std::span<const Eigen::Vector3d> points) {
  Box3 box{points[0], points[0]};
  for (const Eigen::Vector3d& p : points) {
    box.lower = box.lower.cwiseMin(p);
    box.upper = box.upper.cwiseMax(p);
  }
  return box;
}

}  // namespace hexweft
