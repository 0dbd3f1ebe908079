// What surface vertices do to the hexahedra at them: pulls, and moves as far as these bear.
#include <algorithm>
#include <cmath>

#include "optimize/surface_constraint.h"

namespace hexweft {

SurfaceConstraint::SurfaceConstraint(const Region& region, const ReferenceSurface& reference)
    : reference_(reference),
      labels_(assign_features(region.points, region.quads, region.n_free, reference)),
      near_vertex_(region.surface.size(), -1),
      near_quad_(region.quads.size()) {
  find_hexes_at_surface(region);
}

void SurfaceConstraint::find_hexes_at_surface(const Region& region) {
  std::vector<int> position(region.points.cols(), -1);
  for (std::size_t i = 0; i < region.surface.size(); ++i) {
    position[region.surface[i]] = static_cast<int>(i);
  }
  std::vector<int> n_around(region.surface.size(), 0);
  for (const HexCorners& hex : region.hexes) {
    bool touches = false;
    for (int v : hex) {
      if (position[v] < 0) continue;
      ++n_around[position[v]];
      touches = true;
    }
    if (touches) hexes_.push_back(hex);
  }
  around_ = Groups<int>(n_around);
  for (int h = 0; h < static_cast<int>(hexes_.size()); ++h) {
    for (int v : hexes_[h]) {
      if (position[v] >= 0) around_.add(position[v], h);
    }
  }
}

void SurfaceConstraint::pulls(const Eigen::Matrix3Xd& points, const std::vector<SurfaceGoal>& goals,
                              double weight, std::vector<VertexPull>& pulls) const {
  pulls.clear();
  for (int i = 0; i < static_cast<int>(goals.size()); ++i) {
    const SurfaceGoal& g = goals[i];
    double sum = 0;  // of squared lengths of the edges at the vertex, in every hexahedron
    for (int h : around_[i]) {
      const HexCorners& hex = hexes_[h];
      for (const auto& [a, b] : kEdgeCorners) {
        if (hex[a] != g.vertex && hex[b] != g.vertex) continue;
        sum += (points.col(hex[a]) - points.col(hex[b])).squaredNorm();
      }
    }
    const double squared = std::max(sum / (3 * static_cast<double>(around_[i].size())), 1e-300);
    pulls.push_back({g.vertex, weight / squared * g.fixed, g.point});
  }
}

double SurfaceConstraint::move_to_goals(Region& region, const std::vector<SurfaceGoal>& goals,
                                        double least) const {
  constexpr double kLeastFraction = 1.0 / 16;
  if (goals.empty()) return 1;
  Eigen::Matrix3Xd start(3, static_cast<Eigen::Index>(goals.size()));
  for (std::size_t i = 0; i < goals.size(); ++i) start.col(i) = region.points.col(goals[i].vertex);
  const std::vector<double> before = scaled_jacobians(region.points, hexes_);
  std::vector<double> fraction(goals.size(), 1.0);
  for (bool good = false; !good;) {
    for (std::size_t i = 0; i < goals.size(); ++i) {
      region.points.col(goals[i].vertex) =
          (1 - fraction[i]) * start.col(i) + fraction[i] * goals[i].point;
    }
    const std::vector<double> now = scaled_jacobians(region.points, hexes_);
    const auto falls = [&](int h) { return now[h] < std::min(least, before[h]); };
    good = true;
    for (int i = 0; i < static_cast<int>(goals.size()); ++i) {
      const auto hexes = around_[i];
      if (fraction[i] == 0 || std::none_of(hexes.begin(), hexes.end(), falls)) continue;
      fraction[i] = fraction[i] > kLeastFraction ? fraction[i] / 2 : 0;
      good = false;
    }
  }
  return static_cast<double>(std::count(fraction.begin(), fraction.end(), 1.0)) /
         static_cast<double>(goals.size());
}

}  // namespace hexweft
