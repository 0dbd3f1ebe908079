/// \file
/// Smoothing that cannot spoil a mesh: a vertex moves only as far as the cells round it stay good.
#pragma once

#include <algorithm>

#include "ovm/hex_mesh.h"
#include "ovm/quality.h"

namespace hexweft::detail {

inline double min_scaled_jacobian_round(const HexMesh& mesh, VertexHandle v) {
  double least = 1;
  for (CellHandle c : mesh.cells(v)) least = std::min(least, scaled_jacobian(mesh, c));
  return least;
}

/// Moves v all the way, half or less of it to the target: the first of these for which the least
/// scaled Jacobian round v is not below min(what it was, floor).
/// \return the share of the way gone, 0 if none was good
inline double move_guarded(HexMesh& mesh, VertexHandle v, const Eigen::Vector3d& target,
                           double floor) {
  const Eigen::Vector3d from = mesh.point(v);
  const double bound = std::min(min_scaled_jacobian_round(mesh, v), floor);
  for (double step = 1; step > 0.05; step /= 2) {
    mesh.set_point(v, from + step * (target - from));
    if (min_scaled_jacobian_round(mesh, v) >= bound) return step;
  }
  mesh.set_point(v, from);
  return 0;
}

/// Mean of the vertices joined to v by an edge for which `use` holds; v itself if there is none.
template <class Use>
Eigen::Vector3d mean_of_neighbors(const HexMesh& mesh, VertexHandle v, Use&& use) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int n = 0;
  for (EdgeHandle e : mesh.edges(v)) {
    if (!use(e)) continue;
    sum += mesh.point(mesh.other_end(e, v));
    ++n;
  }
  return n > 0 ? Eigen::Vector3d(sum / n) : mesh.point(v);
}

}  // namespace hexweft::detail
