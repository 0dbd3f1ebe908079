// hexweft-simplify: the main job.
#include "simplify/simplify.h"

#include <iostream>
#include <stop_token>

#include <fmt/format.h>

#include "io/file.h"
#include "tools/checkpoint_file.h"
#include "tools/cli.h"
#include "tools/energy_argument.h"
#include "tools/progress_line.h"
#include "tools/ranking_arguments.h"
#include "tools/signal_watch.h"
#include "tools/step_log.h"
#include "tools/surface_input.h"

namespace hexweft {
namespace {

struct Request {
  SimplifyOptions options;
  cli::RankingArguments ranking;
  std::string energy = std::string(name(SimplifyOptions().parametrization.energy));
  std::string features = "auto";
  bool no_chords = false, no_peels = false, no_pillows = false;
  std::optional<double> max_seconds, target_rate;
  std::optional<int> target_components;
  std::string log, checkpoint, resume;
  bool profile = false;
};

void add_options(CLI::App& app, Request& r) {
  SimplifyOptions& o = r.options;
  app.add_option("--hausdorff", o.hausdorff_limit_rel,
                 "Largest distance to the input's surface, both ways, as a fraction of its "
                 "bounding-box diagonal")
      ->capture_default_str();
  app.add_option("--hexahedra-ratio", o.target_hexahedra_rel,
                 "Hexahedra to end with, relative to the input; below it sheets are split")
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
  app.add_option("--seconds", r.max_seconds,
                 "Begin nothing more after this long, the smoothing at the end neither");
  app.add_option(
         "--attempts", o.attempts,
         "Runs with slightly different weights, of which the simplest mesh is taken; as many "
         "at a time as there are threads")
      ->check(cli::in_range(1, 1000))
      ->capture_default_str();
  app.add_option("--compare", o.compare,
                 "Candidates that succeed to look at before the best of them is taken")
      ->check(cli::in_range(1, 1000))
      ->capture_default_str();
  app.add_flag("--no-chords", r.no_chords, "Collapse no chords");
  app.add_flag_callback(
      "--no-coarsening", [&o] { o.coarsen = false; },
      "Keep all layers of sheets that have several, though they could do without some for a while");
  app.add_flag("--no-peels", r.no_peels, "Take no sheets off single faces of the surface");
  app.add_flag("--no-pillows", r.no_pillows,
               "Put in no pillows beside what keeps a sheet from being collapsed");
  app.add_flag_callback(
      "--no-careful-trials", [&o] { o.careful.wanted = false; },
      "Do without the careful trials, which go first and ask for better hexahedra");
  app.add_flag_callback(
      "--no-bold-trials", [&o] { o.bold.wanted = false; },
      "Do without the bold trials, which may take away layers under the surface and split sheets");
  cli::add_energy_option(app, r.energy, "Distortion that is made small, in steps and at the end");
  app.add_option("--features", r.features, cli::kFeaturesHelp)->capture_default_str();
  r.ranking.add_to(app);
  cli::add_filter_options(app, o);
}

void add_run_options(CLI::App& app, Request& r) {
  app.add_option("--log", r.log, "Write a line of JSON for every step, as it happens")
      ->group("Run");
  app.add_flag("--profile", r.profile,
               "Say on standard error where the time went and how the trials ended")
      ->group("Run");
  app.add_option("--checkpoint", r.checkpoint,
                 "Keep in this file what --resume needs, now and then and at the end")
      ->group("Run");
  app.add_option("--checkpoint-every", r.options.checkpoint_every_s,
                 "Seconds between two checkpoints, at least")
      ->capture_default_str()
      ->group("Run");
  app.add_option("--resume", r.resume,
                 "Go on from this checkpoint of a run with the same INPUT and options; those that "
                 "end a run may be others")
      ->group("Run");
}

std::string text_of(const SimplifyProgress& p) {
  return fmt::format("{} steps  H {}  BC {} of {}  HR {:.2f} %  {:.1f} s", p.step, p.hexahedra,
                     p.components, p.input_components, 100 * p.hausdorff_ratio, p.seconds);
}

std::string text_of(const std::vector<AttemptFigures>& attempts) {
  std::string text = "components by attempt:";
  for (const AttemptFigures& a : attempts) text += fmt::format(" {}", a.components);
  return text;
}

void complete_options(Request& request) {
  SimplifyOptions& o = request.options;
  o.ranking = request.ranking.ranking();
  o.weights = request.ranking.weights();
  o.parametrization.energy = make_energy(request.energy);
  o.features = cli::parse_features(request.features);
  o.chords = !request.no_chords;
  o.peels = !request.no_peels;
  o.pillows = !request.no_pillows;
  o.max_seconds = request.max_seconds;
  o.target_rate = request.target_rate;
  o.target_components = request.target_components;
  for (const std::string* path : {&request.checkpoint, &request.resume}) {
    if (*path == "-") throw InputError("--checkpoint or --resume = -, expected a file");
  }
  validate(o);
}

// Says once that a file of the run's own is not written any more; the run is worth more than that.
class Lenient {
 public:
  explicit Lenient(const cli::Program& program) : program_(program) {}
  template <class F>
  void operator()(F&& write) {
    if (failed_) return;
    try {
      write();
    } catch (const FormatError& error) {
      failed_ = true;
      program_.note(std::string(error.what()) + "; the run goes on without");
    }
  }

