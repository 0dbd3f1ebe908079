// hexweft-info: what a mesh is, whether it is valid, and what is wrong with it and where.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "ovm/quality.h"
#include "ovm/topology_check.h"
#include "ovm/topology_summary.h"
#include "simplify/base_complex.h"
#include "simplify/report.h"
#include "tools/cli.h"

namespace hexweft {
namespace {

using Json = nlohmann::ordered_json;

/// Cells without positive scaled Jacobian, worst first.
std::vector<std::pair<double, CellHandle>> inverted_cells(const HexMesh& mesh) {
  std::vector<std::pair<double, CellHandle>> result;
  for (CellHandle c : mesh.cells()) {
    if (const double sj = scaled_jacobian(mesh, c); !(sj > 0)) result.emplace_back(sj, c);
  }
  std::sort(result.begin(), result.end());
  return result;
}

std::vector<std::string> list_problems(const HexMesh& mesh,
                                       const std::vector<TopologyViolation>& violations) {
  std::vector<std::string> problems;
  for (const TopologyViolation& v : violations) {
    if (severity(v.defect) != Severity::note) problems.push_back(v.message);
  }
  for (const auto& [sj, c] : inverted_cells(mesh)) {
    problems.push_back(fmt::format("cell {} has scaled Jacobian {:.4g}", c.idx, sj));
  }
  return problems;
}

// A base complex, genus and parts are those of manifolds only.
MeshFigures figures_without_structure(const HexMesh& mesh) {
  const QualitySummary q = summarize_quality(mesh, 0);
  MeshFigures f;
  f.vertices = mesh.n_vertices();
  f.hexahedra = mesh.n_cells();
  f.min_scaled_jacobian = q.min_scaled_jacobian;
  f.mean_scaled_jacobian = q.mean_scaled_jacobian;
  f.std_scaled_jacobian = q.std_scaled_jacobian;
  f.mean_volume_deviation = q.mean_volume_deviation;
  f.max_volume_deviation = q.max_volume_deviation;
  f.inverted = q.n_inverted;
  return f;
}

// The same keys for every mesh, null where unknown.
Json figures_of(const HexMesh& mesh, bool is_manifold) {
  const MeshFigures f = is_manifold ? measure_mesh(mesh) : figures_without_structure(mesh);
  const SingularityGraph g = is_manifold ? extract_singularity_graph(mesh) : SingularityGraph{};
  const auto if_manifold = [&](auto figure) { return is_manifold ? Json(figure) : Json(); };
  return {{"vertices", f.vertices},
          {"hexahedra", f.hexahedra},
          {"components", if_manifold(f.components)},
          {"base_vertices", if_manifold(f.base_vertices)},
          {"base_edges", if_manifold(f.base_edges)},
          {"base_faces", if_manifold(f.base_faces)},
          {"min_scaled_jacobian", f.min_scaled_jacobian},
          {"mean_scaled_jacobian", f.mean_scaled_jacobian},
          {"std_scaled_jacobian", f.std_scaled_jacobian},
          {"mean_volume_deviation", f.mean_volume_deviation},
          {"max_volume_deviation", f.max_volume_deviation},
          {"inverted", f.inverted},
          {"genus", if_manifold(f.genus)},
          {"parts", if_manifold(f.parts)},
          {"singular_curves", if_manifold(g.curves.size())},
          {"singular_edges", if_manifold(std::ranges::count(g.singular_edge, 1))},
          {"singular_vertices", if_manifold(std::ranges::count(g.singular_vertex, 1))}};
}

std::string text_of(const Json& value) {
  const bool is_real = value.is_number_float();
  if (value.is_null() || (is_real && !std::isfinite(value.get<double>()))) return "-";
  if (is_real) return fmt::format("{:.4f}", value.get<double>());
  return value.is_string() ? value.get<std::string>() : value.dump();
}

int info(cli::Program& program, int max_listed) {
  const HexMesh mesh = program.read_mesh();
  const auto violations = check_topology(mesh);
  Json report = figures_of(mesh, is_clean(violations));
  const auto problems = list_problems(mesh, violations);
  const bool valid = is_clean(violations) && report["inverted"] == 0;
  report["valid"] = valid;
  if (!program.wants_json()) {
    for (const auto& [key, value] : report.items()) {
      program.say(fmt::format("{:>22}  {}", key, text_of(value)));
    }
    for (std::size_t i = 0; i < problems.size() && static_cast<int>(i) < max_listed; ++i) {
      program.say("  " + problems[i]);
    }
    if (static_cast<int>(problems.size()) > max_listed) {
      program.say(fmt::format("  and {} more (--list)", problems.size() - max_listed));
    }
  }
  report["problems"] = problems;
  program.write_json(report);
  return cli::kDone;
}

}  // namespace
}  // namespace hexweft

int main(int argc, char** argv) {
  using namespace hexweft;
  cli::Program program(
      "hexweft-info",
      "Tells the size, validity, quality and block structure of a hexahedral mesh.");
  int max_listed = 10;
  program.add_input();
  program.add_json();
  program.app()
      .add_option("--list", max_listed, "How many problems to print at most; the JSON has all")
      ->check(cli::in_range(0, 1e9))
      ->capture_default_str();
  return program.run(argc, argv, [&] { return info(program, max_listed); });
}
