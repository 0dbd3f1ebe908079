// hexweft-simplify: the main job.
#include "simplify/simplify.h"

#include <atomic>
#include <csignal>
#include <iostream>
#include <stop_token>
#include <thread>
#include <unistd.h>

#include <fmt/format.h>

#include "tools/cli.h"

namespace hexweft {
namespace {

std::atomic<int> signal_received = 0;
static_assert(std::atomic<int>::is_always_lock_free);

// A second signal ends the program the usual way.
extern "C" void remember_signal(int signal) {
  signal_received = signal;
  std::signal(signal, SIG_DFL);
}

struct Request {
  SimplifyOptions options;
  std::string preset = "octree";
  bool no_chords = false;
  std::optional<double> max_seconds, target_rate;
  std::optional<int> target_components;
};

void add_options(CLI::App& app, Request& r) {
  SimplifyOptions& o = r.options;
  app.add_option("--preset", r.preset, "Weights of the ranking: octree or polycube meshes")
      ->check(CLI::IsMember({"octree", "polycube"}))
      ->capture_default_str();
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
}

// One line that is written over, on a terminal only.
class ProgressLine {
 public:
  ProgressLine() : shown_(isatty(STDERR_FILENO) != 0) {}
  ~ProgressLine() { clear(); }
  void show(const SimplifyProgress& p) {
    if (!shown_) return;
    std::cerr << fmt::format("\r\033[K{} steps  H {}  BC {} of {}  HR {:.2f} %  {:.1f} s", p.step,
                             p.hexahedra, p.components, p.input_components, 100 * p.hausdorff_ratio,
                             p.seconds)
              << std::flush;
    dirty_ = true;
  }
  void clear() {
    if (dirty_) std::cerr << "\r\033[K" << std::flush;
    dirty_ = false;
  }

 private:
  bool shown_, dirty_ = false;
};

// Turns the signal, which a handler may only note down, into a stop request.
class SignalWatch {
 public:
  explicit SignalWatch(std::stop_source source)
      : thread_([source](const std::stop_token& end) mutable {
          while (!end.stop_requested()) {
            if (signal_received != 0) source.request_stop();
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
          }
        }) {
    std::signal(SIGINT, remember_signal);
    std::signal(SIGTERM, remember_signal);
  }

 private:
  std::jthread thread_;
};

int run(cli::Program& program, Request& request) {
  SimplifyOptions& o = request.options;
  if (request.preset == "polycube") o.weights = polycube_weights();
  o.chords = !request.no_chords;
  o.max_seconds = request.max_seconds;
  o.target_rate = request.target_rate;
  o.target_components = request.target_components;
  validate(o);
  HexMesh mesh = program.read_mesh();
  std::stop_source interrupt;
  const SignalWatch watch(interrupt);
  ProgressLine line;
  o.stop = interrupt.get_token();
  o.observer = [&line](const SimplifyProgress& p) { line.show(p); };
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
