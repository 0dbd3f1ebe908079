/// \file
/// The feature lines of a surface as curves: closest points, arc length, tangents.
#pragma once

#include <array>
#include <limits>
#include <unsupported/Eigen/BVH>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "optimize/features.h"

namespace hexweft {

/// A point of a feature line.
struct CurvePoint {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d tangent = Eigen::Vector3d::UnitX();         ///< length 1, in the line's direction
  double distance = std::numeric_limits<double>::infinity();  ///< model units, from the query
  double at = 0;  ///< arc length from the line's first point, model units
  int line = -1;  ///< of equally close ones the lowest; -1 if there is none
  /// Mean of the normals of the surface's triangles at the line there; zero where there are none.
  Eigen::Vector3d facing = Eigen::Vector3d::Zero();
};

/// Stretches of a few segments have a box each, lines have one, and the stretches of all lines are in
/// a tree: queries pass over what is too far. Const calls may run at the same time on several threads.
class FeatureCurves {
 public:
  /// \param points     3 × #points, model units
  /// \param triangles  those that the features were found in
  FeatureCurves(const Eigen::Matrix3Xd& points, const std::vector<std::array<int, 3>>& triangles,
                SurfaceFeatures features);

  const SurfaceFeatures& features() const { return features_; }
  int n_lines() const { return static_cast<int>(features_.lines.size()); }
  bool closed(int line) const { return features_.lines[line].closed; }
  double length(int line) const { return curves_[line].arc.back(); }  ///< model units
  const Eigen::Vector3d& corner(int i) const { return corners_[i]; }
  /// Corners at the first and the last point of an open line; -1 for a closed one.
  const std::array<int, 2>& ends(int line) const { return curves_[line].ends; }

  CurvePoint closest(const Eigen::Vector3d& p, int line) const;
  /// Of the lines within reach (model units).
  CurvePoint closest_within(const Eigen::Vector3d& p, double reach) const;
  /// The closest point of each line within reach (model units), lines ascending.
  std::vector<CurvePoint> within(const Eigen::Vector3d& p, double reach) const;
  CurvePoint at(int line, double arc) const;  ///< \param arc  in [0, length(line)]

 private:
  struct Curve {
    std::vector<Eigen::Vector3d> points;     // #segments + 1; of a closed line the first again
    std::vector<double> arc;                 // at each of them
    std::vector<Eigen::Vector3d> facing;     // of each segment
    std::vector<Eigen::AlignedBox3d> boxes;  // of a few segments each
    Eigen::AlignedBox3d box;
    std::array<int, 2> ends = {-1, -1};
  };
  /// Those of which a box is within reach, ascending.
  std::vector<int> lines_near(const Eigen::Vector3d& p, double reach) const;
  void look_at(int line, const Eigen::Vector3d& p, CurvePoint& best) const;

  SurfaceFeatures features_;
  std::vector<Curve> curves_;
  Eigen::KdBVH<double, 3, int> stretches_;  // the line of each
  std::vector<Eigen::Vector3d> corners_;
};

}  // namespace hexweft
