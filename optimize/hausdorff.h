/// \file
/// The point-sampled Hausdorff distance of two surfaces.
///
///     const auto d = hausdorff_distance(mesh, surface);
///     if (d.ratio() > 0.01) ...
#pragma once

#include <limits>
#include <optional>

#include "optimize/reference_surface.h"

namespace hexweft {

class HexMesh;

/// Which points of a triangle are looked at: its corners, and those of its regular subdivision into
/// as many parts as it takes to have the number below, with their centroids. Large triangles are
/// divided further where the farthest point can be: a distance is not missed because a surface is
/// coarse.
struct HausdorffOptions {
  int points_per_triangle = 10;  ///< > 0, at least so many on every triangle
  int points_per_surface =
      0;  ///< ≥ 0, spread by area; 0: points_per_triangle × the larger triangle count
  /// > 0, model units: what the distance is to be held against. It is told to a twentieth of that, as
  /// far as it is over half of it: parts of a surface are divided as closeness_for() the limit says
  /// (farthest_sample.h). Unset: a hundredth of the diagonal of the second surface's bounding box
  std::optional<double> limit = {};
  bool parallel = false;  ///< the two directions on a thread each; the result is the same
  double at_least =
      0;  ///< ≥ 0, model units: below it distances are not told apart, which saves time
  double enough =
      std::numeric_limits<double>::infinity();  ///< model units: beyond it the search ends
};

/// Distances in model units.
struct HausdorffDistance {
  double forward = 0;   ///< largest distance of a sample of the first surface to the second
  double backward = 0;  ///< largest distance of a sample of the second surface to the first
  double diagonal = 1;  ///< of the second surface's bounding box
  Eigen::Vector3d forward_at = Eigen::Vector3d::Zero();   ///< such a sample of the first surface
  Eigen::Vector3d backward_at = Eigen::Vector3d::Zero();  ///< such a sample of the second
  double distance() const { return forward > backward ? forward : backward; }
  double ratio() const { return distance() / diagonal; }  ///< the "HR" of the mesh
};

struct FarthestPoint {
  double distance = 0;  ///< model units
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
};
/// The sample of `from` that is farthest from `to`. Samples that cannot be, because a sample near them
/// is close, are passed over; the result is the same.
/// \throws InputError on bad options
FarthestPoint farthest_point(const ReferenceSurface& from, const ReferenceSurface& to,
                             const HausdorffOptions& options = {});

HausdorffDistance hausdorff_distance(const ReferenceSurface& surface,
                                     const ReferenceSurface& reference,
                                     const HausdorffOptions& options = {});
/// The boundary of a mesh against a reference.
HausdorffDistance hausdorff_distance(const HexMesh& mesh, const ReferenceSurface& reference,
                                     const HausdorffOptions& options = {});

/// The ratio of that distance, looked for as closely as is_within() does for a limit.
/// \param limit_rel  > 0, of the diagonal of the reference's bounding box
double hausdorff_ratio(const HexMesh& mesh, const ReferenceSurface& reference, double limit_rel,
                       const HausdorffOptions& options = {});

/// Whether the boundary of a mesh and the reference are within `limit` of each other, in model units,
/// on the samples of hausdorff_distance(); much faster than that where they are.
bool is_within(const HexMesh& mesh, const ReferenceSurface& reference, double limit,
               const HausdorffOptions& options = {});

}  // namespace hexweft
