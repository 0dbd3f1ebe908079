#include "simplify/progress.h"

#include <array>

#include <nlohmann/json.hpp>

namespace hexweft {

std::string_view name(StepKind kind) {
  static constexpr std::array<std::string_view, 10> names = {
      "start",      "sheet",      "chord",  "peel",      "pillow",
      "coarsening", "refinement", "relief", "smoothing", "back"};
  return names[static_cast<std::size_t>(kind)];
}

nlohmann::ordered_json to_json(const SimplifyProgress& p) {
  nlohmann::ordered_json j = {{"attempt", p.attempt}, {"step", p.step}, {"what", name(p.what)}};
  if (is_collapse(p.what)) {
    j["kind"] = p.kind;
    j["width"] = p.width;
  }
  if (const auto& t = p.sheet_terms) {
    j["energy"] = t->energy;
    j["valence_term"] = t->valence;
    j["width_term"] = t->width;
    j["distortion_term"] = t->distortion;
    j["thickness"] = t->thickness;
  }
  if (const auto& t = p.chord_terms) {
    j["energy"] = t->energy;
    j["valence_term"] = t->valence;
    j["geometry_term"] = t->geometry;
    j["thickness"] = t->thickness;
    j["deviation"] = t->deviation;
  }
  j["components"] = p.components;
  j["hexahedra"] = p.hexahedra;
  j["min_scaled_jacobian"] = p.min_scaled_jacobian;
  j["mean_scaled_jacobian"] = p.mean_scaled_jacobian;
  j["hausdorff_ratio"] = p.hausdorff_ratio;
  j["seconds"] = p.seconds;
  return j;
}

}  // namespace hexweft
