// hexweft-optimize: better geometry, the same structure.
#include <fmt/format.h>

#include "optimize/hausdorff.h"
#include "optimize/smooth.h"
#include "optimize/untangle.h"
#include "ovm/quality.h"
#include "tools/cli.h"
#include "tools/energy_argument.h"
#include "tools/progress_line.h"
#include "tools/single_trial.h"
#include "tools/surface_input.h"

namespace hexweft {
namespace {

using Json = nlohmann::ordered_json;

struct Request {
  SmoothingOptions options = {.hausdorff_limit_rel = 0.005};
  std::string energy = std::string(name(SmoothingOptions().parametrization.energy));
  std::string surface, features = "auto";
  bool untangle = false;
};

Json to_json(const QualitySummary& q, double hausdorff_ratio) {
  return {{"min_scaled_jacobian", q.min_scaled_jacobian},
          {"mean_scaled_jacobian", q.mean_scaled_jacobian},
          {"std_scaled_jacobian", q.std_scaled_jacobian},
          {"mean_volume_deviation", q.mean_volume_deviation},
          {"max_volume_deviation", q.max_volume_deviation},
          {"inverted", q.n_inverted},
          {"hausdorff_ratio", hausdorff_ratio}};
}

void add_options(CLI::App& app, Request& request) {
  SmoothingOptions& o = request.options;
  cli::add_energy_option(app, request.energy, "Distortion that is made small");
  app.add_option(
      "--surface", request.surface,
      std::string("Surface to stay on (default: the boundary of INPUT): ") + cli::kSurfaceHelp);
  app.add_option("--features", request.features, cli::kFeaturesHelp)->capture_default_str();
  app.add_option("--hausdorff", o.hausdorff_limit_rel,
                 "Largest distance to the surface, both ways, as a fraction of its bounding-box "
                 "diagonal; where INPUT is farther, no farther than that")
      ->capture_default_str();
  app.add_flag(
      "--untangle", request.untangle,
      "Only make inverted hexahedra valid, whatever the distance; a mesh without any comes "
      "back as it is");
  app.add_option("--cycles", o.cycles,
                 "How often all of the following is done at most; again only if it gained")
      ->check(cli::in_range(1, 1e6))
      ->capture_default_str();
  app.add_option("--iterations", o.global_rounds,
                 "Passes over the whole mesh for its worst hexahedra at most")
      ->check(cli::in_range(0, 1e6))
      ->capture_default_str();
  app.add_option("--mean-iterations", o.mean_rounds, "The same for the average, at the end")
      ->check(cli::in_range(0, 1e6))
      ->capture_default_str();
  app.add_option("--local-trials", o.local_trials,
                 "Passes over the neighbourhoods of the worst hexahedra at most")
      ->check(cli::in_range(0, 1e6))
      ->capture_default_str();
  app.add_option("--enough-scaled-jacobian", o.enough_scaled_jacobian,
                 "Hexahedra at least this good are not worked on one by one")
      ->capture_default_str();
}

int run(cli::Program& program, Request& request) {
  request.options.parametrization.energy = make_energy(request.energy);
  validate(request.options);
  const FeatureOptions features = cli::parse_features(request.features);
  if (request.surface == "-") throw InputError("--surface = -, expected a file");
  HexMesh mesh = program.read_valid_mesh();
  const ReferenceSurface surface = request.surface.empty()
                                       ? cli::boundary_of(mesh, features)
                                       : program.read_surface(request.surface, features);
  const QualitySummary before = summarize_quality(mesh, 0);
  double hausdorff_before = 0, hausdorff_after = 0;
  Json report = {{"energy", request.energy}};
  {
    const cli::BusyLine busy(request.untangle ? "untangling" : "optimizing");
    if (request.untangle) {
      hausdorff_before = hausdorff_ratio(mesh, surface, request.options.hausdorff_limit_rel);
      untangle(mesh, surface, request.options.parametrization, request.options.global_rounds);
      hausdorff_after = hausdorff_ratio(mesh, surface, request.options.hausdorff_limit_rel);
    } else {
      const SmoothingReport r = smooth(mesh, surface, request.options);
      hausdorff_before = r.initial_hausdorff_rel;
      hausdorff_after = r.hausdorff_rel;
      report["trials"] = r.trials;
      report["accepted"] = r.accepted_global + r.accepted_local;
    }
  }
  const QualitySummary after = summarize_quality(mesh, 0);
  report["before"] = to_json(before, hausdorff_before);
  report["after"] = to_json(after, hausdorff_after);
  if (after.n_inverted == 0) program.write_mesh(mesh);
  program.write_json(report);
  program.say_text(cli::compare(report["before"], report["after"]));
  if (after.n_inverted == 0) return cli::kDone;
  return program.fail(
      cli::kFailed,
      fmt::format("{} hexahedra are still inverted: no mesh is written", after.n_inverted));
}

}  // namespace
}  // namespace hexweft

int main(int argc, char** argv) {
  using namespace hexweft;
  cli::Program program("hexweft-optimize",
                       "Moves the vertices of a hexahedral mesh so that its worst and its average "
                       "hexahedra get better, and inverted ones valid, on the same surface. The "
                       "structure stays.");
  Request request;
  program.add_input();
  program.add_output();
  add_options(program.app(), request);
  program.add_json();
  return program.run(argc, argv, [&] { return run(program, request); });
}
