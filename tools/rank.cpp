// hexweft-rank: what could be collapsed, in which order, and why the rest could not.
#include "simplify/feature_targets.h"
#include "simplify/rank_report.h"
#include "tools/cli.h"
#include "tools/ranking_arguments.h"
#include "tools/surface_input.h"

namespace hexweft {
namespace {

struct Request {
  cli::RankingArguments ranking;
  SimplifyOptions options;
  std::string features = "auto";
  int max_rows = 20;
};

int run(cli::Program& program, Request& request) {
  SimplifyOptions& options = request.options;
  options.weights = request.ranking.weights();
  options.features = cli::parse_features(request.features);
  validate(options);
  const HexMesh mesh = program.read_valid_mesh();
  const BaseComplex bc = extract_base_complex(mesh);
  const auto labels = feature_of(cli::boundary_of(mesh, options.features), mesh);
  const RankReport report = report_ranking(mesh, bc, base_edges_on_features(bc, labels), options,
                                           request.ranking.ranking());
  program.write_json(report.json());
  if (!program.wants_json()) program.say_text(report.table(request.max_rows));
  return cli::kDone;
}

}  // namespace
}  // namespace hexweft

int main(int argc, char** argv) {
  using namespace hexweft;
  cli::Program program(
      "hexweft-rank",
      "Lists the sheets and chords of a mesh's base complex in the order in which "
      "they would be collapsed, with the terms of their ranking, then the peels and the "
      "pillows that take the way free for sheets, and says why the others would not be "
      "tried.");
  Request request;
  CLI::App& app = program.app();
  program.add_input();
  program.add_json();
  app.add_option("--list", request.max_rows,
                 "How many of each kind to print at most; the JSON has all")
      ->check(cli::in_range(0, 1e9))
      ->capture_default_str();
  app.add_option("--features", request.features, cli::kFeaturesHelp)->capture_default_str();
  request.ranking.add_to(app);
  cli::add_filter_options(app, request.options);
  return program.run(argc, argv, [&] { return run(program, request); });
}
