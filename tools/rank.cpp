// hexweft-rank: what could be collapsed, in which order, and why the rest could not.
#include "simplify/rank_report.h"
#include "tools/cli.h"
#include "tools/ranking_arguments.h"

namespace hexweft {
namespace {

int run(cli::Program& program, const cli::RankingArguments& ranking, SimplifyOptions& options,
        int max_rows) {
  options.weights = ranking.weights();
  validate(options);
  const HexMesh mesh = program.read_valid_mesh();
  const RankReport report =
      report_ranking(mesh, extract_base_complex(mesh), options, ranking.ranking());
  program.write_json(report.json());
  if (!program.wants_json()) program.say_text(report.table(max_rows));
  return cli::kDone;
}

}  // namespace
}  // namespace hexweft

int main(int argc, char** argv) {
  using namespace hexweft;
  cli::Program program("hexweft-rank",
                       "Lists the sheets and chords of a mesh's base complex in the order in which "
                       "they would be collapsed, with the terms of their ranking, and says why the "
                       "others would not be tried.");
  cli::RankingArguments ranking;
  SimplifyOptions options;
  int max_rows = 20;
  CLI::App& app = program.app();
  program.add_input();
  program.add_json();
  app.add_option("--list", max_rows, "How many of each kind to print at most; the JSON has all")
      ->check(cli::in_range(0, 1e9))
      ->capture_default_str();
  ranking.add_to(app);
  cli::add_filter_options(app, options);
  return program.run(argc, argv, [&] { return run(program, ranking, options, max_rows); });
}
