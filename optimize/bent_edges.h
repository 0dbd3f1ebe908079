/// \file
/// The edges of a triangle mesh and how much it is bent along them.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

namespace hexweft {

/// An edge of the surface and how much it is bent.
struct BentEdge {
  std::array<int, 2> ends;  ///< vertices, ascending
  double angle;             ///< rad; π at a border or where more than two triangles meet
};

/// Every edge once, by its ends. A triangle without area counts as not bent against its neighbors.
/// \param points  3 × #vertices
std::vector<BentEdge> bent_edges(const Eigen::Matrix3Xd& points,
                                 const std::vector<std::array<int, 3>>& triangles);

}  // namespace hexweft
