#include "tools/single_trial.h"

#include <fmt/format.h>

#include "optimize/hausdorff.h"
#include "ovm/quality.h"
#include "simplify/report.h"
#include "tools/surface_input.h"

namespace hexweft::cli {
namespace {

HexMesh read_checked(Program& program, const TrialArguments& arguments) {
  validate(arguments.options);
  if (arguments.surface == "-") throw InputError("--surface = -, expected a file");
  HexMesh mesh = program.read_valid_mesh();
  for (const CellHandle c : mesh.cells()) {
    const double sj = scaled_jacobian(mesh, c);
    if (sj > 0) continue;
    throw InputError(fmt::format("cell {} has scaled Jacobian {:.4g}, expected > 0", c.idx, sj));
  }
  return mesh;
}

}  // namespace

void TrialArguments::add_to(CLI::App& app) {
  app.add_option(
      "--surface", surface,
      std::string("Surface to stay on (default: the boundary of INPUT): ") + kSurfaceHelp);
  app.add_option("--features", features, kFeaturesHelp)->capture_default_str();
  app.add_option("--hausdorff", options.hausdorff_limit_rel,
                 "Largest distance to the surface, both ways, as a fraction of its bounding-box "
                 "diagonal")
      ->capture_default_str();
  app.add_option("--min-scaled-jacobian", options.min_scaled_jacobian,
                 "The change may not leave its region below this (or what it found, if less)")
      ->capture_default_str();
  app.add_option("--mean-scaled-jacobian", options.mean_scaled_jacobian,
                 "The same for the mean over the region")
      ->capture_default_str();
  app.add_option("--rings", options.rings, "Rings of hexahedra round the change that move")
      ->check(in_range(1, 1000))
      ->capture_default_str();
}

SingleTrial::SingleTrial(Program& program, const TrialArguments& arguments)
    : mesh_(read_checked(program, arguments)),
      surface_(arguments.surface.empty()
                   ? boundary_of(mesh_, parse_features(arguments.features))
                   : program.read_surface(arguments.surface, parse_features(arguments.features))),
      distance_(mesh_, surface_),
      context_{mesh_,
               surface_,
               distance_,
               summarize_topology(mesh_),
               arguments.options.hausdorff_limit_rel * surface_.bounding_box_diagonal(),
               arguments.options.hausdorff_limit_rel * surface_.bounding_box_diagonal()} {}

nlohmann::ordered_json SingleTrial::figures() const {
  const MeshFigures f = measure_mesh(mesh_);
  const double limit_rel = context_.final_limit / surface_.bounding_box_diagonal();
  return {{"hexahedra", f.hexahedra},
          {"components", f.components},
          {"min_scaled_jacobian", f.min_scaled_jacobian},
          {"mean_scaled_jacobian", f.mean_scaled_jacobian},
          {"inverted", f.inverted},
          {"hausdorff_ratio", hausdorff_ratio(mesh_, surface_, limit_rel)}};
}

std::string compare(const nlohmann::ordered_json& before, const nlohmann::ordered_json& after) {
  const auto text = [](const nlohmann::ordered_json& x) {
    return x.is_number_float() ? fmt::format("{:.5f}", x.get<double>()) : x.dump();
  };
  std::string s = fmt::format("{:>22} {:>10} {:>10}\n", "", "before", "after");
  for (const auto& [key, value] : before.items()) {
    s += fmt::format("{:>22} {:>10} {:>10}\n", key, text(value), text(after.at(key)));
  }
  return s;
}

std::string explain(Refusal refusal) {
  switch (refusal) {
    case Refusal::none:
      return "nothing is against it";
    case Refusal::valence:
      return "an edge would have too few or too many hexahedra";
    case Refusal::angle:
      return "a single hexahedron would have to fill a wide angle of the boundary";
    case Refusal::boundary:
      return "two different stretches of the boundary would be glued";
    case Refusal::feature:
      return "two features of the surface would be merged";
    case Refusal::degenerate_cell:
      return "a hexahedron that stays would lose an edge";
    case Refusal::unequal_sides:
      return "the sides of its cross-section have different counts of hexahedra";
    case Refusal::twisted:
      return "its diagonals fall together or it crosses itself";
    case Refusal::not_singular:
      return "it would remove no singular edge";
    case Refusal::vanishing:
      return "nothing, or a whole part, would be left of the mesh";
    case Refusal::topology:
      return "the mesh would not be a manifold, or of another genus or number of parts";
    case Refusal::structure:
      return "there would be no fewer components, or one that is no cuboid";
    case Refusal::inverted:
      return "no parametrization without inverted hexahedra was found";
    case Refusal::quality:
      return "the scaled Jacobian would fall below its limit";
    case Refusal::hausdorff:
      return "the boundary would leave the surface by more than the limit";
  }
  return "it was refused";
}

}  // namespace hexweft::cli
