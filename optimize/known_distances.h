/// \file
/// Distances of the points that several sides share, each looked for once, and from where it was
/// found the last time.
#pragma once

#include <limits>
#include <vector>

#include "optimize/reference_surface.h"

namespace hexweft {

/// Points are numbered by what they belong to, such as vertices or edges, and may have moved whenever
/// a new look begins.
class KnownDistances {
 public:
  void begin_look() { ++look_; }

  /// The distance of point i, at p all through this look, or as soon as it is known to be at most
  /// `enough`, any number from it to `enough`.
  double distance(const ReferenceSurface& reference, int i, const Eigen::Vector3d& p,
                  double enough) {
    if (i >= static_cast<int>(known_.size())) known_.resize(i + 1);
    Known& known = known_[i];
    if (known.look != look_) {
      known.look = look_;
      known.at_most = std::numeric_limits<double>::infinity();
      known.exact = false;
    }
    if (!known.exact && known.at_most > enough) {
      known.at_most = reference.distance(p, known.near, enough);
      known.exact = known.at_most > enough;
    }
    return known.at_most;
  }

 private:
  struct Known {
    int look = 0;
    int near = -1;  // triangle, of the last look that there was
    double at_most = 0;
    bool exact = false;
  };
  int look_ = 0;
  std::vector<Known> known_;
};

}  // namespace hexweft
