#include "optimize/hausdorff.h"

#include <algorithm>
#include <future>
#include <string>

#include <Eigen/Geometry>

#include "optimize/covered_parts.h"
#include "optimize/farthest_sample.h"
#include "ovm/errors.h"
#include "ovm/hex_mesh.h"

namespace hexweft {
namespace {

void check(const HausdorffOptions& o) {
  if (o.points_per_triangle <= 0) {
    throw InputError("points_per_triangle = " + std::to_string(o.points_per_triangle) +
                     ", expected > 0");
  }
  if (!(o.at_least >= 0)) {
    throw InputError("at_least = " + std::to_string(o.at_least) + ", expected >= 0");
  }
  if (o.limit && !(*o.limit > 0)) {
    throw InputError("limit = " + std::to_string(*o.limit) + ", expected > 0");
  }
  if (o.points_per_surface < 0) {
    throw InputError("points_per_surface = " + std::to_string(o.points_per_surface) +
                     ", expected >= 0");
  }
}

/// Its feature lines have no say in a distance.
ReferenceSurface boundary_of(const HexMesh& mesh) {
  return make_reference_surface(mesh, kNormalAngleDeg, {.mode = FeatureMode::off});
}

/// Subdivisions after which the parts' centroids are at least n.
int levels_for(double n) {
  int levels = 0;
  for (double parts = 1; parts < n && levels < 12; parts *= 4) ++levels;
  return levels;
}

}  // namespace

bool is_within(const HexMesh& mesh, const ReferenceSurface& reference, double limit,
               const HausdorffOptions& options) {
  HausdorffOptions o = options;
  o.at_least = 0.999 * limit;
  o.enough = limit;
  o.limit = limit_to_look_for(limit, reference.bounding_box_diagonal());
  return hausdorff_distance(boundary_of(mesh), reference, o).distance() <= limit;
}

double hausdorff_ratio(const HexMesh& mesh, const ReferenceSurface& reference, double limit_rel,
                       const HausdorffOptions& options) {
  HausdorffOptions o = options;
  const double diagonal = reference.bounding_box_diagonal();
  o.limit = limit_to_look_for(limit_rel * diagonal, diagonal);
  return hausdorff_distance(mesh, reference, o).ratio();
}

FarthestPoint farthest_point(const ReferenceSurface& from, const ReferenceSurface& to,
                             const HausdorffOptions& options) {
  check(options);
  const auto& points = from.points();
  const auto& triangles = from.triangles();
  const auto area_of = [&](const std::array<int, 3>& t) {
    const Eigen::Vector3d ab = points.col(t[1]) - points.col(t[0]);
    const Eigen::Vector3d ac = points.col(t[2]) - points.col(t[0]);
    return ab.cross(ac).norm() / 2;
  };
  double area = 0;
  for (const auto& t : triangles) area += area_of(t);
  const double wanted =
      options.points_per_surface > 0
          ? options.points_per_surface
          : static_cast<double>(options.points_per_triangle) *
                static_cast<double>(std::max(triangles.size(), to.triangles().size()));
  const double diagonal = to.bounding_box_diagonal();
  FarthestSample farthest(DistanceTo(to), options.at_least, options.enough,
                          closeness_for(options.limit.value_or(kUsualLimit * diagonal), diagonal),
                          CoveredByTriangle{to});
  SharedCorners corners(farthest, points);
  for (const auto& t : triangles) {
    if (farthest.done()) break;
    const double share = area > 0 ? wanted * area_of(t) / area : 0;
    farthest.look_at(corners[t[0]], corners[t[1]], corners[t[2]],
                     levels_for(std::max<double>(options.points_per_triangle, share)));
  }
  return {farthest.distance(), farthest.at().value_or(Eigen::Vector3d::Zero())};
}

HausdorffDistance hausdorff_distance(const ReferenceSurface& surface,
                                     const ReferenceSurface& reference,
                                     const HausdorffOptions& options) {
  const auto policy = options.parallel ? std::launch::async : std::launch::deferred;
  auto finding_back =
      std::async(policy, [&] { return farthest_point(reference, surface, options); });
  const FarthestPoint forward = farthest_point(surface, reference, options);
  const FarthestPoint backward = finding_back.get();
  return {forward.distance, backward.distance, reference.bounding_box_diagonal(), forward.point,
          backward.point};
}

HausdorffDistance hausdorff_distance(const HexMesh& mesh, const ReferenceSurface& reference,
                                     const HausdorffOptions& options) {
  return hausdorff_distance(boundary_of(mesh), reference, options);
}

}  // namespace hexweft
