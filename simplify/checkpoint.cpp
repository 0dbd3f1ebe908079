#include "simplify/checkpoint.h"

#include <bit>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "ovm/detail/fnv.h"
#include "ovm/errors.h"
#include "simplify/options.h"

namespace hexweft {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const RankingWeights& w) {
  return {{"k_valence", w.k_valence},
          {"k_width", w.k_width},
          {"k_distortion", w.k_distortion},
          {"beta", w.beta},
          {"min_width", w.min_width},
          {"mean_width", w.mean_width},
          {"distortion_threshold", w.distortion_threshold}};
}

Json to_json(const ValenceLimits& v) {
  return {{"min_interior", v.min_interior},
          {"max_interior", v.max_interior},
          {"max_boundary", v.max_boundary},
          {"max_angle_deg", v.max_angle_deg}};
}

Json to_json(const CarefulTrials& t) {
  return {{"wanted", t.wanted},
          {"min_scaled_jacobian", t.min_scaled_jacobian},
          {"mean_scaled_jacobian", t.mean_scaled_jacobian}};
}

Json to_json(const BoldTrials& r) {
  return {{"wanted", r.wanted},
          {"max_angle_deg", r.max_angle_deg},
          {"max_interior_valence", r.max_interior_valence},
          {"splits_per_trial", r.splits_per_trial},
          {"merged_give_up_factor", r.merged_give_up_factor},
          {"max_chord_deviation", r.max_chord_deviation}};
}

Json to_json(const SurfaceOptions& s) {
  return {{"treatment", static_cast<int>(s.treatment)},
          {"feature_angle_deg", s.feature_angle_deg},
          {"weight", s.weight}};
}

Json to_json(const TargetShapeOptions& t) {
  return {{"size_blend", t.size_blend},
          {"blend_passes", t.blend_passes},
          {"least_length_rel", t.least_length_rel}};
}

Json to_json(const ParametrizationOptions& p) {
  return {{"energy", name(p.energy)},
          {"max_iterations", p.max_iterations},
          {"relaxation_iterations", p.relaxation_iterations},
          {"untangling_rounds", p.untangling_rounds},
          {"untangle_widely", p.untangle_widely},
          {"quality_goal", p.quality_goal},
          {"quality_exponent", p.quality_exponent},
          {"quality_weight_limit", p.quality_weight_limit},
          {"least_on_projection", p.least_on_projection},
          {"goal_weight", p.goal_weight},
          {"surface", to_json(p.surface)},
          {"target", to_json(p.target)}};
}

Profile profile_of(const Json& j) {
  if (!j.is_object()) throw InputError("profile = " + j.dump() + ", expected an object");
  Profile profile;
  for (int i = 0; i < kStages; ++i) {
    const auto entry = j.find(std::string(name(static_cast<Stage>(i))));
    if (entry == j.end()) continue;
    profile.stages[i] = {entry->at("seconds").get<double>(), entry->at("entered").get<int>()};
  }
  return profile;
}

}  // namespace

Json to_json(const RunState& s) {
  return {{"step", s.step},
          {"smoothed", s.smoothed},
          {"distance_share", s.distance_share},
          {"target_cells", s.target_cells},
          {"sheets", to_json(s.sheets)},
          {"chords", to_json(s.chords)},
          {"peels", to_json(s.peels)},
          {"pillows", to_json(s.pillows)},
          {"coarsened", s.coarsened},
          {"refined", s.refined},
          {"refinement_failed", s.refinement_failed},
          {"seconds", s.seconds},
          {"profile", s.profile.json()}};
}

RunState run_state(const Json& j) {
  RunState s;
  try {
    s.step = j.at("step").get<int>();
    s.smoothed = j.at("smoothed").get<bool>();
    s.distance_share = j.at("distance_share").get<double>();
    s.target_cells = j.at("target_cells").get<double>();
    s.sheets = trial_counts(j.at("sheets"));
    s.chords = trial_counts(j.at("chords"));
    s.peels = trial_counts(j.at("peels"));
    s.pillows = trial_counts(j.at("pillows"));
    s.coarsened = j.at("coarsened").get<int>();
    s.refined = j.at("refined").get<int>();
    s.refinement_failed = j.at("refinement_failed").get<int>();
    s.seconds = j.at("seconds").get<double>();
    s.profile = profile_of(j.at("profile"));
  } catch (const nlohmann::json::exception& error) {
    throw InputError(std::string("the state of the run cannot be read: ") + error.what());
  }
  if (s.step < 0 || !(s.distance_share > 0 && s.distance_share <= 1) || !(s.target_cells > 0)) {
    throw InputError(fmt::format(
        "step = {}, distance_share = {}, target_cells = {}, expected >= 0, (0, 1] and > 0", s.step,
        s.distance_share, s.target_cells));
  }
  return s;
}

std::uint64_t fingerprint(const HexMesh& mesh) {
  detail::Fnv hash;
  std::vector<int> position(mesh.vertex_slots(), -1);
  int n = 0;
  for (const VertexHandle v : mesh.vertices()) {
    position[v.idx] = n++;
    for (const double x : mesh.point(v)) hash.take_bytes(std::bit_cast<std::uint64_t>(x));
  }
  for (const CellHandle c : mesh.cells()) {
    for (const VertexHandle v : mesh.vertices(c))
      hash.take_bytes(static_cast<std::uint64_t>(position[v.idx]));
  }
  return hash.value();
}

Json lasting_options(const SimplifyOptions& o) {
  return {{"ranking", name(o.ranking)},
          {"weights", to_json(o.weights)},
          {"chords", o.chords},
          {"coarsen", o.coarsen},
          {"peels", o.peels},
          {"pillows", o.pillows},
          {"compare", o.compare},
          {"hausdorff_limit_rel", o.hausdorff_limit_rel},
          {"min_scaled_jacobian", o.min_scaled_jacobian},
          {"mean_scaled_jacobian", o.mean_scaled_jacobian},
          {"target_hexahedra_rel", o.target_hexahedra_rel},
          {"rings", o.rings},
          {"give_up_factor", o.give_up_factor},
          {"merged_give_up_factor", o.merged_give_up_factor},
          {"splits_per_trial", o.splits_per_trial},
          {"max_chord_deviation", o.max_chord_deviation},
          {"valence", to_json(o.valence)},
          {"careful", to_json(o.careful)},
          {"bold", to_json(o.bold)},
          {"features", static_cast<int>(o.features.mode)},
          {"feature_angle_deg", o.features.angle_deg},
          {"parametrization", to_json(o.parametrization)},
          {"max_failed_trials", o.max_failed_trials},
          {"smooth", o.smooth},
          {"smoothing_trials", o.smoothing_trials}};
}

}  // namespace hexweft
