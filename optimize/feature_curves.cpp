#include "optimize/feature_curves.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hexweft {
namespace {

constexpr int kStretch = 8;  // segments of a box

// What is within reach of a point, for Eigen::BVIntersect.
template <class Object>
struct Nearby {
  bool intersectVolume(const Eigen::AlignedBox3d& box) const {
    return box.squaredExteriorDistance(p) <= reach * reach;
  }
  bool intersectObject(const Object& object) {
    found.push_back(object);
    return false;  // go on
  }
  Eigen::Vector3d p;
  double reach;
  std::vector<Object> found = {};
};

}  // namespace

FeatureCurves::FeatureCurves(const Eigen::Matrix3Xd& points, SurfaceFeatures features)
    : features_(std::move(features)) {
  for (int v : features_.corners) corners_.emplace_back(points.col(v));
  std::vector<Stretch> stretches;
  std::vector<Eigen::AlignedBox3d> boxes;
  for (const FeatureLine& line : features_.lines) {
    Curve curve;
    curve.points.emplace_back(points.col(line.points[0]));
    curve.arc.push_back(0);
    for (int i = 0; i < line.n_segments(); ++i) {
      const Eigen::Vector3d from = points.col(line.segment(i)[0]),
                            to = points.col(line.segment(i)[1]);
      curve.points.push_back(to);
      curve.arc.push_back(curve.arc.back() + (to - from).norm());
      if (i % kStretch == 0) curve.boxes.emplace_back(from);
      curve.boxes.back().extend(to);
    }
    for (std::size_t i = 0; i < curve.boxes.size(); ++i) {
      curve.box.extend(curve.boxes[i]);
      stretches.push_back({static_cast<int>(curves_.size()), static_cast<int>(i) * kStretch});
      boxes.push_back(curve.boxes[i]);
    }
    curves_.push_back(std::move(curve));
  }
  stretches_ = Tree(stretches.begin(), stretches.end(), boxes.begin(), boxes.end());
}

/// Improves `best` where this line comes nearer.
void FeatureCurves::look_at(int line, const Eigen::Vector3d& p, CurvePoint& best) const {
  const Curve& curve = curves_[line];
  if (curve.box.squaredExteriorDistance(p) > best.distance * best.distance) return;
  for (std::size_t i = 0; i < curve.boxes.size(); ++i) {
    if (curve.boxes[i].squaredExteriorDistance(p) > best.distance * best.distance) continue;
    look_at({line, static_cast<int>(i) * kStretch}, p, best);
  }
}

void FeatureCurves::look_at(const Stretch& stretch, const Eigen::Vector3d& p,
                            CurvePoint& best) const {
  const Curve& curve = curves_[stretch.line];
  const auto n = static_cast<int>(curve.points.size()) - 1;
  double squared = best.distance * best.distance;
  for (int i = stretch.first; i < std::min(n, stretch.first + kStretch); ++i) {
    const Eigen::Vector3d along = curve.points[i + 1] - curve.points[i];
    const double length2 = along.squaredNorm();
    const double part = (p - curve.points[i]).dot(along) / (length2 > 0 ? length2 : 1);
    const double t = std::clamp(part, 0.0, 1.0);
    const Eigen::Vector3d q = curve.points[i] + t * along;
    const double d = (q - p).squaredNorm();
    if (d > squared || (d == squared && best.line >= 0)) continue;
    squared = d;
    const double arc = curve.arc[i] + t * (curve.arc[i + 1] - curve.arc[i]);
    best = {q, length2 > 0 ? Eigen::Vector3d(along.normalized()) : best.tangent, std::sqrt(d), arc,
            stretch.line};
  }
}

CurvePoint FeatureCurves::closest(const Eigen::Vector3d& p) const {
  CurvePoint best;
  for (int line = 0; line < n_lines(); ++line) look_at(line, p, best);
  return best;
}

CurvePoint FeatureCurves::closest(const Eigen::Vector3d& p, int line) const {
  CurvePoint best;
  look_at(line, p, best);
  return best;
}

std::vector<CurvePoint> FeatureCurves::within(const Eigen::Vector3d& p, double reach) const {
  Nearby<Stretch> nearby{p, reach};
  if (n_lines() > 0) Eigen::BVIntersect(stretches_, nearby);
  std::sort(nearby.found.begin(), nearby.found.end());
  std::vector<CurvePoint> found;
  CurvePoint best;
  for (std::size_t i = 0; i < nearby.found.size(); ++i) {
    const Stretch& stretch = nearby.found[i];
    if (i == 0 || stretch.line != nearby.found[i - 1].line) {
      best = {};
      best.distance = reach;
    }
    look_at(stretch, p, best);
    const bool last = i + 1 == nearby.found.size() || nearby.found[i + 1].line != stretch.line;
    if (last && best.line >= 0) found.push_back(best);
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
  return {curve.points[i - 1] + t * along, along.normalized(), 0, arc, line};
}

}  // namespace hexweft
