#include "optimize/feature_curves.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "ovm/detail/sort_unique.h"

namespace hexweft {
namespace {

constexpr int kStretch = 8;  // segments of a box

// Lines that may be within reach of a point, for Eigen::BVIntersect, which asks for these names.
struct Nearby {
  // NOLINTBEGIN(readability-identifier-naming)
  bool intersectVolume(const Eigen::AlignedBox3d& box) const {
    return box.squaredExteriorDistance(p) <= reach * reach;
  }
  bool intersectObject(int line) {
    lines.push_back(line);
    return false;  // go on
  }
  // NOLINTEND(readability-identifier-naming)
  Eigen::Vector3d p;
  double reach;
  std::vector<int> lines = {};
};

using EdgeKey = std::pair<int, int>;  // ends, the lower one first

EdgeKey edge_key(int a, int b) { return std::minmax(a, b); }

// The triangles' mean normal at each edge of a line.
std::map<EdgeKey, Eigen::Vector3d> mean_normals(const Eigen::Matrix3Xd& points,
                                                const std::vector<std::array<int, 3>>& triangles,
                                                const std::vector<FeatureLine>& lines) {
  std::map<EdgeKey, Eigen::Vector4d> sums;  // of normals, and their count
  for (const FeatureLine& line : lines) {
    for (int i = 0; i < line.n_segments(); ++i) {
      const auto [a, b] = line.segment(i);
      sums.emplace(edge_key(a, b), Eigen::Vector4d::Zero());
    }
  }
  if (sums.empty()) return {};
  for (const auto& t : triangles) {
    const Eigen::Vector3d a = points.col(t[0]), b = points.col(t[1]), c = points.col(t[2]);
    const Eigen::Vector3d normal = (b - a).cross(c - a).stableNormalized();
    for (int i = 0; i < 3; ++i) {
      const auto edge = sums.find(edge_key(t[i], t[(i + 1) % 3]));
      if (edge != sums.end()) edge->second += normal.homogeneous();
    }
  }
  std::map<EdgeKey, Eigen::Vector3d> means;
  for (const auto& [edge, sum] : sums) means[edge] = sum.head<3>() / std::max(sum[3], 1.0);
  return means;
}

// The index of a point among the corners.
int find_corner(const SurfaceFeatures& features, int point) {
  const auto at = std::lower_bound(features.corners.begin(), features.corners.end(), point);
  const bool found = at != features.corners.end() && *at == point;
  return found ? static_cast<int>(at - features.corners.begin()) : -1;
}

}  // namespace

FeatureCurves::FeatureCurves(const Eigen::Matrix3Xd& points,
                             const std::vector<std::array<int, 3>>& triangles,
                             SurfaceFeatures features)
    : features_(std::move(features)) {
  const auto facing = mean_normals(points, triangles, features_.lines);
  for (int v : features_.corners) corners_.emplace_back(points.col(v));
  std::vector<int> lines;  // of each box
  std::vector<Eigen::AlignedBox3d> boxes;
  for (const FeatureLine& line : features_.lines) {
    Curve curve;
    curve.points.emplace_back(points.col(line.points[0]));
    curve.arc.push_back(0);
    for (int i = 0; i < line.n_segments(); ++i) {
      const auto [a, b] = line.segment(i);
      const Eigen::Vector3d from = points.col(a), to = points.col(b);
      curve.facing.push_back(facing.at(edge_key(a, b)));
      curve.points.push_back(to);
      curve.arc.push_back(curve.arc.back() + (to - from).norm());
      if (i % kStretch == 0) curve.boxes.emplace_back(from);
      curve.boxes.back().extend(to);
    }
    for (const auto& box : curve.boxes) curve.box.extend(box);
    boxes.insert(boxes.end(), curve.boxes.begin(), curve.boxes.end());
    lines.resize(boxes.size(), static_cast<int>(curves_.size()));
    if (!line.closed) {
      curve.ends = {find_corner(features_, line.points.front()),
                    find_corner(features_, line.points.back())};
    }
    curves_.push_back(std::move(curve));
  }
  stretches_ = {lines.begin(), lines.end(), boxes.begin(), boxes.end()};
}

/// Improves `best` where this line comes nearer.
void FeatureCurves::look_at(int line, const Eigen::Vector3d& p, CurvePoint& best) const {
  const Curve& curve = curves_[line];
  const auto n = static_cast<int>(curve.points.size()) - 1;
  if (curve.box.squaredExteriorDistance(p) > best.distance * best.distance) return;
  for (int first = 0; first < n; first += kStretch) {
    double squared = best.distance * best.distance;
    if (curve.boxes[first / kStretch].squaredExteriorDistance(p) > squared) continue;
    for (int i = first; i < std::min(n, first + kStretch); ++i) {
      const Eigen::Vector3d along = curve.points[i + 1] - curve.points[i];
      const double length2 = along.squaredNorm();
      const double part = (p - curve.points[i]).dot(along) / (length2 > 0 ? length2 : 1);
      const double t = std::clamp(part, 0.0, 1.0);
      const Eigen::Vector3d q = curve.points[i] + t * along;
      const double d = (q - p).squaredNorm();
      if (d > squared || (d == squared && best.line >= 0)) continue;
      squared = d;
      const double arc = curve.arc[i] + t * (curve.arc[i + 1] - curve.arc[i]);
      best = {q,
              length2 > 0 ? Eigen::Vector3d(along.normalized()) : best.tangent,
              std::sqrt(d),
              arc,
              line,
              curve.facing[i]};
    }
  }
}

std::vector<int> FeatureCurves::lines_near(const Eigen::Vector3d& p, double reach) const {
  Nearby nearby{p, reach};
  if (n_lines() > 0) Eigen::BVIntersect(stretches_, nearby);
  detail::sort_unique(nearby.lines);
  return std::move(nearby.lines);
}

CurvePoint FeatureCurves::closest_within(const Eigen::Vector3d& p, double reach) const {
  CurvePoint best;
  best.distance = reach;
  for (const int line : lines_near(p, reach)) look_at(line, p, best);
  return best.line < 0 ? CurvePoint() : best;
}

CurvePoint FeatureCurves::closest(const Eigen::Vector3d& p, int line) const {
  CurvePoint best;
  look_at(line, p, best);
  return best;
}

std::vector<CurvePoint> FeatureCurves::within(const Eigen::Vector3d& p, double reach) const {
  std::vector<CurvePoint> found;
  for (const int line : lines_near(p, reach)) {
    CurvePoint best;
    best.distance = reach;
    look_at(line, p, best);
    if (best.line >= 0) found.push_back(best);
  }
  return found;
}

CurvePoint FeatureCurves::at(int line, double arc) const {
  const Curve& curve = curves_[line];
  const auto next = std::upper_bound(curve.arc.begin(), curve.arc.end() - 1, arc);
  const auto i = std::max<std::ptrdiff_t>(1, next - curve.arc.begin());
  const double length = curve.arc[i] - curve.arc[i - 1];
  const double t = length > 0 ? (arc - curve.arc[i - 1]) / length : 0;
  const Eigen::Vector3d along = curve.points[i] - curve.points[i - 1];
  return {curve.points[i - 1] + t * along, along.normalized(), 0, arc, line, curve.facing[i - 1]};
}

}  // namespace hexweft
