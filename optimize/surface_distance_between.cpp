// The change of a SurfaceDistance between its samples.
#include <algorithm>
#include <cmath>
#include <vector>

#include "optimize/covered_parts.h"
#include "optimize/farthest_sample.h"
#include "optimize/surface_distance.h"

namespace hexweft {
namespace {

constexpr int kLevels = 3;  // 64 parts of a triangle of mean size, each with its corners

}  // namespace

Closeness SurfaceDistance::closeness(double limit) const {
  const double size = reference_.bounding_box_diagonal();
  return closeness_for(limit_to_look_for(limit, size), size);
}

bool SurfaceDistance::change_is_within(double limit, double skip_rel) {
  too_far_at_.reset();
  FarthestSample farthest(DistanceTo(reference_), limit, limit, closeness(limit),
                          CoveredByTriangle{reference_});
  for (const SideUndo& u : side_undo_) {
    if (!grid_.contains(u.side) || forward_[u.side] < skip_rel * limit) continue;
    const QuadPoints& q = grid_.points(u.side);
    const Sample corners[] = {farthest.look_at(q[0]), farthest.look_at(q[1]),
                              farthest.look_at(q[2]), farthest.look_at(q[3])};
    farthest.look_at(corners[0], corners[1], corners[2], kLevels + levels_for(q[0], q[1], q[2]));
    farthest.look_at(corners[2], corners[3], corners[0], kLevels + levels_for(q[2], q[3], q[0]));
    if (farthest.done()) {
      too_far_at_ = centre_of(q);
      return false;
    }
  }
  return changed_triangles_are_within(limit, skip_rel * limit);
}

bool SurfaceDistance::changed_triangles_are_within(double limit, double skip) {
  std::vector<char> changed(samples_.size(), 0);
  for (const SampleUndo& u : sample_undo_) changed[u.sample] = backward_[u.sample] >= skip;
  int guess = -1;
  FarthestSample farthest(
      [&](const Eigen::Vector3d& p, double) {
        const QuadGrid::Nearest nearest = grid_.nearest(p, guess);
        guess = nearest.id;
        return FoundDistance{std::sqrt(nearest.squared_distance), nearest.id};
      },
      limit, limit, closeness(limit), CoveredByQuad{grid_});
  const auto& triangles = reference_.triangles();
  // A side that moved can come nearest to, or leave, parts of the triangles beside these as well.
  std::vector<char> near_change(reference_.points().cols(), 0);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const TriangleSamples& own = samples_of_triangle_[t];
    const auto& corners = triangles[t];
    bool any = std::any_of(changed.begin() + own.first_centroid, changed.begin() + own.end,
                           [](char c) { return c != 0; });
    for (int i = 0; i < 3; ++i) any |= changed[corners[i]] || changed[own.edges[i]];
    if (!any) continue;
    for (int v : corners) near_change[v] = 1;
  }
  const auto& points = reference_.points();
  SharedCorners seen(farthest, points);
  for (std::size_t t = 0; t < triangles.size() && !farthest.done(); ++t) {
    const auto& corners = triangles[t];
    if (std::none_of(corners.begin(), corners.end(), [&](int v) { return near_change[v] != 0; }))
      continue;
    const TriangleSamples& own = samples_of_triangle_[t];
    guess = nearest_side_.side(own.first_centroid);
    const Sample &a = seen[corners[0]], &b = seen[corners[1]], &c = seen[corners[2]];
    farthest.look_at(a, b, c, kLevels + levels_for(a.point, b.point, c.point));
    if (farthest.done()) too_far_at_ = (a.point + b.point + c.point) / 3;
  }
  return !farthest.done();
}

}  // namespace hexweft
