#include "optimize/patch_graph.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include <Eigen/Geometry>

namespace hexweft {

PatchGraph::PatchGraph(const Eigen::Matrix3Xd& points, std::span<const std::array<int, 4>> quads)
    : first_(points.cols() + 1, 0), mean_(points.cols(), 0) {
  const double bent = std::cos(25 * std::numbers::pi / 180);
  std::vector<std::tuple<int, int, int>> sides;  // from, to, quad; both ways
  std::vector<Eigen::Vector3d> normals;
  for (const auto& q : quads) {
    const auto id = static_cast<int>(normals.size());
    const Eigen::Vector3d d1 = points.col(q[2]) - points.col(q[0]);
    const Eigen::Vector3d d2 = points.col(q[3]) - points.col(q[1]);
    normals.push_back(d1.cross(d2).normalized());
    for (int k = 0; k < 4; ++k) {
      sides.emplace_back(q[k], q[(k + 1) % 4], id);
      sides.emplace_back(q[(k + 1) % 4], q[k], id);
    }
  }
  std::sort(sides.begin(), sides.end());
  for (std::size_t i = 0, next = 0; i < sides.size(); i = next) {
    const auto& [from, to, quad] = sides[i];
    for (next = i + 1; next < sides.size() && std::get<0>(sides[next]) == from;) {
      if (std::get<1>(sides[next]) != to) break;
      ++next;
    }
    const bool pair = next == i + 2;
    const double length = (points.col(to) - points.col(from)).norm();
    edges_.push_back(
        {to, length, pair && normals[quad].dot(normals[std::get<2>(sides[i + 1])]) < bent});
    mean_[from] += length;
    ++first_[from + 1];
  }
  for (std::size_t v = 0; v + 1 < first_.size(); ++v) {
    if (first_[v + 1] > 0) mean_[v] /= first_[v + 1];
    first_[v + 1] += first_[v];
  }
}

}  // namespace hexweft
