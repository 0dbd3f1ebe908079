/// \file
/// The edges of a set of quads as a graph, and where they are bent.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace hexweft {

struct PatchEdge {
  int to;
  double length;
  bool bent;  // the quads at it differ in direction
};

/// Neighbours of a vertex in ascending order.
class PatchGraph {
 public:
  /// \param points  3 × #points, model units
  PatchGraph(const Eigen::Matrix3Xd& points, std::span<const std::array<int, 4>> quads);
  std::span<const PatchEdge> edges(int v) const {
    return {edges_.data() + first_[v], edges_.data() + first_[v + 1]};
  }
  double mean_length(int v) const { return mean_[v]; }  ///< 0 for a vertex of no quad
  /// Mean of the different directions of the quads at it, length 1; zero if there is none.
  const Eigen::Vector3d& normal(int v) const { return normals_[v]; }

 private:
  std::vector<int> first_;
  std::vector<PatchEdge> edges_;
  std::vector<double> mean_;
  std::vector<Eigen::Vector3d> normals_;
};

}  // namespace hexweft
