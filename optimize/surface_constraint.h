/// \file
/// Keeps the surface vertices of a region on the reference: tangent planes to slide on, places to
/// go to.
#pragma once

#include <array>
#include <vector>

#include "optimize/feature_assignment.h"
#include "optimize/groups.h"
#include "optimize/reference_surface.h"
#include "optimize/region.h"
#include "optimize/relaxation.h"

namespace hexweft {

/// `project`: a vertex lies on the reference. `fit`: it lies beside it, by as much as makes the
/// quads round it deviate least; a curved patch then errs half as much inward and half as much
/// outward, instead of the whole sagitta inward.
enum class SurfaceTreatment { project, fit };

struct SurfaceOptions {
  SurfaceTreatment treatment = SurfaceTreatment::project;
  double feature_angle_deg =
      40;               ///< (0, 180], normals round a vertex that differ by more are a feature
  double weight = 1e3;  ///< > 0, of leaving the surface; one hexahedron's distortion is 1
};

/// Where one surface vertex should go, and how it may slide until then.
struct SurfaceGoal {
  int vertex;
  Eigen::Vector3d point;  ///< on the reference, or beside it for `fit`
  Eigen::Matrix3d fixed;  ///< projector onto the directions it must not move in
};

/// The triangles of a reference that were last closest to samples of a quad, -1 where not known.
struct NearTriangles {
  int centre = -1;
  std::array<int, 4> middles = {-1, -1, -1, -1};  ///< of the edges
  std::array<int, 4> inside = {-1, -1, -1, -1};   ///< from the corners towards the centre
};

/// The surface vertices of one region, while it moves: what each stands for, which is decided once,
/// and where on the reference it was last, which makes the next closest point quick to find.
///
/// Vertices that stand for a feature of the reference (feature_assignment.h) slide along its line,
/// or stay in its corner; with `fit` the chain of edges along a curved line errs to both sides of
/// it. For the others, closest points are looked for among the triangles that face as the quads at
/// the vertex do, so that a thin part keeps its two sides apart. Where no chain was found for a
/// line, the tangent planes met a little way into the quads round a vertex tell what it sits on:
/// nearly one plane, and it slides on it; two, and it slides along their line; more, and it stays in
/// the corner.
class SurfaceConstraint {
 public:
  /// Later calls take the same region with other points.
  /// \param reference  must outlive this
  SurfaceConstraint(const Region& region, const ReferenceSurface& reference);

  /// One for each vertex of region.surface, in that order.
  std::vector<SurfaceGoal> goals(const Region& region, const SurfaceOptions& options = {});

  /// Replaces `pulls`, for the region at `points`, by those of `weight` / (edge length at the vertex)².
  void pulls(const Eigen::Matrix3Xd& points, const std::vector<SurfaceGoal>& goals, double weight,
             std::vector<VertexPull>& pulls) const;

  /// Moves the surface vertices to their goals, each as far as no hexahedron's scaled Jacobian falls
  /// under `least`, nor falls at all where it is under it. \return the fraction of vertices that
  /// got all the way
  double move_to_goals(Region& region, const std::vector<SurfaceGoal>& goals, double least) const;

 private:
  void find_hexes_at_surface(const Region& region);
  /// One for each vertex of region.surface; empty for those that stand for a feature.
  std::vector<SurfacePoint> closest_points(const Region& region,
                                           const Eigen::Matrix3Xd& vertex_normals);

  const ReferenceSurface& reference_;
  std::vector<FeatureLabel> labels_;      // by vertex
  std::vector<int> near_vertex_;          // triangle last closest, by vertex of region.surface
  std::vector<NearTriangles> near_quad_;  // and to the samples of each quad
  std::vector<HexCorners> hexes_;         // those with a free surface vertex
  Groups<int> around_;                    // those of them at each vertex of region.surface
};

/// Goals from the points as they are.
std::vector<SurfaceGoal> surface_goals(const Region& region, const ReferenceSurface& reference,
                                       const SurfaceOptions& options);

}  // namespace hexweft
