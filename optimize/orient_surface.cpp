#include "optimize/orient_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>

#include "optimize/box.h"

namespace hexweft {
namespace {

using Triangle = std::array<int, 3>;

/// A side of a triangle.
struct Side {
  std::array<int, 2> edge;  // its ends, the lower first
  bool forward;             // from the lower to the higher
  int triangle, corner;     // it goes from the corner to the next one
};

void add_sides(const Triangle& t, int triangle, std::vector<Side>& sides) {
  for (int k = 0; k < 3; ++k) {
    const int from = t[k], to = t[(k + 1) % 3];
    if (from != to)
      sides.push_back({{std::min(from, to), std::max(from, to)}, from < to, triangle, k});
  }
}

/// Calls `visit(first, last)` for the sides of every edge.
template <class Visit>
void for_each_edge(std::vector<Side>& sides, const Visit& visit) {
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::pair(a.edge, a.triangle) < std::pair(b.edge, b.triangle);
  });
  for (auto first = sides.begin(); first != sides.end();) {
    const auto last =
        std::find_if(first, sides.end(), [&](const Side& s) { return s.edge != first->edge; });
    visit(first, last);
    first = last;
  }
}

struct Neighbor {
  int triangle = -1;     // -1: not exactly one
  bool against = false;  // both go along the edge the same way
};

std::vector<std::array<Neighbor, 3>> find_neighbors(const std::vector<Triangle>& triangles) {
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    add_sides(triangles[t], static_cast<int>(t), sides);
  std::vector<std::array<Neighbor, 3>> neighbors(triangles.size());
  for_each_edge(sides, [&](auto first, auto last) {
    if (last - first != 2) return;
    const Side &a = first[0], &b = first[1];
    neighbors[a.triangle][a.corner] = {b.triangle, a.forward == b.forward};
    neighbors[b.triangle][b.corner] = {a.triangle, a.forward == b.forward};
  });
  return neighbors;
}

struct Piece {
  std::vector<int> triangles;
  bool closed = false;
  Box3 box{};
  Eigen::Vector3d inner;  // the centre of its largest triangle: least likely on another piece
};

class SurfaceOrienter {
 public:
  SurfaceOrienter(const Eigen::Matrix3Xd& points, std::vector<Triangle>& triangles)
      : points_(points), triangles_(triangles), neighbors_(find_neighbors(triangles)) {}

  int run() {
    const std::vector<Triangle> before = triangles_;
    find_pieces();
    std::erase_if(pieces_, [](const Piece& piece) { return !piece.closed; });
    for (Piece& piece : pieces_) measure(piece);
    std::vector<char> is_cavity;
    for (const Piece& piece : pieces_) is_cavity.push_back(depth(piece) % 2 == 1);
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      const double volume = signed_volume(pieces_[i]);
      if (is_cavity[i] ? volume > 0 : volume < 0) turn(pieces_[i].triangles);
    }
    int n_turned = 0;
    for (std::size_t t = 0; t < before.size(); ++t) n_turned += triangles_[t] != before[t];
    return n_turned;
  }

 private:
  void find_pieces();
  Piece grow(int start);
  bool is_closed(const Piece& piece) const;
  void measure(Piece& piece) const;
  int depth(const Piece& piece) const;
  double signed_volume(const Piece& piece) const;
  double winding_number(const Piece& piece, const Eigen::Vector3d& p) const;

  void turn(const std::vector<int>& triangles) {
    for (int t : triangles) std::swap(triangles_[t][1], triangles_[t][2]);
  }
  std::array<Eigen::Vector3d, 3> corners(int t, const Eigen::Vector3d& origin) const {
    const auto& [a, b, c] = triangles_[t];
    return {points_.col(a) - origin, points_.col(b) - origin, points_.col(c) - origin};
  }

  const Eigen::Matrix3Xd& points_;
  std::vector<Triangle>& triangles_;
  std::vector<std::array<Neighbor, 3>> neighbors_;
  std::vector<signed char> side_;  // 0: turned against the file, 1: not, -1: not known
  std::vector<Piece> pieces_;
};

