/// \file
/// Meshes and random moves for the tests of geometry.
#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "optimize/hex_energy.h"
#include "optimize/region.h"
#include "ovm/generators.h"
#include "ovm/hex_mesh.h"
#include "ovm/neighborhood.h"
#include "ovm/quality.h"
#include "tests/random.h"

namespace hexweft {

/// Moves every vertex, those on the boundary only if asked to, by up to `amount` along each axis.
inline void perturb(HexMesh& mesh, double amount, bool boundary_too, unsigned seed) {
  Random random(seed);
  for (VertexHandle v : mesh.vertices()) {
    const Eigen::Vector3d move = random.in_cube(amount);
    if (boundary_too || !mesh.is_boundary(v)) mesh.set_point(v, mesh.point(v) + move);
  }
}

/// A ball of radius 1: a grid whose cube is drawn round.
inline HexMesh make_ball(int n) {
  HexMesh mesh =
      make_grid({n, n, n}, Eigen::AlignedBox3d(-Eigen::Vector3d::Ones(), Eigen::Vector3d::Ones()));
  for (VertexHandle v : mesh.vertices()) {
    const Eigen::Vector3d p = mesh.point(v);
    if (p.norm() > 0) mesh.set_point(v, p * (p.cwiseAbs().maxCoeff() / p.norm()));
  }
  return mesh;
}

inline std::vector<Eigen::Vector3d> points_of(const HexMesh& mesh) {
  std::vector<Eigen::Vector3d> points;
  for (VertexHandle v : mesh.vertices()) points.push_back(mesh.point(v));
  return points;
}

}  // namespace hexweft
