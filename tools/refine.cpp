// hexweft-refine: splits one sheet, or as many as a number of hexahedra takes.
#include "simplify/refine.h"

#include <algorithm>

#include <fmt/format.h>

#include "simplify/sheet.h"
#include "tools/progress_line.h"
#include "tools/single_trial.h"

namespace hexweft {
namespace {

struct Request {
  cli::TrialArguments trial;
  std::optional<int> sheet, hexahedra;
  double min_length_rel = 0;
};

// Splits every hexahedron of a base-complex sheet across it, layer by layer.
// \return layers split
int split_layers(cli::SingleTrial& trial, int id, const SimplifyOptions& options) {
  HexMesh& mesh = trial.mesh();
  const BaseComplex bc = extract_base_complex(mesh);
  const std::vector<Sheet> sheets = extract_sheets(bc);
  if (id < 0 || id >= static_cast<int>(sheets.size())) {
    throw InputError(fmt::format("sheet {} is none of the {} of this mesh, expected [0, {})", id,
                                 sheets.size(), sheets.size()));
  }
  const auto chain = bc.chain(bc.edges[sheets[id].edges.front()]);
  std::vector<EdgeHandle> across;
  for (std::size_t i = 1; i < chain.size(); ++i) {
    across.push_back(mesh.find_edge(chain[i - 1], chain[i]));
  }
  int n = 0;
  for (const EdgeHandle e : across) {
    if (!mesh.is_live(e)) continue;  // of a layer that was split already: the sheet winds
    if (!try_refine(trial.context(), dual_sheet(mesh, e), options)) {
      throw std::runtime_error(fmt::format(
          "layer {} of sheet {} cannot be split within the limits of quality and distance", n, id));
    }
    ++n;
  }
  return n;
}

// Splits the first sheet that can be. \return whether there is one
bool split_one(cli::SingleTrial& trial, const Request& request) {
  HexMesh& mesh = trial.mesh();
  const auto split_first = [&](RefineOptions refine) {
    refine.max_cells = static_cast<int>(1.5 * (*request.hexahedra - mesh.n_cells()));
    const auto order = list_sheets_to_refine(mesh, trial.distance(), refine);
    return std::any_of(order.begin(), order.end(), [&](EdgeHandle e) {
      return try_refine(trial.context(), dual_sheet(mesh, e), request.trial.options);
    });
  };
  // What is short and far from the surface stays so however often it is split.
  constexpr double kLong = 1;
  const double least = request.min_length_rel;
  return split_first({.min_length_rel = std::max(least, kLong)}) ||
         (least < kLong && split_first({.min_length_rel = least, .by_distance = kAllSheets}));
}

// Splits sheets until there are so many hexahedra or none qualifies. \return sheets split
int split_up_to(cli::SingleTrial& trial, const Request& request) {
  cli::ProgressLine line;
  int n = 0;
  while (trial.mesh().n_cells() < *request.hexahedra && split_one(trial, request))
    line.show(fmt::format("{} sheets split  H {}", ++n, trial.mesh().n_cells()));
  return n;
}

// The trials look at fewer points than this.
void expect_within(const nlohmann::ordered_json& before, const nlohmann::ordered_json& after,
                   double limit) {
  const double was = before.at("hausdorff_ratio").get<double>(),
               is = after.at("hausdorff_ratio").get<double>();
  if (is <= std::max(was, limit)) return;
  throw std::runtime_error(
      fmt::format("so many hexahedra would be {:.4g} of its diagonal off the surface, expected at "
                  "most {:.4g}",
                  is, std::max(was, limit)));
}

int run(cli::Program& program, const Request& request) {
  if (!request.sheet && !request.hexahedra)
    throw InputError("expected one of --sheet and --hexahedra");
  cli::SingleTrial trial(program, request.trial);
  const auto before = trial.figures();
  if (const int n_cells = trial.mesh().n_cells(); request.hexahedra.value_or(n_cells) < n_cells)
    program.note(fmt::format("nothing is split: there are {} hexahedra already", n_cells));
  const int n = request.sheet ? split_layers(trial, *request.sheet, request.trial.options)
                              : split_up_to(trial, request);
  trial.mesh().collect_garbage();
  const auto after = trial.figures();
  expect_within(before, after, request.trial.options.hausdorff_limit_rel);
  program.write_mesh(trial.mesh());
  program.write_json({{"split", n}, {"before", before}, {"after", after}});
  program.say_text(cli::compare(before, after));
  if (request.hexahedra && trial.mesh().n_cells() < *request.hexahedra) {
    program.note(
        "no other sheet can be split without going far beyond the count that is asked for");
  }
  return cli::kDone;
}

}  // namespace
}  // namespace hexweft

int main(int argc, char** argv) {
  using namespace hexweft;
  cli::Program program(
      "hexweft-refine",
      "Splits the hexahedra of a sheet in two across it. The base complex stays as "
      "it is; new vertices of the boundary come onto the surface.");
  Request request;
  CLI::App& app = program.app();
  program.add_input();
  program.add_output();
  auto* sheet = app.add_option(
      "--sheet", request.sheet,
      "Split all layers of this sheet of the base complex, as hexweft-rank lists it");
  auto* hexahedra =
      app.add_option("--hexahedra", request.hexahedra,
                     "Split layers, those farthest from the surface or longest across first, up to "
                     "about this many hexahedra")
          ->excludes(sheet)
          ->check(cli::in_range(1, 1e9));
  app.add_option("--min-length", request.min_length_rel,
                 "With --hexahedra: split no layer whose mean length across is below this many "
                 "mean edges")
      ->needs(hexahedra)
      ->check(cli::in_range(0, 1e6))
      ->capture_default_str();
  request.trial.add_to(app);
  program.add_json();
  return program.run(argc, argv, [&] { return run(program, request); });
}
