/// \file
/// The farthest of the samples of triangles, looking only where it can be.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Core>

namespace hexweft {

/// Looks for the sample of greatest `distance`, any function of a point that changes by no more than
/// the point moves: a part of a triangle whose centroid is close enough needs no closer look.
template <class Distance>
class FarthestSample {
 public:
  /// \param at_least  below it distances are not told apart
  /// \param enough    beyond it the search is over
  FarthestSample(Distance distance, double at_least,
                 double enough = std::numeric_limits<double>::infinity())
      : distance_(std::move(distance)), farthest_(at_least), enough_(enough) {}

  bool done() const { return farthest_ > enough_; }

  double look_at(const Eigen::Vector3d& p) {
    const double d = distance_(p);
    farthest_ = std::max(farthest_, d);
    return d;
  }

  /// The centroid of a triangle, and the corners and centroids of its subdivisions into four.
  void look_at(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
               int levels) {
    const Eigen::Vector3d centroid = (a + b + c) / 3;
    const double reach =
        std::sqrt(std::max({(a - centroid).squaredNorm(), (b - centroid).squaredNorm(),
                            (c - centroid).squaredNorm()}));
    const double d = look_at(centroid);
    if (levels == 0 || d + reach <= farthest_ || done()) return;
    const Eigen::Vector3d ab = (a + b) / 2, bc = (b + c) / 2, ca = (c + a) / 2;
    for (const Eigen::Vector3d* p : {&a, &b, &c, &ab, &bc, &ca}) look_at(*p);
    look_at(ab, bc, ca, levels - 1);
    look_at(a, ab, ca, levels - 1);
    look_at(ab, b, bc, levels - 1);
    look_at(ca, bc, c, levels - 1);
  }

  double distance() const { return farthest_; }

 private:
  Distance distance_;
  double farthest_, enough_;
};

}  // namespace hexweft