void SurfaceOrienter::find_pieces() {
  side_.assign(triangles_.size(), -1);
  for (int t = 0; t < static_cast<int>(triangles_.size()); ++t) {
    if (side_[t] < 0) pieces_.push_back(grow(t));
  }
}

// Makes the triangles round the first one agree with it, then all with the most of them.
Piece SurfaceOrienter::grow(int start) {
  Piece piece;
  piece.triangles = {start};
  side_[start] = 1;
  bool two_sided = true;
  for (std::size_t i = 0; i < piece.triangles.size(); ++i) {
    const int t = piece.triangles[i];
    for (const Neighbor& n : neighbors_[t]) {
      if (n.triangle < 0) continue;
      const signed char side = side_[t] ^ static_cast<signed char>(n.against);
      if (side_[n.triangle] < 0) {
        side_[n.triangle] = side;
        piece.triangles.push_back(n.triangle);
      } else if (side_[n.triangle] != side) {
        two_sided = false;
      }
    }
  }
  if (!two_sided) return piece;
  std::array<std::vector<int>, 2> of_side;
  for (int t : piece.triangles) of_side[side_[t]].push_back(t);
  turn(of_side[0].size() > of_side[1].size() ? of_side[1] : of_side[0]);
  piece.closed = is_closed(piece);
  return piece;
}

bool SurfaceOrienter::is_closed(const Piece& piece) const {
  std::vector<Side> sides;
  for (int t : piece.triangles) add_sides(triangles_[t], t, sides);
  bool closed = true;
  for_each_edge(sides, [&](auto first, auto last) {
    const auto n_forward = std::count_if(first, last, [](const Side& s) { return s.forward; });
    closed = closed && 2 * n_forward == last - first;
  });
  return closed;
}

void SurfaceOrienter::measure(Piece& piece) const {
  double largest = -1;
  std::vector<Eigen::Vector3d> points;
  for (int t : piece.triangles) {
    const auto p = corners(t, Eigen::Vector3d::Zero());
    points.insert(points.end(), p.begin(), p.end());
    const double area = (p[1] - p[0]).cross(p[2] - p[0]).norm();
    if (area <= largest) continue;
    largest = area;
    piece.inner = (p[0] + p[1] + p[2]) / 3;
  }
  piece.box = box_of(points);
}

// How many other closed pieces it lies in. One that is touched from outside may count half round.
int SurfaceOrienter::depth(const Piece& piece) const {
  constexpr double kMoreThanHalf = 0.6;
  return static_cast<int>(std::count_if(pieces_.begin(), pieces_.end(), [&](const Piece& other) {
    return &other != &piece && other.box.squared_distance(piece.inner) == 0 &&
           std::abs(winding_number(other, piece.inner)) > kMoreThanHalf;
  }));
}

double SurfaceOrienter::signed_volume(const Piece& piece) const {
  double sum = 0;
  for (int t : piece.triangles) {
    const auto [a, b, c] = corners(t, piece.inner);
    sum += a.dot(b.cross(c));
  }
  return sum / 6;
}

double SurfaceOrienter::winding_number(const Piece& piece, const Eigen::Vector3d& p) const {
  double sum = 0;
  for (int t : piece.triangles) {
    const auto [a, b, c] = corners(t, p);
    const double x = a.norm(), y = b.norm(), z = c.norm();
    sum += std::atan2(a.dot(b.cross(c)), x * y * z + a.dot(b) * z + b.dot(c) * x + c.dot(a) * y);
  }
  return sum / (2 * std::numbers::pi);  // the angles are halves
}

}  // namespace

int orient_surface(const Eigen::Matrix3Xd& points, std::vector<std::array<int, 3>>& triangles) {
  return SurfaceOrienter(points, triangles).run();
}

}  // namespace hexweft
