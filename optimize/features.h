/// \file
/// Sharp features of a triangulated surface: lines along which it is bent, corners where lines
/// meet, end or turn.
///
///     const SurfaceFeatures features = find_features(points, triangles);
///     for (const FeatureLine& line : features.lines) ...
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

namespace hexweft {

enum class FeatureMode {
  automatic,  ///< an angle that the noise of voxel-based meshers on smooth parts stays under
  off,        ///< none
  angle       ///< from a given angle on
};

struct FeatureOptions {
  FeatureMode mode = FeatureMode::automatic;
  double angle_deg = 40;  ///< (0, 180], between the normals at an edge; for FeatureMode::angle
};
void validate(const FeatureOptions& options);  ///< \throws InputError

/// A chain of edges of the surface.
struct FeatureLine {
  std::vector<int> points;  ///< in order; the first one is not repeated where the line is closed
  bool closed = false;      ///< else it ends at two corners, which may be the same
  int n_segments() const { return static_cast<int>(points.size()) - (closed ? 0 : 1); }
  /// Ends of segment i, as points of the surface.
  std::array<int, 2> segment(int i) const {
    return {points[i], points[(i + 1) % static_cast<int>(points.size())]};
  }
};

struct SurfaceFeatures {
  std::vector<FeatureLine> lines;
  std::vector<int> corners;  ///< points of the surface, ascending
};

/// Edges bent by more than the angle, and borders, as lines. Gaps of a few edges where the line
/// plainly goes on are closed; stubs and connected sets of a few edges are dropped, and with
/// FeatureMode::automatic what is not sharp on average along the line.
/// \param points     3 × #points, model units
/// \param triangles  as of ReferenceSurface
/// Independent of the unit of length.
SurfaceFeatures find_features(const Eigen::Matrix3Xd& points,
                              const std::vector<std::array<int, 3>>& triangles,
                              const FeatureOptions& options = {});

}  // namespace hexweft
