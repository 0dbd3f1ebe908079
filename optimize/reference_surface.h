/// \file
/// The surface a mesh has to stay on: a triangulation that never changes, with exact closest
/// points.
///
///     const auto surface = make_reference_surface(mesh);   // its boundary, as it is now
///     SurfacePoint s = surface.closest(p);                 // s.point, s.distance, s.normal
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "optimize/feature_curves.h"
#include "optimize/features.h"

namespace hexweft {

class HexMesh;

/// Where a query ended up.
struct SurfacePoint {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal =
      Eigen::Vector3d::UnitZ();  ///< length 1, outward, smooth except at features
  double distance = std::numeric_limits<double>::infinity();  ///< model units
  int triangle = -1;  ///< of equally close ones the lowest; -1 if none within reach
};

/// Degrees; normals are averaged across edges less sharp than this, if nothing else is asked for. It has
/// no say in what is a feature line.
inline constexpr double kNormalAngleDeg = 40;

/// Copies share the data. Const calls may run at the same time on several threads.
class ReferenceSurface {
 public:
  /// \param points         3 × #points
  /// \param triangles      counter-clockwise from outside
  /// \param feature_angle_deg  (0, 180]: normals are not averaged across edges sharper than this
  /// \param features  which lines and corners to look for
  /// \throws InputError  without triangles, on a bad index, a coordinate that is not finite, or a
  ///                     bounding box whose diagonal is outside of [1e-45, 1e45]
  ReferenceSurface(Eigen::Matrix3Xd points, std::vector<std::array<int, 3>> triangles,
                   double feature_angle_deg = kNormalAngleDeg, const FeatureOptions& features = {});

  /// The closest point; every result is computed in double, Embree only prunes.
  /// \param near  a triangle thought to be close, or -1: makes it faster, never changes the result
  SurfacePoint closest(const Eigen::Vector3d& p, int near = -1) const;
  /// Of the triangles that face within 90° of `normal_hint`; of all if there is none.
  SurfacePoint closest(const Eigen::Vector3d& p, const Eigen::Vector3d& normal_hint,
                       int near = -1) const;
  /// Within `reach` (model units) only; triangle = -1 if nothing is.
  SurfacePoint closest_within(const Eigen::Vector3d& p, double reach) const;

  /// The distance of the closest point, or as soon as one is known that is no farther than `enough`
  /// (model units), its distance.
  /// \param near  on entry a triangle thought to be close, or -1; on return that of the point
  double distance(const Eigen::Vector3d& p, int& near, double enough = 0) const;

  const Eigen::Matrix3Xd& points() const;
  const std::vector<std::array<int, 3>>& triangles() const;
  const FeatureCurves& curves() const;  ///< its feature lines and corners
  /// True if an edge sharper than the feature angle touches the triangle, at a corner at least.
  bool at_feature(int triangle) const;
  Eigen::Vector3d triangle_normal(
      int triangle) const;               ///< length 1; zero for a degenerate triangle
  double bounding_box_diagonal() const;  ///< model units

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

/// The boundary of a mesh, each side cut into the triangles (0,1,2) and (2,3,0).
/// \throws InputError if the mesh has no cells
ReferenceSurface make_reference_surface(const HexMesh& mesh,
                                        double feature_angle_deg = kNormalAngleDeg,
                                        const FeatureOptions& features = {});

}  // namespace hexweft
