#include "simplify/simplify.h"

#include <string>

#include <fmt/format.h>

#include "ovm/errors.h"
#include "ovm/quality.h"
#include "ovm/topology_check.h"
#include "simplify/detail/run.h"

namespace hexweft {
namespace {

void check_mesh(const HexMesh& mesh, const char* which) {
  for (const TopologyViolation& v : check_topology(mesh)) {
    if (severity(v.defect) == Severity::invalid)
      throw InputError(fmt::format("{} is not valid: {}", which, v.message));
  }
  if (mesh.n_cells() == 0) throw InputError(fmt::format("{} has no cells", which));
  for (const CellHandle c : mesh.cells()) {
    const double sj = scaled_jacobian(mesh, c);
    if (sj > 0) continue;
    throw InputError(
        fmt::format("cell {} of {} has scaled Jacobian {:.4g}, expected > 0", c.idx, which, sj));
  }
}

}  // namespace

SimplifyReport simplify(HexMesh& mesh, const SimplifyOptions& options) {
  validate(options);
  check_mesh(mesh, "the mesh");
  return detail::Run(mesh, options).run();
}

SimplifyReport resume_simplify(HexMesh& mesh, const Checkpoint& from,
                               const SimplifyOptions& options) {
  validate(options);
  check_mesh(mesh, "the mesh");
  check_mesh(from.mesh, "the checkpoint's mesh");
  detail::Run run(mesh, options);
  run.go_on_from(from);
  return run.run();
}

}  // namespace hexweft
