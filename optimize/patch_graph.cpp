#include "optimize/patch_graph.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <numbers>

#include <Eigen/Geometry>

#include "optimize/groups.h"

namespace hexweft {
namespace {

// One end of a side of a quad, seen from the other.
struct Side {
  int to, quad;
  auto operator<=>(const Side&) const = default;
};

std::vector<Eigen::Vector3d> normals_of(const Eigen::Matrix3Xd& points,
                                        std::span<const std::array<int, 4>> quads) {
  std::vector<Eigen::Vector3d> normals;
  normals.reserve(quads.size());
  for (const auto& q : quads) {
    const Eigen::Vector3d d1 = points.col(q[2]) - points.col(q[0]);
    const Eigen::Vector3d d2 = points.col(q[3]) - points.col(q[1]);
    normals.push_back(d1.cross(d2).normalized());
  }
  return normals;
}

Groups<Side> sides_at_vertices(int n_vertices, std::span<const std::array<int, 4>> quads) {
  std::vector<int> sizes(n_vertices, 0);
  for (const auto& q : quads) {
    for (int v : q) sizes[v] += 2;
  }
  Groups<Side> sides(sizes);
  for (int i = 0; i < static_cast<int>(quads.size()); ++i) {
    for (int k = 0; k < 4; ++k) {
      const int from = quads[i][k], to = quads[i][(k + 1) % 4];
      sides.add(from, {to, i});
      sides.add(to, {from, i});
    }
  }
  return sides;
}

// However many quads a face has at a vertex, it counts once.
Eigen::Vector3d mean_of_different(const std::vector<Eigen::Vector3d>& normals,
                                  std::span<const Side> sides, double same) {
  std::vector<Eigen::Vector3d> different;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Side& side : sides) {
    const Eigen::Vector3d& n = normals[side.quad];
    const auto is_same = [&](const Eigen::Vector3d& m) { return n.dot(m) >= same; };
    if (std::any_of(different.begin(), different.end(), is_same)) continue;
    different.push_back(n);
    sum += n;
  }
  return sum.normalized();
}

}  // namespace

PatchGraph::PatchGraph(const Eigen::Matrix3Xd& points, std::span<const std::array<int, 4>> quads)
    : first_(points.cols() + 1, 0),
      mean_(points.cols(), 0),
      normals_(points.cols(), Eigen::Vector3d::Zero()) {
  const double bent = std::cos(25 * std::numbers::pi / 180);
  const std::vector<Eigen::Vector3d> normals = normals_of(points, quads);
  Groups<Side> sides = sides_at_vertices(static_cast<int>(points.cols()), quads);
  for (int v = 0; v < points.cols(); ++v) {
    const std::span<Side> here = sides[v];
    normals_[v] = mean_of_different(normals, here, bent);
    std::sort(here.begin(), here.end());
    for (std::size_t i = 0, next = 0; i < here.size(); i = next) {
      const auto [to, quad] = here[i];
      while (next < here.size() && here[next].to == to) ++next;
      const bool pair = next == i + 2;
      const double length = (points.col(to) - points.col(v)).norm();
      edges_.push_back({to, length, pair && normals[quad].dot(normals[here[i + 1].quad]) < bent});
      mean_[v] += length;
      ++first_[v + 1];
    }
    if (first_[v + 1] > 0) mean_[v] /= first_[v + 1];
    first_[v + 1] += first_[v];
  }
}

}  // namespace hexweft
