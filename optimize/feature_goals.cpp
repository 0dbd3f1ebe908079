#include "optimize/feature_goals.h"

#include <algorithm>

namespace hexweft {

SurfaceGoal goal_on_feature(const FeatureCurves& curves, const FeatureLabel& label, int vertex,
                            const Eigen::Vector3d& p) {
  if (label.is_corner()) {
    return {vertex, curves.corner(label.corner), Eigen::Matrix3d::Identity()};
  }
  const CurvePoint on = curves.closest(p, label.line);
  return {vertex, on.point, Eigen::Matrix3d::Identity() - on.tangent * on.tangent.transpose()};
}

void fit_lines(const Region& region, const FeatureCurves& curves,
               const std::vector<FeatureLabel>& labels, std::vector<SurfaceGoal>& goals) {
  constexpr double kDamping = 0.9;
  std::vector<Eigen::Vector3d> sagitta(labels.size(), Eigen::Vector3d::Zero());
  std::vector<int> n_edges(labels.size(), 0);
  const auto to_line = [&](const Eigen::Vector3d& p, int line) -> Eigen::Vector3d {
    return curves.closest(p, line).point - p;
  };
  for (const auto& q : region.quads) {
    for (int k = 0; k < 4; ++k) {
      const int a = q[k], b = q[(k + 1) % 4];
      const int line = std::max(labels[a].line, labels[b].line);
      const auto is_on = [&](int v) { return labels[v].is_corner() || labels[v].line == line; };
      if (line < 0 || !is_on(a) || !is_on(b)) continue;
      const Eigen::Vector3d pa = region.points.col(a), pb = region.points.col(b);
      const Eigen::Vector3d d =
          to_line((pa + pb) / 2, line) - (to_line(pa, line) + to_line(pb, line)) / 2;
      for (int v : {a, b}) {
        sagitta[v] += d;
        ++n_edges[v];
      }
    }
  }
  for (SurfaceGoal& goal : goals) {
    if (!labels[goal.vertex].is_line() || n_edges[goal.vertex] == 0) continue;
    goal.point += kDamping / 2 / n_edges[goal.vertex] * (goal.fixed * sagitta[goal.vertex]);
  }
}

}  // namespace hexweft
