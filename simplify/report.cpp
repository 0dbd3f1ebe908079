#include "simplify/report.h"

#include <numeric>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "ovm/quality.h"
#include "ovm/topology_summary.h"
#include "simplify/base_complex.h"

namespace hexweft {

MeshFigures measure_mesh(const HexMesh& mesh) {
  MeshFigures f;
  const TopologySummary t = summarize_topology(mesh);
  const QualitySummary q = summarize_quality(mesh, 0);
  const BaseComplex bc = extract_base_complex(mesh);
  f.vertices = t.n_vertices;
  f.hexahedra = t.n_cells;
  f.base_vertices = static_cast<int>(bc.vertices.size());
  f.base_edges = static_cast<int>(bc.edges.size());
  f.base_faces = static_cast<int>(bc.faces.size());
  f.components = static_cast<int>(bc.components.size()) + bc.irregular;
  f.min_scaled_jacobian = q.min_scaled_jacobian;
  f.mean_scaled_jacobian = q.mean_scaled_jacobian;
  f.std_scaled_jacobian = q.std_scaled_jacobian;
  f.mean_volume_deviation = q.mean_volume_deviation;
  f.max_volume_deviation = q.max_volume_deviation;
  f.inverted = q.n_inverted;
  f.genus = t.genus;
  f.parts = t.n_parts;
  return f;
}

std::string_view name(StopReason reason) {
  static constexpr std::array<std::string_view, 5> names = {
      "nothing_left", "no_progress", "target_reached", "out_of_time", "interrupted"};
  return names[static_cast<std::size_t>(reason)];
}

namespace {

std::string_view in_words(StopReason reason) {
  switch (reason) {
    case StopReason::nothing_left:
      return "no candidate is left";
    case StopReason::no_progress:
      return "too many trials failed in a row";
    case StopReason::target_reached:
      return "what was asked for is reached";
    case StopReason::out_of_time:
      return "the time is over";
    case StopReason::interrupted:
      break;
  }
  return "interrupted: this is the mesh so far";
}

}  // namespace

std::string SimplifyReport::brief() const {
  std::string s = fmt::format("{:>12} {:>10} {:>10}\n", "", "before", "after");
  const auto row = [&](const char* label, auto a, auto b, const char* format) {
    s += fmt::format("{:>12} {:>10} {:>10}\n", label, fmt::format(fmt::runtime(format), a),
                     fmt::format(fmt::runtime(format), b));
  };
  row("H", before.hexahedra, after.hexahedra, "{}");
  row("BC", before.components, after.components, "{}");
  row("R", 0.0, rate(), "{:.4f}");
  row("MSJ", before.min_scaled_jacobian, after.min_scaled_jacobian, "{:.4f}");
  row("ASJ", before.mean_scaled_jacobian, after.mean_scaled_jacobian, "{:.4f}");
  row("HR %", 0.0, 100 * hausdorff_ratio, "{:.3f}");
  row("time s", 0.0, seconds, "{:.2f}");
  return s + fmt::format("{:>12}  {}\n", "stopped", in_words(stopped));
}

namespace {

nlohmann::ordered_json to_json(const MeshFigures& f) {
  return {{"vertices", f.vertices},
          {"hexahedra", f.hexahedra},
          {"base_vertices", f.base_vertices},
          {"base_edges", f.base_edges},
          {"base_faces", f.base_faces},
          {"components", f.components},
          {"min_scaled_jacobian", f.min_scaled_jacobian},
          {"mean_scaled_jacobian", f.mean_scaled_jacobian},
          {"std_scaled_jacobian", f.std_scaled_jacobian},
          {"mean_volume_deviation", f.mean_volume_deviation},
          {"max_volume_deviation", f.max_volume_deviation},
          {"inverted", f.inverted},
          {"genus", f.genus},
          {"parts", f.parts}};
}

std::string_view fate(int refusal) {
  return refusal == 0 ? "accepted" : name(static_cast<Refusal>(refusal));
}

std::string fates(const char* what, const TrialCounts& c) {
  std::string s = fmt::format("{:>16} {:>9} {:>9}\n", what, "seconds", "trials");
  for (int r = 0; r < kRefusals; ++r) {
    const int n = r == 0 ? c.accepted : c.refused[r];
    if (n > 0) s += fmt::format("{:>16} {:>9.3f} {:>9}\n", fate(r), c.seconds[r], n);
  }
  return s + fmt::format("{:>16} {:>9} {:>9}\n", "waited", "", c.waited);
}

}  // namespace

int TrialCounts::tried() const { return std::accumulate(refused.begin(), refused.end(), accepted); }

nlohmann::ordered_json to_json(const TrialCounts& c) {
  nlohmann::ordered_json j = {{"tried", c.tried()}, {"accepted", c.accepted}};
  j["refused"] = nlohmann::ordered_json::object();
  for (int r = 1; r < kRefusals; ++r) {
    if (c.refused[r] > 0) j["refused"][fate(r)] = c.refused[r];
  }
  j["waited"] = c.waited;
  j["seconds"] = nlohmann::ordered_json::object();
  for (int r = 0; r < kRefusals; ++r) {
    if (c.seconds[r] > 0) j["seconds"][fate(r)] = c.seconds[r];
  }
  return j;
}

TrialCounts trial_counts(const nlohmann::ordered_json& j) {
  TrialCounts c;
  c.accepted = j.at("accepted").get<int>();
  c.waited = j.at("waited").get<int>();
  const auto none = nlohmann::ordered_json::object();
  const auto refused = j.value("refused", none), seconds = j.value("seconds", none);
  for (int r = 0; r < kRefusals; ++r) {
    const std::string key(fate(r));
    if (r > 0) c.refused[r] = refused.value(key, 0);
    c.seconds[r] = seconds.value(key, 0.0);
  }
  return c;
}

std::string SimplifyReport::profile_table() const {
  return profile.table() + fates("sheets", sheets) + fates("chords", chords) +
         fates("peels", peels) + fates("pillows", pillows);
}

nlohmann::ordered_json SimplifyReport::json() const {
  nlohmann::ordered_json j = {{"before", to_json(before)},
                              {"after", to_json(after)},
                              {"rate", rate()},
                              {"hausdorff_ratio", hausdorff_ratio},
                              {"stopped", name(stopped)},
                              {"sheets", to_json(sheets)},
                              {"chords", to_json(chords)},
                              {"peels", to_json(peels)},
                              {"pillows", to_json(pillows)},
                              {"coarsened", coarsened},
                              {"refined", refined},
                              {"refinement_failed", refinement_failed},
                              {"seconds", seconds},
                              {"profile", profile.json()}};
  if (attempts.empty()) return j;
  j["attempt"] = attempt;
  for (const AttemptFigures& a : attempts) {
    j["attempts"].push_back({{"attempt", a.attempt},
                             {"components", a.components},
                             {"min_scaled_jacobian", a.min_scaled_jacobian},
                             {"mean_scaled_jacobian", a.mean_scaled_jacobian},
                             {"seconds", a.seconds}});
  }
  return j;
}

}  // namespace hexweft
