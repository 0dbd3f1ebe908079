/// \file
/// Where two surfaces are farthest apart, for people to look at.
#pragma once

#include "optimize/hausdorff.h"

namespace hexweft::cli {

/// A sample of one surface and the point of the other closest to it.
struct FarthestPoint {
  double distance = 0;  ///< model units
  Eigen::Vector3d point = Eigen::Vector3d::Zero(), closest = Eigen::Vector3d::Zero();
};

/// A point of `from` as far from `to` as one_sided_distance(from, to) says.
/// \param distance  that distance, model units
FarthestPoint find_farthest_point(const ReferenceSurface& from, const ReferenceSurface& to,
                                  double distance, const HausdorffOptions& options = {});

}  // namespace hexweft::cli
