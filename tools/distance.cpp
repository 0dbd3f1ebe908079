// hexweft-distance: how far two surfaces are from each other.
#include <fmt/format.h>

#include "optimize/hausdorff.h"
#include "tools/cli.h"
#include "tools/surface_input.h"

namespace hexweft {
namespace {

using Json = nlohmann::ordered_json;

struct Request {
  std::string a, b;
  HausdorffOptions options;
  double limit_rel = 0.01;
  int threads = 1;
};

std::string text_of(const Eigen::Vector3d& p) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x(), p.y(), p.z());
}

Json one_way(double distance, double diagonal, const Eigen::Vector3d& at,
             const ReferenceSurface& to) {
  const auto triple = [](const Eigen::Vector3d& p) { return Json{p.x(), p.y(), p.z()}; };
  return {{"distance", distance},
          {"ratio", distance / diagonal},
          {"at", triple(at)},
          {"closest", triple(to.closest(at).point)}};
}

int run(cli::Program& program, Request& request) {
  if (request.a == "-" && request.b == "-") throw InputError("only one of A and B can be -");
  const ReferenceSurface a = program.read_surface(request.a);
  const ReferenceSurface b = program.read_surface(request.b);
  HausdorffOptions& options = request.options;
  options.parallel = request.threads > 1;
  options.limit = request.limit_rel * b.bounding_box_diagonal();
  const HausdorffDistance d = hausdorff_distance(a, b, options);
  program.write_json({{"distance", d.distance()},
                      {"diagonal", d.diagonal},
                      {"ratio", d.ratio()},
                      {"forward", one_way(d.forward, d.diagonal, d.forward_at, b)},
                      {"backward", one_way(d.backward, d.diagonal, d.backward_at, a)}});
  if (program.wants_json()) return cli::kDone;
  const auto row = [&](const char* label, double distance, const std::string& where) {
    program.say(fmt::format("{:>16} {:>14.6g} {:>10.4f} %{}", label, distance,
                            100 * distance / d.diagonal, where));
  };
  row("from A to B", d.forward, "  at " + text_of(d.forward_at) + " of A");
  row("from B to A", d.backward, "  at " + text_of(d.backward_at) + " of B");
  row("both ways", d.distance(), "");
  program.say(fmt::format("{:>16} {:>14.6g}", "diagonal of B", d.diagonal));
  return cli::kDone;
}

}  // namespace
}  // namespace hexweft

int main(int argc, char** argv) {
  using namespace hexweft;
  cli::Program program("hexweft-distance",
                       "Measures the point-sampled Hausdorff distance of two surfaces, in model "
                       "units and as a fraction of the diagonal of B's bounding box.");
  Request request;
  CLI::App& app = program.app();
  app.add_option("A", request.a, std::string("First surface: ") + cli::kSurfaceHelp)->required();
  app.add_option("B", request.b, "Second surface, likewise; - is a mesh on standard input")
      ->required();
  app.add_option("--points-per-triangle", request.options.points_per_triangle,
                 "Look at no fewer points of every triangle; as many a triangle are spread over "
                 "the surface by area")
      ->check(cli::in_range(1, 1e6))
      ->capture_default_str();
  app.add_option("--limit", request.limit_rel,
                 "What the distance is held against, of the diagonal: it is told to a twentieth of "
                 "that, as far as it is over half of it")
      ->check(cli::in_range(1e-6, 1))
      ->capture_default_str();
  program.add_threads(request.threads);
  program.add_json();
  return program.run(argc, argv, [&] { return run(program, request); });
}
