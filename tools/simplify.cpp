// hexweft-simplify: the main job.
#include "simplify/simplify.h"

#include <stop_token>

#include <fmt/format.h>

#include "tools/cli.h"
#include "tools/progress_line.h"
#include "tools/ranking_arguments.h"
#include "tools/signal_watch.h"
#include "tools/surface_input.h"

namespace hexweft {
namespace {

struct Request {
  SimplifyOptions options;
  cli::RankingArguments ranking;
  std::string features = "auto";
  bool no_chords = false;
  std::optional<double> max_seconds, target_rate;
  std::optional<int> target_components;
};

void add_options(CLI::App& app, Request& r) {
  SimplifyOptions& o = r.options;
  app.add_option("--hausdorff", o.hausdorff_limit_rel,
                 "Largest distance to the input's surface, both ways, as a fraction of its "
                 "bounding-box diagonal")
      ->capture_default_str();
  app.add_option("--hexahedra", o.target_hexahedra_rel,
                 "Hexahedra to keep, relative to the input; below it sheets are split")
      ->capture_default_str();
  app.add_option("--min-scaled-jacobian", o.min_scaled_jacobian,
                 "A step may not leave its region below this (or what it found, if less)")
      ->capture_default_str();
  app.add_option("--mean-scaled-jacobian", o.mean_scaled_jacobian,
                 "The same for the mean over the region")
      ->capture_default_str();
  app.add_option("--rate", r.target_rate,
                 "Stop at this simplification rate 1 - BC/BC_in, in [0, 1]");
  app.add_option("--components", r.target_components, "Stop at this many components");
  app.add_option("--seconds", r.max_seconds, "Stop collapsing after this long");
  app.add_flag("--no-chords", r.no_chords, "Collapse sheets only");
  app.add_option("--features", r.features, cli::kFeaturesHelp)->capture_default_str();
  r.ranking.add_to(app);
  cli::add_filter_options(app, o);
}

std::string text_of(const SimplifyProgress& p) {
  return fmt::format("{} steps  H {}  BC {} of {}  HR {:.2f} %  {:.1f} s", p.step, p.hexahedra,
                     p.components, p.input_components, 100 * p.hausdorff_ratio, p.seconds);
}

int run(cli::Program& program, Request& request) {
  SimplifyOptions& o = request.options;
  o.ranking = request.ranking.ranking();
  o.weights = request.ranking.weights();
  o.features = cli::parse_features(request.features);
  o.chords = !request.no_chords;
  o.max_seconds = request.max_seconds;
  o.target_rate = request.target_rate;
  o.target_components = request.target_components;
  validate(o);
  HexMesh mesh = program.read_mesh();
  std::stop_source interrupt;
  const cli::SignalWatch watch(interrupt);
  cli::ProgressLine line;
  o.stop = interrupt.get_token();
  o.observer = [&line](const SimplifyProgress& p) { line.show(text_of(p)); };
  const SimplifyReport report = simplify(mesh, o);
  line.clear();
  program.write_mesh(mesh);
  program.write_json(report.json());
  program.say(report.brief());
  if (report.stopped == StopReason::interrupted)
    program.say("interrupted: this is the mesh so far");
  return cli::kDone;
}

}  // namespace
}  // namespace hexweft

int main(int argc, char** argv) {
  using namespace hexweft;
  cli::Program program("hexweft-simplify",
                       "Removes needless singular edges: collapses base-complex sheets and chords "
                       "until the mesh is as simple as its surface allows.");
  Request request;
  program.add_input();
  program.add_output();
  program.add_json();
  program.add_threads(request.options.threads);
  add_options(program.app(), request);
  return program.run(argc, argv, [&] { return run(program, request); });
}
