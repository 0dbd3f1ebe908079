/// \file
/// A relaxation with known minimum: a grid whose inner vertices have been thrown about.
#pragma once

#include <vector>

#include "optimize/relaxation.h"
#include "tests/optimize/test_meshes.h"

namespace hexweft {

/// The inner vertices of a perturbed grid are free, the boundary is fixed.
inline RelaxationProblem make_problem(double amount, unsigned seed) {
  HexMesh mesh = make_grid({4, 4, 4});
  std::vector<VertexHandle> order;
  for (int pass = 0; pass < 2; ++pass) {
    for (VertexHandle v : mesh.vertices()) {
      if (mesh.is_boundary(v) == (pass == 1)) order.push_back(v);
    }
  }
  perturb(mesh, amount, false, seed);
  std::vector<int> local(mesh.vertex_slots());
  RelaxationProblem p;
  p.points.resize(3, mesh.n_vertices());
  for (int i = 0; VertexHandle v : order) {
    p.points.col(i) = mesh.point(v);
    local[v.idx] = i++;
    if (!mesh.is_boundary(v)) p.n_free = i;
  }
  for (CellHandle c : mesh.cells()) {
    HexCorners& hex = p.hexes.emplace_back();
    for (int k = 0; VertexHandle v : mesh.vertices(c)) hex[k++] = local[v.idx];
    p.targets.emplace_back();
  }
  return p;
}

}  // namespace hexweft
