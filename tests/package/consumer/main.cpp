#include <array>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "headers.inc"
#include "ovm/generators.h"

using namespace hexweft;

namespace {

// What one of the examples has from the one before it.
HexMesh mesh = make_octree_like(Shape::torus, 12);
const ReferenceSurface surface = make_reference_surface(mesh);
const std::vector<CellHandle> region = grow_cells(mesh, std::array{CellHandle(0)}, 3);

#include "examples.inc"

}  // namespace

// Its points are allocated here and released by the library.
void hand_over_a_surface() {
  Eigen::Matrix3Xd points(3, 4);
  points << 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1;
  ReferenceSurface(std::move(points), {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}});
}

int main() {
  hand_over_a_surface();
  write_hex_mesh("before.vtk", make_octree_like(Shape::sphere, 8));
  run_examples();
}
