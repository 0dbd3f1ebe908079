#include <array>
#include <iostream>
#include <string>
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

int main() {
  write_hex_mesh("before.vtk", make_octree_like(Shape::sphere, 8));
  run_examples();
}
