/// \file
/// The farthest of the samples of triangles, looking only where it can be.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace hexweft {

/// The farthest that a point of a triangle can be from the nearest of its corners.
inline double covering_radius(const Eigen::Vector3d& p, const Eigen::Vector3d& q,
                              const Eigen::Vector3d& r) {
  double a = (q - r).squaredNorm(), b = (r - p).squaredNorm(), c = (p - q).squaredNorm();
  if (a > c) std::swap(a, c);
  if (b > c) std::swap(b, c);
  // Right or obtuse at the corner across from c: on side c, as far from it as from another corner.
  if (a + b <= c) {
    const auto along = [&](double s, double t) {
      return s > 0 ? s * std::sqrt(c) / (s + c - t) : 0;
    };
    return std::max(along(a, b), along(b, a));
  }
  return std::sqrt(a * b * c / (4 * a * b - (a + b - c) * (a + b - c)));  // of the circumcircle
}

/// How closely a surface is looked at, in model units. Parts whose covering radius is over the
/// resolution are divided further than they were asked for, unless nothing in them can be farther than
/// what is faint: small distances need not be known as well.
struct Closeness {
  double resolution = std::numeric_limits<double>::infinity();
  double faint = 0;
};

/// Of the size of a surface, the limit that distances are held against if nothing else is asked for.
inline constexpr double kUsualLimit = 0.01;

/// What it takes to tell whether a limit is kept.
/// \param size  of the surface, which bounds the effort where the limit is very small
inline Closeness closeness_for(double limit, double size) {
  return {std::max(0.05 * limit, 2e-4 * size), std::max(0.5 * limit, 5e-4 * size)};
}

/// The limit that a mesh is held to is looked for no less closely than the usual one.
inline double limit_to_look_for(double limit, double size) {
  return std::min(limit, kUsualLimit * size);
}

/// How far a point is, and the piece of the other surface that it was found to be so far from; -1 if
/// that is not told.
struct FoundDistance {
  double distance;
  int piece = -1;
};

/// A point that was looked at, and its distance, or some more where that is small.
struct Sample {
  Eigen::Vector3d point;
  double distance;
  int piece;  ///< as FoundDistance
};

/// Where pieces are not told.
struct CoversNothing {
  bool operator()(int, const Sample&, const Sample&, const Sample&, double) const { return false; }
};

/// Looks for the sample of greatest distance. A part of a triangle needs no closer look if its corners
/// and centroid are close enough for its size; or if all of its corners are close enough to the same
/// convex piece, as the distance to that is nowhere in the part more than at a corner.
template <class Distance, class Covers = CoversNothing>
class FarthestSample {
 public:
  /// \param distance  (point, enough) → FoundDistance; the distance changes by no more than the point
  ///                  moves, but if it is at most `enough`, may be any number from it to `enough`
  /// \param at_least  below it distances are not told apart
  /// \param enough    beyond it the search is over
  /// \param covers    (piece, three samples, d) → whether all of them are within d of a convex part of
  ///                  the piece that one of them was found to be near to
  FarthestSample(Distance distance, double at_least,
                 double enough = std::numeric_limits<double>::infinity(),
                 const Closeness& closeness = {}, Covers covers = {})
      : distance_(std::move(distance)),
        covers_(std::move(covers)),
        farthest_(at_least),
        enough_(enough),
        closeness_(closeness) {}

  bool done() const { return farthest_ > enough_; }

  Sample look_at(const Eigen::Vector3d& p) {
    constexpr double kNear =
        0.25;  // of the farthest: what is nearer lets large parts be passed over
    const FoundDistance found = distance_(p, kNear * farthest_);
    if (found.distance > farthest_ || !at_) at_ = p;
    farthest_ = std::max(farthest_, found.distance);
    return {p, found.distance, found.piece};
  }

  /// The centroid of a triangle of which the corners were looked at, and the corners and centroids of
  /// its subdivisions into four.
  void look_at(const Sample& a, const Sample& b, const Sample& c, int levels) {
    if (done() || is_close(a, b, c)) return;
    const Sample g = look_at((a.point + b.point + c.point) / 3);
    if (levels <= 0 && !is_coarse(a, b, c)) return;
    if (is_close(a, b, g) && is_close(b, c, g) && is_close(c, a, g)) return;
    const Sample ab = look_at((a.point + b.point) / 2), bc = look_at((b.point + c.point) / 2),
                 ca = look_at((c.point + a.point) / 2);
    look_at(ab, bc, ca, levels - 1);
    look_at(a, ab, ca, levels - 1);
    look_at(ab, b, bc, levels - 1);
    look_at(ca, bc, c, levels - 1);
  }

  double distance() const { return farthest_; }
  /// The sample that is so far; if that is not more than `at_least`, the first of all.
  const std::optional<Eigen::Vector3d>& at() const { return at_; }

 private:
  static double radius(const Sample& a, const Sample& b, const Sample& c) {
    return covering_radius(a.point, b.point, c.point);
  }
  static double farthest_corner(const Sample& a, const Sample& b, const Sample& c) {
    return std::max({a.distance, b.distance, c.distance});
  }
  bool is_close(const Sample& a, const Sample& b, const Sample& c) const {
    return farthest_corner(a, b, c) + radius(a, b, c) <= farthest_ || is_covered(a, b, c);
  }
  bool is_covered(const Sample& a, const Sample& b, const Sample& c) const {
    const auto by = [&](int piece) { return piece >= 0 && covers_(piece, a, b, c, farthest_); };
    return by(a.piece) || (b.piece != a.piece && by(b.piece)) ||
           (c.piece != a.piece && c.piece != b.piece && by(c.piece));
  }
  bool is_coarse(const Sample& a, const Sample& b, const Sample& c) const {
    // Of the coordinates: what is smaller has no middle any more.
    constexpr double kRounding = 1e-14;
    const double r = radius(a, b, c), rounding = kRounding * a.point.cwiseAbs().maxCoeff();
    return r > std::max(closeness_.resolution, rounding) &&
           farthest_corner(a, b, c) + r > closeness_.faint;
  }

  Distance distance_;
  Covers covers_;
  double farthest_, enough_;
  Closeness closeness_;
  std::optional<Eigen::Vector3d> at_;
};

/// Corners that triangles share: each is looked at once, when it is first asked for.
template <class Search>
class SharedCorners {
 public:
  /// \param search, points  must outlive this
  SharedCorners(Search& search, const Eigen::Matrix3Xd& points)
      : search_(search), points_(points), seen_(points.cols()) {}
  const Sample& operator[](int v) {
    if (!seen_[v]) seen_[v] = search_.look_at(points_.col(v));
    return *seen_[v];
  }

 private:
  Search& search_;
  const Eigen::Matrix3Xd& points_;
  std::vector<std::optional<Sample>> seen_;
};

}  // namespace hexweft
