#include "optimize/surface_constraint.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "optimize/feature_goals.h"

namespace hexweft {
namespace {

/// Normals of the quads, and of the surface vertices as their area-weighted means.
struct RegionNormals {
  explicit RegionNormals(const Region& region)
      : quad(3, static_cast<Eigen::Index>(region.quads.size())),
        vertex(Eigen::Matrix3Xd::Zero(3, region.points.cols())) {
    for (std::size_t i = 0; i < region.quads.size(); ++i) {
      const auto& q = region.quads[i];
      const Eigen::Vector3d d1 = region.points.col(q[2]) - region.points.col(q[0]);
      const Eigen::Vector3d d2 = region.points.col(q[3]) - region.points.col(q[1]);
      const Eigen::Vector3d area = d1.cross(d2);
      quad.col(i) = area.normalized();
      for (int v : q) vertex.col(v) += area;
    }
    for (auto n : vertex.colwise()) n.normalize();  // all at once would divide zeros
  }
  Eigen::Matrix3Xd quad, vertex;
};

/// Least and greatest signed distance from samples of the quads round a vertex to the reference,
/// positive where the reference lies outside.
struct Deviation {
  double least = 0, greatest = 0;
  void take(double d) {
    least = std::min(least, d);
    greatest = std::max(greatest, d);
  }
  double middle() const { return (least + greatest) / 2; }
};

/// The closest point to a place that moves a little from time to time.
/// \param known     the triangle it was on the last time, or -1; updated
/// \param neighbor  the one found for the place before, or -1; updated
SurfacePoint closest_from_last(const ReferenceSurface& reference, const Eigen::Vector3d& at,
                               const Eigen::Vector3d& normal, int& known, int& neighbor) {
  const SurfacePoint s = reference.closest(at, normal, known >= 0 ? known : neighbor);
  known = neighbor = s.triangle;
  return s;
}

std::vector<Deviation> deviations(const Region& region, const RegionNormals& normals,
                                  const ReferenceSurface& reference,
                                  std::vector<NearTriangles>& near_quad) {
  std::vector<Deviation> result(region.points.cols());
  int neighbor = -1;
  for (std::size_t i = 0; i < region.quads.size(); ++i) {
    const auto& q = region.quads[i];
    const Eigen::Vector3d normal = normals.quad.col(i);
    Eigen::Vector3d p[4];
    for (int k = 0; k < 4; ++k) p[k] = region.points.col(q[k]);
    const auto signed_distance = [&](const Eigen::Vector3d& at, int& near) {
      const SurfacePoint s = closest_from_last(reference, at, normal, near, neighbor);
      return std::copysign(s.distance, (s.point - at).dot(normal));
    };
    const double centre = signed_distance((p[0] + p[2]) / 2, near_quad[i].centre);
    for (int k = 0; k < 4; ++k) {
      result[q[k]].take(centre);
      const int from = q[k], to = q[(k + 1) % 4];
      if (std::min(from, to) >= region.n_free) continue;  // nothing there will move
      // The quad on the other side runs along this edge the other way: one of the two looks at it.
      if (from > to && from < region.n_free) continue;
      const double edge = signed_distance((p[k] + p[(k + 1) % 4]) / 2, near_quad[i].middles[k]);
      result[from].take(edge);
      result[to].take(edge);
    }
  }
  return result;
}

/// The tangent planes met round a vertex, as moments.
struct TangentPlanes {
  Eigen::Matrix3d normals = Eigen::Matrix3d::Zero();  // Σ n nᵀ
  Eigen::Vector3d offsets = Eigen::Vector3d::Zero();  // Σ n (n · point)
  int n = 0;
  void take(const Eigen::Vector3d& normal, const Eigen::Vector3d& point) {
    normals += normal * normal.transpose();
    offsets += normal * normal.dot(point);
    ++n;
  }
};

/// Of the vertices that are marked only.
std::vector<TangentPlanes> tangent_planes(const Region& region, const RegionNormals& normals,
                                          const ReferenceSurface& reference,
                                          const std::vector<char>& wanted,
                                          std::vector<NearTriangles>& near_quad) {
  constexpr double kInto = 0.25;  // of the way to the quad's centre
  std::vector<TangentPlanes> planes(region.points.cols());
  int neighbor = -1;
  for (std::size_t i = 0; i < region.quads.size(); ++i) {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (int v : region.quads[i]) centre += region.points.col(v) / 4;
    for (int k = 0; k < 4; ++k) {
      const int v = region.quads[i][k];
      if (!wanted[v]) continue;
      const Eigen::Vector3d at = (1 - kInto) * region.points.col(v) + kInto * centre;
      const SurfacePoint s =
          closest_from_last(reference, at, normals.quad.col(i), near_quad[i].inside[k], neighbor);
      planes[v].take(s.normal, s.point);
    }
  }
  return planes;
}

/// The goal of a vertex at p with closest point s and mean normal `outward`.
SurfaceGoal goal_on(const TangentPlanes& planes, int vertex, const Eigen::Vector3d& p,
                    const SurfacePoint& s, const Eigen::Vector3d& outward, double threshold,
                    const ReferenceSurface& reference) {
  constexpr double kRim =
      0.5;  // sine of the angle from the planes' normals to the outward direction
  SurfaceGoal goal{vertex, s.point, s.normal * s.normal.transpose()};
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.computeDirect(planes.normals / planes.n);
  const Eigen::Vector3d force = (planes.offsets - planes.normals * p) / planes.n;
  Eigen::Vector3d move = Eigen::Vector3d::Zero();
  Eigen::Matrix3d fixed = Eigen::Matrix3d::Zero();
  for (int k = 0; k < 3; ++k) {
    if (eigen.eigenvalues()[k] < threshold) continue;
    const Eigen::Vector3d axis = eigen.eigenvectors().col(k);
    fixed += axis * axis.transpose();
    move += axis * axis.dot(force) / eigen.eigenvalues()[k];
  }
  // On the rim of a thin part the planes of the two sides are one and say nothing of the way out.
  const Eigen::Vector3d rim = outward - fixed * outward;
  if (rim.norm() > kRim) {
    const Eigen::Vector3d axis = rim.normalized();
    fixed += axis * axis.transpose();
    move += axis * axis.dot(s.point - p);
  }
  if (fixed.trace() < 1.5) return goal;
  goal.fixed = fixed;
  goal.point = reference.closest(p + move, s.triangle).point;
  return goal;
}

/// Unmarks the vertices of which the nearest line runs through a quad at them, as a chain of edges:
/// they themselves belong to a face.
void leave_to_chains(const Region& region, const FeatureCurves& curves,
                     const std::vector<FeatureLabel>& labels, std::vector<char>& at_feature) {
  constexpr double kRounding = 1e-9;  // of the line's length
  for (const auto& q : region.quads) {
    const bool has_corner =
        std::any_of(q.begin(), q.end(), [&](int v) { return labels[v].is_corner(); });
    const auto on_line =
        std::find_if(q.begin(), q.end(), [&](int v) { return labels[v].is_line(); });
    if (!has_corner && on_line == q.end()) continue;
    for (int v : q) {
      if (!at_feature[v]) continue;
      const auto nearest_runs_here = [&] {
        const Eigen::Vector3d p = region.points.col(v);
        const int line = labels[*on_line].line;
        const double reach = curves.closest(p, line).distance + kRounding * curves.length(line);
        const int nearest = curves.closest_within(p, reach).line;
        return std::any_of(q.begin(), q.end(), [&](int w) { return labels[w].line == nearest; });
      };
      if (has_corner || nearest_runs_here()) at_feature[v] = 0;
    }
  }
}

/// Moves the goals of the marked vertices off the reference, to the middle of the deviations of the
/// quads round them.
void fit_planes(const Region& region, const RegionNormals& normals,
                const ReferenceSurface& reference, const std::vector<char>& plane,
                std::vector<NearTriangles>& near_quad, std::vector<SurfaceGoal>& goals) {
  constexpr double kDamping = 0.7;  // neighbors move the same way; undamped they would overshoot
  std::vector<Deviation> deviation = deviations(region, normals, reference, near_quad);
  for (SurfaceGoal& goal : goals) {
    if (!plane[goal.vertex]) continue;
    const Eigen::Vector3d p = region.points.col(goal.vertex);
    const Eigen::Vector3d normal = normals.vertex.col(goal.vertex);
    const double own = (goal.point - p).dot(normal);
    Deviation& d = deviation[goal.vertex];
    d.take(own);
    goal.point += (kDamping * d.middle() - own) * (goal.fixed * normal);
  }
}

}  // namespace

std::vector<SurfacePoint> SurfaceConstraint::closest_points(
    const Region& region, const Eigen::Matrix3Xd& vertex_normals) {
  std::vector<SurfacePoint> closest;
  closest.reserve(region.surface.size());
  int neighbor = -1;
  for (std::size_t i = 0; i < region.surface.size(); ++i) {
    const int v = region.surface[i];
    if (labels_[v].is_any()) {  // its line or corner is what it goes by
      closest.emplace_back();
      continue;
    }
    closest.push_back(closest_from_last(reference_, region.points.col(v), vertex_normals.col(v),
                                        near_vertex_[i], neighbor));
  }
  return closest;
}

std::vector<SurfaceGoal> SurfaceConstraint::goals(const Region& region,
                                                  const SurfaceOptions& options) {
  const RegionNormals normals(region);
  const double half_angle = options.feature_angle_deg * std::numbers::pi / 360;
  const double threshold = std::sin(half_angle) * std::sin(half_angle);
  const std::vector<SurfacePoint> closest = closest_points(region, normals.vertex);
  std::vector<char> at_feature(region.points.cols(), 0), plane(region.points.cols(), 0);
  for (std::size_t i = 0; i < closest.size(); ++i) {
    const int v = region.surface[i];
    at_feature[v] = !labels_[v].is_any() && reference_.at_feature(closest[i].triangle);
  }
  leave_to_chains(region, reference_.curves(), labels_, at_feature);
  std::vector<TangentPlanes> planes =
      tangent_planes(region, normals, reference_, at_feature, near_quad_);
  std::vector<SurfaceGoal> goals;
  goals.reserve(region.surface.size());
  for (std::size_t i = 0; i < region.surface.size(); ++i) {
    const int v = region.surface[i];
    const SurfacePoint& s = closest[i];
    if (labels_[v].is_any()) {
      goals.push_back(goal_on_feature(reference_.curves(), labels_[v], v, region.points.col(v)));
    } else if (at_feature[v]) {
      planes[v].take(s.normal, s.point);
      goals.push_back(goal_on(planes[v], v, region.points.col(v), s, normals.vertex.col(v),
                              threshold, reference_));
    } else {
      goals.push_back({v, s.point, s.normal * s.normal.transpose()});
    }
    plane[v] = goals.back().fixed.trace() < 1.5;
  }
  if (options.treatment == SurfaceTreatment::project) return goals;
  if (reference_.curves().n_lines() > 0) fit_lines(region, reference_.curves(), labels_, goals);
  fit_planes(region, normals, reference_, plane, near_quad_, goals);
  return goals;
}

std::vector<SurfaceGoal> surface_goals(const Region& region, const ReferenceSurface& reference,
                                       const SurfaceOptions& options) {
  return SurfaceConstraint(region, reference).goals(region, options);
}

}  // namespace hexweft
