#include "ovm/generators.h"
#include "ovm/topology_check.h"

int main() {
  const hexweft::HexMesh mesh = hexweft::make_grid({3, 2, 1});
  return hexweft::is_valid(mesh) && mesh.n_cells() == 6 ? 0 : 1;
}
