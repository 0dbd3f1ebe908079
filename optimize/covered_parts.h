/// \file
/// What FarthestSample asks of surfaces of triangles.
#pragma once

#include "optimize/closest_point.h"
#include "optimize/farthest_sample.h"
#include "optimize/quad_grid.h"
#include "optimize/reference_surface.h"

namespace hexweft {

/// Distances to a surface; its triangles are the pieces. Begins where the last point was found.
class DistanceTo {
 public:
  /// \param surface  must outlive this
  explicit DistanceTo(const ReferenceSurface& surface) : surface_(&surface) {}
  FoundDistance operator()(const Eigen::Vector3d& p, double enough) {
    const double d = surface_->distance(p, near_, enough);
    return {d, near_};
  }

 private:
  const ReferenceSurface* surface_;
  int near_ = -1;
};

/// Whether the three samples are within d of the triangle p, q, r.
inline bool is_covered(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& r,
                       const Sample& a, const Sample& b, const Sample& c, double d) {
  const auto is_near = [&](const Sample& s) {
    return (closest_point(s.point, p, q, r).point - s.point).squaredNorm() <= d * d;
  };
  return is_near(a) && is_near(b) && is_near(c);
}

/// A Covers of FarthestSample, with triangles of a surface as pieces.
struct CoveredByTriangle {
  const ReferenceSurface& surface;  ///< must outlive this
  bool operator()(int triangle, const Sample& a, const Sample& b, const Sample& c, double d) const {
    const auto& p = surface.points();
    const auto& [i, j, k] = surface.triangles()[triangle];
    return is_covered(p.col(i), p.col(j), p.col(k), a, b, c, d);
  }
};

/// The same with quads of a grid.
struct CoveredByQuad {
  const QuadGrid& grid;  ///< must outlive this
  bool operator()(int id, const Sample& a, const Sample& b, const Sample& c, double d) const {
    const QuadPoints& q = grid.points(id);
    return is_covered(q[0], q[1], q[2], a, b, c, d) || is_covered(q[2], q[3], q[0], a, b, c, d);
  }
};

}  // namespace hexweft
