#include "optimize/untangle.h"

#include <vector>

#include "ovm/neighborhood.h"
#include "ovm/quality.h"

namespace hexweft {

int untangle(HexMesh& mesh, const ReferenceSurface& reference,
             const ParametrizationOptions& options, int max_rounds) {
  const std::vector<CellHandle> cells = all_cells(mesh);
  ParametrizationOptions o = options;
  o.max_iterations = 1;
  int inverted = summarize_quality(mesh, 0).n_inverted;
  for (int round = 0; round < max_rounds && inverted > 0; ++round) {
    parametrize(mesh, cells, reference, o);
    const int now = summarize_quality(mesh, 0).n_inverted;
    const bool fewer = now < inverted;
    inverted = now;
    if (!fewer) break;
  }
  return inverted;
}

}  // namespace hexweft
