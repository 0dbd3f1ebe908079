#include "tools/farthest_point.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace hexweft::cli {
namespace {

using Eigen::Vector3d;

// Looks for a sample at a known distance. A part from which it cannot be reached is passed over, so
// that nearly all are.
class Finder {
 public:
  Finder(const ReferenceSurface& to, double distance)
      : to_(to), enough_(distance * (1 - 1e-12)), best_{-1, {}, {}} {}

  bool done() const { return best_.distance >= enough_; }
  const FarthestPoint& best() const { return best_; }

  void look_into(const Vector3d& a, const Vector3d& b, const Vector3d& c, int levels) {
    const Vector3d centroid = (a + b + c) / 3;
    const double reach =
        std::max({(a - centroid).norm(), (b - centroid).norm(), (c - centroid).norm()});
    if (look_at(centroid) + reach < enough_ || done()) return;
    for (const Vector3d* p : {&a, &b, &c}) look_at(*p);
    if (levels == 0 || done()) return;
    const Vector3d ab = (a + b) / 2, bc = (b + c) / 2, ca = (c + a) / 2;
    look_into(ab, bc, ca, levels - 1);
    look_into(a, ab, ca, levels - 1);
    look_into(ab, b, bc, levels - 1);
    look_into(ca, bc, c, levels - 1);
  }

 private:
  double look_at(const Vector3d& p) {
    const SurfacePoint s = to_.closest(p, near_);
    near_ = s.triangle;
    if (s.distance > best_.distance) best_ = {s.distance, p, s.point};
    return s.distance;
  }

  const ReferenceSurface& to_;
  double enough_;
  FarthestPoint best_;
  int near_ = -1;
};

}  // namespace

FarthestPoint find_farthest_point(const ReferenceSurface& from, const ReferenceSurface& to,
                                  double distance, const HausdorffOptions& options) {
  const auto& points = from.points();
  const auto area_of = [&](const std::array<int, 3>& t) {
    const Vector3d ab = points.col(t[1]) - points.col(t[0]);
    return ab.cross(points.col(t[2]) - points.col(t[0])).norm() / 2;
  };
  double area = 0;
  for (const auto& t : from.triangles()) area += area_of(t);
  const double on_surface =
      options.points_per_surface > 0
          ? options.points_per_surface
          : static_cast<double>(options.points_per_triangle) *
                static_cast<double>(std::max(from.triangles().size(), to.triangles().size()));
  Finder finder(to, distance);
  for (const auto& t : from.triangles()) {
    if (finder.done()) break;
    const double share = area > 0 ? on_surface * area_of(t) / area : 0;
    // A level more than samples are needed: their corners are those of the parts below.
    int levels = 1;
    for (double parts = 1; parts < std::max<double>(share, options.points_per_triangle); parts *= 4)
      ++levels;
    finder.look_into(points.col(t[0]), points.col(t[1]), points.col(t[2]), std::min(levels, 13));
  }
  return finder.best();
}

}  // namespace hexweft::cli
