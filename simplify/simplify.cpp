#include "simplify/simplify.h"

#include <string>
#include <utility>

#include <fmt/format.h>

#include "optimize/hausdorff.h"
#include "optimize/untangle.h"
#include "ovm/errors.h"
#include "ovm/quality.h"
#include "ovm/topology_check.h"
#include "simplify/attempts.h"
#include "simplify/detail/run.h"

namespace hexweft {
namespace {

void check_mesh(const HexMesh& mesh, const char* which) {
  for (const TopologyViolation& v : check_topology(mesh)) {
    if (severity(v.defect) == Severity::invalid)
      throw InputError(fmt::format("{} is not valid: {}", which, v.message));
  }
  if (mesh.n_cells() == 0) throw InputError(fmt::format("{} has no cells", which));
  for (const VertexHandle v : mesh.vertices()) {
    if (mesh.point(v).allFinite()) continue;
    throw InputError(
        fmt::format("vertex {} of {} has a coordinate that is not a finite number", v.idx, which));
  }
}

CellHandle first_inverted(const HexMesh& mesh) {
  for (const CellHandle c : mesh.cells()) {
    if (!(scaled_jacobian(mesh, c) > 0)) return c;
  }
  return CellHandle();
}

void expect_no_inverted(const HexMesh& mesh, const char* which) {
  const CellHandle c = first_inverted(mesh);
  if (!c.valid()) return;
  throw InputError(fmt::format("cell {} of {} has scaled Jacobian {:.4g}, expected > 0", c.idx,
                               which, scaled_jacobian(mesh, c)));
}

// On its surface as far as the limit says.
void untangle_input(HexMesh& mesh, const ReferenceSurface& reference,
                    const SimplifyOptions& options) {
  const std::string inverted =
      fmt::format("cell {} of the mesh is one of {} that are inverted", first_inverted(mesh).idx,
                  summarize_quality(mesh, 0).n_inverted);
  const int left = untangle(mesh, reference, options.parametrization);
  if (left > 0)
    throw InputError(fmt::format("{}, of which {} cannot be untangled", inverted, left));
  const double ratio = hausdorff_ratio(mesh, reference, options.hausdorff_limit_rel);
  if (ratio > options.hausdorff_limit_rel) {
    throw InputError(
        fmt::format("{}; untangled it is {:.4g} of its diagonal off its surface, "
                    "expected at most {:.4g}",
                    inverted, ratio, options.hausdorff_limit_rel));
  }
}

// The mesh changes only if nothing is thrown.
SimplifyReport run_on(HexMesh& mesh, const Checkpoint* from, const SimplifyOptions& options) {
  const auto start = detail::Run::Clock::now();
  validate(options);
  check_mesh(mesh, "the mesh");
  if (from) {
    if (options.attempts > 1)
      throw InputError(
          fmt::format("attempts = {} of a run that is resumed, expected 1", options.attempts));
    check_mesh(from->mesh, "the checkpoint's mesh");
    expect_no_inverted(from->mesh, "the checkpoint's mesh");
  }
  const ReferenceSurface reference =
      make_reference_surface(mesh, kNormalAngleDeg, options.features);
  Outcome outcome = {mesh, {}};
  const bool tangled = first_inverted(mesh).valid();
  if (tangled) untangle_input(outcome.mesh, reference, options);
  if (options.attempts > 1) {
    outcome = best_of_attempts(outcome.mesh, reference, options, start);
  } else {
    detail::Run run(outcome.mesh, reference, options, start);
    if (from) run.go_on_from(*from);
    outcome.report = run.run();
  }
  if (tangled) outcome.report.before = measure_mesh(mesh);
  mesh = std::move(outcome.mesh);
  return outcome.report;
}

}  // namespace

SimplifyReport simplify(HexMesh& mesh, const SimplifyOptions& options) {
  return run_on(mesh, nullptr, options);
}

SimplifyReport resume_simplify(HexMesh& mesh, const Checkpoint& from,
                               const SimplifyOptions& options) {
  return run_on(mesh, &from, options);
}

}  // namespace hexweft
