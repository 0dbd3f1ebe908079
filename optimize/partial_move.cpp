#include "optimize/partial_move.h"

#include <algorithm>
#include <vector>

namespace hexweft {
namespace {

class PartialMove {
 public:
  PartialMove(HexMesh& mesh, const Region& before, SurfaceDistance& distance,
              const MoveLimits& limits)
      : mesh_(mesh),
        before_(before),
        distance_(distance),
        limits_(limits),
        distance_before_(distance.distance()),
        scaled_jacobians_(scaled_jacobians(before.points, before.hexes)),
        goal_(before.points),
        points_(before.points),
        fraction_(before.n_free, 1),
        marked_(before.vertices.size(), 0) {
    for (int v = 0; v < before.n_free; ++v) goal_.col(v) = mesh.point(before.vertices[v]);
  }

  bool run();

 private:
  void place();
  bool mark_bad_hexes();
  bool mark_far_sides();
  void widen_marks();
  bool take_back(bool all_the_way);
  void take_back_round_marks(int round);
  bool mend_hexes();

  HexMesh& mesh_;
  const Region& before_;
  SurfaceDistance& distance_;
  const MoveLimits& limits_;
  double distance_before_;                // of the whole surface, model units
  std::vector<double> scaled_jacobians_;  // before the move
  Eigen::Matrix3Xd goal_, points_;
  std::vector<double> fraction_;  // of the way to the goal
  std::vector<char> marked_;      // vertices to take back
};

void PartialMove::place() {
  for (int v = 0; v < before_.n_free; ++v) {
    const double f = fraction_[v];
    if (f < 1) points_.col(v) = (1 - f) * before_.points.col(v) + f * goal_.col(v);
    if (f == 1) points_.col(v) = goal_.col(v);
    mesh_.set_point(before_.vertices[v], points_.col(v));
  }
}

bool PartialMove::mark_bad_hexes() {
  const std::vector<double> now = scaled_jacobians(points_, before_.hexes);
  bool any = false;
  for (std::size_t h = 0; h < now.size(); ++h) {
    if (now[h] >= std::min(limits_.least_scaled_jacobian, scaled_jacobians_[h])) continue;
    for (int v : before_.hexes[h]) marked_[v] = 1;
    any = true;
  }
  return any;
}

/// Brings the distance up to date. What was too far before, elsewhere, is not
/// this move's fault. \return whether any side is too far
bool PartialMove::mark_far_sides() {
  const double d = distance_.after_change(mesh_, before_.cells);
  if (d <= limits_.distance) return false;
  std::vector<double> by_side;  // six a cell
  by_side.reserve(kSides * before_.cells.size());
  for (CellHandle c : before_.cells) {
    for (int k = 0; k < kSides; ++k) {
      by_side.push_back(distance_.distance_at(HalfFaceHandle(kSides * c.idx + k)));
    }
  }
  const double farthest = *std::max_element(by_side.begin(), by_side.end());
  if (farthest <= limits_.distance && d <= distance_before_) return false;
  // Those about as far as the farthest go back with it: they would be the next.
  constexpr double kClose = 0.9;
  const double threshold = std::min(limits_.distance, kClose * farthest);
  for (std::size_t i = 0; i < before_.cells.size(); ++i) {
    for (int k = 0; k < kSides; ++k) {
      if (by_side[kSides * i + k] < threshold) continue;
      for (int corner : kSideCorners[k]) marked_[before_.hexes[i][corner]] = 1;
    }
  }
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
  constexpr int kHalvings = 2;  // then all the way
  constexpr int kNarrow = 4;    // rounds, then the surroundings too
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
  for (int round = 0; round < kRounds && mend_hexes(); ++round) {
    std::fill(marked_.begin(), marked_.end(), 0);
    if (!mark_far_sides()) return true;
    take_back_round_marks(round);
  }
  distance_.rollback();
  return false;
}

}  // namespace

bool keep_what_fits(HexMesh& mesh, const Region& before, SurfaceDistance& distance,
                    const MoveLimits& limits) {
  return PartialMove(mesh, before, distance, limits).run();
}

}  // namespace hexweft
