#include "optimize/partial_move.h"

#include <algorithm>
#include <vector>

namespace hexweft {
namespace {

constexpr int kHalvings = 2;  // of the way that is taken back, then all of it

class PartialMove {
 public:
  PartialMove(HexMesh& mesh, const Region& before, SurfaceDistance& distance,
              const MoveLimits& limits, const WorthKeeping& worth_keeping)
      : mesh_(mesh),
        before_(before),
        distance_(distance),
        limits_(limits),
        worth_keeping_(worth_keeping),
        side_distances_before_(side_distances()),
        scaled_jacobians_before_(scaled_jacobians(before.points, before.hexes)),
        goal_(before.points),
        points_(before.points),
        fraction_(before.n_free, 1),
        marked_(before.vertices.size(), 0) {
    for (int v = 0; v < before.n_free; ++v) goal_.col(v) = mesh.point(before.vertices[v]);
  }

  bool run();

 private:
  std::vector<double> side_distances() const;
  double distance_before() const {
    return *std::max_element(side_distances_before_.begin(), side_distances_before_.end());
  }
  void place();
  bool mark_bad_hexes();
  bool mark_far_sides();
  bool mark_far_between();
  void widen_marks();
  bool take_back(bool all_the_way);
  void take_back_round_marks(int round);
  bool mend_hexes();

  HexMesh& mesh_;
  const Region& before_;
  SurfaceDistance& distance_;
  const MoveLimits& limits_;
  const WorthKeeping& worth_keeping_;
  double moved_distance_ = 0;                  // of what has moved, model units
  std::vector<double> side_distances_before_;  // model units
  std::vector<double> scaled_jacobians_before_;
  std::vector<double> scaled_jacobians_;  // at the last look at the hexahedra
  Eigen::Matrix3Xd goal_, points_;
  std::vector<double> fraction_;  // of the way to the goal
  std::vector<char> marked_;      // vertices to take back
};

/// Six a cell, model units.
std::vector<double> PartialMove::side_distances() const {
  std::vector<double> by_side;
  by_side.reserve(kSides * before_.cells.size());
  for (CellHandle c : before_.cells) {
    for (int k = 0; k < kSides; ++k) {
      by_side.push_back(distance_.distance_at(HalfFaceHandle(kSides * c.idx + k)));
    }
  }
  return by_side;
}

void PartialMove::place() {
  for (int v = 0; v < before_.n_free; ++v) {
    const double f = fraction_[v];
    if (f < 1) points_.col(v) = (1 - f) * before_.points.col(v) + f * goal_.col(v);
    if (f == 1) points_.col(v) = goal_.col(v);
    mesh_.set_point(before_.vertices[v], points_.col(v));
  }
}

bool PartialMove::mark_bad_hexes() {
  scaled_jacobians_ = scaled_jacobians(points_, before_.hexes);
  bool any = false;
  for (std::size_t h = 0; h < scaled_jacobians_.size(); ++h) {
    const double floor = std::min(limits_.least_scaled_jacobian, scaled_jacobians_before_[h]);
    if (scaled_jacobians_[h] >= floor) continue;
    for (int v : before_.hexes[h]) marked_[v] = 1;
    any = true;
  }
  return any;
}

/// Brings the distance up to date. A side that was too far before may stay so, if it gets no
/// farther. \return whether any side is too far
bool PartialMove::mark_far_sides() {
  moved_distance_ = distance_.after_change(mesh_, before_.cells);
  if (moved_distance_ <= limits_.distance) return false;
  const std::vector<double> now = side_distances();
  const auto got_farther = [&](std::size_t side) {
    return now[side] > side_distances_before_[side];
  };
  double farthest = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (got_farther(i)) farthest = std::max(farthest, now[i]);
  }
  if (farthest <= limits_.distance && moved_distance_ <= distance_before()) return false;
  // Those about as far as the farthest go back with it: they would be the next.
  constexpr double kClose = 0.9;
  const double threshold = std::min(limits_.distance, kClose * farthest);
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (now[i] < threshold || !got_farther(i)) continue;
    for (int corner : kSideCorners[i % kSides]) marked_[before_.hexes[i / kSides][corner]] = 1;
  }
  return true;
}

/// Looks between the samples, which only those that come near the limit need.
/// \return whether a place there is too far; the first that is found is marked
bool PartialMove::mark_far_between() {
  constexpr double kSuspect = 0.6;
  if (moved_distance_ <= kSuspect * limits_.between) return false;
  if (distance_.change_is_within(limits_.between, kSuspect)) return false;
  Eigen::Index nearest;
  (points_.colwise() - *distance_.too_far_at()).colwise().squaredNorm().minCoeff(&nearest);
  marked_[nearest] = 1;
  widen_marks();
  return true;
}

void PartialMove::widen_marks() {
  const std::vector<char> marked = marked_;
  for (const HexCorners& hex : before_.hexes) {
    if (std::none_of(hex.begin(), hex.end(), [&](int v) { return marked[v]; })) continue;
    for (int v : hex) marked_[v] = 1;
  }
}

/// \return whether any vertex had a way to go back
bool PartialMove::take_back(bool all_the_way) {
  bool any = false;
  for (int v = 0; v < before_.n_free; ++v) {
    if (!marked_[v] || fraction_[v] == 0) continue;
    fraction_[v] = all_the_way ? 0 : fraction_[v] / 2;
    any = true;
  }
  return any;
}

/// Takes the marked vertices back, with ever more of their surroundings the
/// more rounds there were.
void PartialMove::take_back_round_marks(int round) {
  constexpr int kNarrow = 4;  // rounds, then the surroundings too
  for (int i = kNarrow; i <= round; ++i) widen_marks();
  // Where all that is marked is back already, the cause lies beside it.
  for (int i = 0; !take_back(round >= kHalvings) && i < 3; ++i) widen_marks();
  place();
}

/// \return false if some hexahedra stay bad
bool PartialMove::mend_hexes() {
  constexpr int kRounds = 20;
  for (int round = 0; round < kRounds; ++round) {
    std::fill(marked_.begin(), marked_.end(), 0);
    if (!mark_bad_hexes()) return true;
    take_back_round_marks(round);
  }
  return false;
}

bool PartialMove::run() {
  constexpr int kRounds = 10;
  place();
  for (int at_samples = 0, between = 0;
       at_samples < kRounds && between < kRounds && mend_hexes();) {
    // Looking at the distance costs most, and only takes away more.
    if (worth_keeping_ && !worth_keeping_(scaled_jacobians_)) break;
    std::fill(marked_.begin(), marked_.end(), 0);
    if (mark_far_sides()) {
      take_back_round_marks(at_samples++);
    } else if (mark_far_between()) {
      take_back_round_marks(kHalvings);  // all the way at once: each look costs much
      ++between;
    } else {
      return true;
    }
  }
  distance_.rollback();
  return false;
}

}  // namespace

bool keep_what_fits(HexMesh& mesh, const Region& before, SurfaceDistance& distance,
                    const MoveLimits& limits, const WorthKeeping& worth_keeping) {
  return PartialMove(mesh, before, distance, limits, worth_keeping).run();
}

}  // namespace hexweft
