#include "optimize/bent_edges.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>

namespace hexweft {

std::vector<BentEdge> bent_edges(const Eigen::Matrix3Xd& points,
                                 const std::vector<std::array<int, 3>>& triangles) {
  std::vector<Eigen::Vector3d> normals;
  std::vector<std::pair<std::array<int, 2>, int>> sides;  // an edge and a triangle at it
  for (const auto& [a, b, c] : triangles) {
    const auto triangle = static_cast<int>(normals.size());
    const Eigen::Vector3d ab = points.col(b) - points.col(a), ac = points.col(c) - points.col(a);
    normals.push_back(ab.cross(ac).normalized());
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
      if (from != to) sides.push_back({{std::min(from, to), std::max(from, to)}, triangle});
    }
  }
  std::sort(sides.begin(), sides.end());
  std::vector<BentEdge> edges;
  for (std::size_t i = 0, next = 0; i < sides.size(); i = next) {
    while (next < sides.size() && sides[next].first == sides[i].first) ++next;
    double angle = std::numbers::pi;
    if (next == i + 2) {
      const Eigen::Vector3d &m = normals[sides[i].second], &n = normals[sides[i + 1].second];
      // A triangle without area has no normal and says nothing.
      angle = m.isZero() || n.isZero() ? 0 : std::atan2(m.cross(n).norm(), m.dot(n));
    }
    edges.push_back({sides[i].first, angle});
  }
  return edges;
}

}  // namespace hexweft
