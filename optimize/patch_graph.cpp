#include "optimize/patch_graph.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <numbers>
#include <numeric>

#include <Eigen/Geometry>

namespace hexweft {

PatchGraph::PatchGraph(const Eigen::Matrix3Xd& points, std::span<const std::array<int, 4>> quads)
    : first_(points.cols() + 1, 0), mean_(points.cols(), 0) {
  const double bent = std::cos(25 * std::numbers::pi / 180);
  // Each side of a quad both ways, by where it begins.
  std::vector<int> begin(points.cols() + 1, 0);
  for (const auto& q : quads) {
    for (int v : q) begin[v + 1] += 2;
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  struct Side {
    int to, quad;
    auto operator<=>(const Side&) const = default;
  };
  std::vector<Side> sides(begin.back());
  std::vector<int> end(begin.begin(), begin.end() - 1);
  std::vector<Eigen::Vector3d> normals;
  for (const auto& q : quads) {
    const auto id = static_cast<int>(normals.size());
    const Eigen::Vector3d d1 = points.col(q[2]) - points.col(q[0]);
    const Eigen::Vector3d d2 = points.col(q[3]) - points.col(q[1]);
    normals.push_back(d1.cross(d2).normalized());
    for (int k = 0; k < 4; ++k) {
      const int from = q[k], to = q[(k + 1) % 4];
      sides[end[from]++] = {to, id};
      sides[end[to]++] = {from, id};
    }
  }
  for (int v = 0; v < points.cols(); ++v) {
    std::sort(sides.begin() + begin[v], sides.begin() + begin[v + 1]);
    for (int i = begin[v], next = i; i < begin[v + 1]; i = next) {
      const auto [to, quad] = sides[i];
      while (next < begin[v + 1] && sides[next].to == to) ++next;
      const bool pair = next == i + 2;
      const double length = (points.col(to) - points.col(v)).norm();
      edges_.push_back({to, length, pair && normals[quad].dot(normals[sides[i + 1].quad]) < bent});
      mean_[v] += length;
      ++first_[v + 1];
    }
    if (first_[v + 1] > 0) mean_[v] /= first_[v + 1];
    first_[v + 1] += first_[v];
  }
}

}  // namespace hexweft