 private:
  const cli::Program& program_;
  bool failed_ = false;
};

nlohmann::ordered_json last_line(const SimplifyReport& r) {
  return {{"what", "end"},
          {"stopped", name(r.stopped)},
          {"components", r.after.components},
          {"hexahedra", r.after.hexahedra},
          {"min_scaled_jacobian", r.after.min_scaled_jacobian},
          {"mean_scaled_jacobian", r.after.mean_scaled_jacobian},
          {"hausdorff_ratio", r.hausdorff_ratio},
          {"seconds", r.seconds}};
}

// What is written on the way takes the place of no other file of the run.
void check_files(cli::Program& program, const Request& request) {
  program.take_output("--log", request.log);
  program.expect_not_written("--resume", request.resume);  // but by --checkpoint
  program.take_output("--checkpoint", request.checkpoint);
}

SimplifyReport simplify_as_asked(cli::Program& program, Request& request, HexMesh& mesh) {
  SimplifyOptions& o = request.options;
  std::optional<Checkpoint> from;
  if (!request.resume.empty()) from = cli::CheckpointFile(request.resume, mesh, o).read();
  std::optional<cli::StepLog> log;
  if (!request.log.empty()) log.emplace(request.log, from.has_value());
  Lenient write_log(program), write_checkpoint(program);
  cli::ProgressLine line;
  if (line.on_terminal() || log) {
    o.observer = [&](const SimplifyProgress& p) {
      const std::string attempt = fmt::format("attempt {} of {}  ", p.attempt + 1, o.attempts);
      line.show((o.attempts > 1 ? attempt : "") + text_of(p));
      if (log) write_log([&] { log->write(to_json(p)); });
    };
  }
  if (!request.checkpoint.empty()) {
    check_writable(request.checkpoint);
    const cli::CheckpointFile file(request.checkpoint, mesh, o);
    o.checkpoint = [&write_checkpoint, file](const HexMesh& now, const RunState& state) {
      write_checkpoint([&] { file.write(now, state); });
    };
  }
  SimplifyReport report = from ? resume_simplify(mesh, *from, o) : simplify(mesh, o);
  if (log) write_log([&] { log->write(last_line(report)); });
  return report;
}

int run(cli::Program& program, Request& request) {
  complete_options(request);
  check_files(program, request);
  HexMesh mesh = program.read_mesh();
  std::stop_source interrupt;
  const cli::SignalWatch watch(interrupt);
  request.options.stop = interrupt.get_token();
  const SimplifyReport report = simplify_as_asked(program, request, mesh);
  program.write_mesh(mesh);
  program.write_json(report.json());
  program.say(report.brief());
  if (!report.attempts.empty()) program.say(text_of(report.attempts));
  if (request.profile) std::cerr << report.profile_table();
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
  add_run_options(program.app(), request);
  return program.run(argc, argv, [&] { return run(program, request); });
}
