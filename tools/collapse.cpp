// hexweft-collapse: collapses one sheet, with a pillow if need be, or one chord, or takes a sheet off one
// face of the surface.
#include <fmt/format.h>

#include "simplify/candidates.h"
#include "simplify/feature_targets.h"
#include "simplify/peel.h"
#include "simplify/pillow_search.h"
#include "simplify/pillowed_collapse.h"
#include "tools/ranking_arguments.h"
#include "tools/single_trial.h"

namespace hexweft {
namespace {

struct Request {
  cli::TrialArguments trial;
  std::optional<int> sheet, chord, peel, pillow;
  std::string diagonal;  // empty: the one that the ranking takes
};

template <class T>
const T& pick(const std::vector<T>& list, int id, const char* what) {
  if (id >= 0 && id < static_cast<int>(list.size())) return list[id];
  throw InputError(fmt::format("{} {} is none of the {} of this mesh, expected [0, {})", what, id,
                               list.size(), list.size()));
}

CollapsePlan plan_chord(const HexMesh& mesh, const BaseComplex& bc, const Request& request) {
  const std::vector<Chord> chords = extract_chords(bc);
  const std::vector<Sheet> sheets = extract_sheets(bc);
  const Chord& chord = pick(chords, *request.chord, "chord");
  if (const Refusal r = can_plan(bc, chord, sheets); r != Refusal::none) {
    throw std::runtime_error(
        fmt::format("chord {} cannot be collapsed: {}", *request.chord, cli::explain(r)));
  }
  Diagonal diagonal = request.diagonal == "second" ? Diagonal::second : Diagonal::first;
  if (request.diagonal.empty()) {
    diagonal =
        rank_chords(mesh, bc, {chord}, boundary_gaussian_curvature(mesh), {}).front().diagonal;
  }
  return plan_chord_collapse(mesh, bc, chord, diagonal, sheets);
}

// What was asked for, as people and the JSON report call it.
std::pair<const char*, int> chosen(const Request& r) {
  if (r.sheet.has_value() + r.chord.has_value() + r.peel.has_value() + r.pillow.has_value() != 1) {
    throw InputError("expected one of --sheet, --chord, --peel and --pillow");
  }
  if (r.sheet) return {"sheet", *r.sheet};
  if (r.chord) return {"chord", *r.chord};
  if (r.peel) return {"peel", *r.peel};
  return {"pillow", *r.pillow};
}

CollapsePlan plan_of(cli::SingleTrial& trial, const BaseComplex& bc, const Request& request) {
  const HexMesh& mesh = trial.mesh();
  if (request.chord) return plan_chord(mesh, bc, request);
  const std::vector<Sheet> sheets = extract_sheets(bc);
  if (request.sheet) return plan_sheet_collapse(mesh, bc, pick(sheets, *request.sheet, "sheet"));
  const auto on_feature = base_edges_on_features(bc, trial.context().feature_labels());
  return plan_peel(mesh, bc, pick(extract_peels(bc, sheets, on_feature), *request.peel, "peel"));
}

TrialResult carry_out(cli::SingleTrial& trial, const BaseComplex& bc, const Request& request) {
  const SimplifyOptions& options = request.trial.options;
  if (!request.pillow)
    return try_collapse(trial.context(), bc, plan_of(trial, bc, request), options);
  const std::vector<Sheet> sheets = extract_sheets(bc);
  const auto pillows = find_pillows(trial.mesh(), bc, sheets, options.valence);
  const PillowedSheet& chosen = pick(pillows, *request.pillow, "pillow");
  return try_pillowed_collapse(trial.context(), bc, sheets[chosen.sheet], chosen.pillow, options);
}

int run(cli::Program& program, const Request& request) {
  const auto [what, id] = chosen(request);
  cli::SingleTrial trial(program, request.trial);
  const BaseComplex bc = extract_base_complex(trial.mesh());
  if (bc.irregular > 0) {
    throw InputError(fmt::format("{} regions of the base complex are no cuboids", bc.irregular));
  }
  const auto before = trial.figures();
  const TrialResult result = carry_out(trial, bc, request);
  if (!result.accepted()) {
    return program.fail(cli::kFailed, fmt::format("{} {} cannot be collapsed: {}", what, id,
                                                  cli::explain(result.refusal)));
  }
  trial.mesh().collect_garbage();
  const auto after = trial.figures();
  program.write_mesh(trial.mesh());
  program.write_json({{what, id}, {"before", before}, {"after", after}});
  program.say_text(cli::compare(before, after));
  return cli::kDone;
}

}  // namespace
}  // namespace hexweft

int main(int argc, char** argv) {
  using namespace hexweft;
  cli::Program program("hexweft-collapse",
                       "Collapses one sheet or chord of the base complex, or takes a sheet off one "
                       "face of the surface, and relaxes the mesh round it. Writes nothing where "
                       "that would leave the mesh invalid or the surface too far away.");
  Request request;
  CLI::App& app = program.app();
  program.add_input();
  program.add_output();
  app.add_option("--sheet", request.sheet, "Id of a sheet, as hexweft-rank lists it");
  auto* chord = app.add_option("--chord", request.chord, "Id of a chord, likewise");
  app.add_option("--peel", request.peel,
                 "Id of a peel, likewise: what lies of a sheet under one face");
  app.add_option(
      "--pillow", request.pillow,
      "Id of a pillow, as hexweft-rank lists it with the same filters: it takes the way free for a "
      "sheet");
  app.add_option("--diagonal", request.diagonal,
                 "Diagonal along which the chord folds: first or second (default: the one that "
                 "leaves the smaller valence error)")
      ->needs(chord)
      ->check(CLI::IsMember({"first", "second"}));
  request.trial.add_to(app);
  app.add_option("--splits", request.trial.options.splits_per_trial,
                 "Sheets that may be split where the surface would be left too far away, two for "
                 "each layer that goes and two more at most")
      ->check(cli::in_range(0, 1e6))
      ->capture_default_str();
  cli::add_valence_options(app, request.trial.options.valence);
  program.add_json();
  return program.run(argc, argv, [&] { return run(program, request); });
}
