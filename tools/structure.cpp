// hexweft-structure: the base complex of a mesh, for ParaView.
#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "io/file.h"
#include "ovm/property.h"
#include "simplify/chord.h"
#include "simplify/sheet.h"
#include "tools/cli.h"
#include "tools/polyline_vtk.h"

namespace hexweft {
namespace {

using Json = nlohmann::ordered_json;

struct Structure {
  explicit Structure(const HexMesh& mesh)
      : bc(extract_base_complex(mesh)), sheets(extract_sheets(bc)), chords(extract_chords(bc)) {}
  BaseComplex bc;
  std::vector<Sheet> sheets;
  std::vector<Chord> chords;
};

using Triples = std::vector<std::array<int, 3>>;  // by component, one number each of its axes

Triples sheets_of_components(const Structure& s) {
  Triples result(s.bc.components.size(), {-1, -1, -1});
  for (int i = 0; i < static_cast<int>(s.sheets.size()); ++i) {
    for (const Crossing& x : s.sheets[i].crossings) result[x.component][x.axis] = i;
  }
  return result;
}

Triples chords_of_components(const Structure& s) {
  Triples result(s.bc.components.size(), {-1, -1, -1});
  for (int i = 0; i < static_cast<int>(s.chords.size()); ++i) {
    for (const ChordLink& link : s.chords[i].links) result[link.component][link.axis] = i;
  }
  return result;
}

// The lowest number that no neighbour has: few colors, and no two components that touch at a side
// alike.
std::vector<int> color_components(const BaseComplex& bc) {
  std::vector<int> color(bc.components.size(), -1);
  for (std::size_t c = 0; c < color.size(); ++c) {
    std::vector<int> taken;
    for (const int f : bc.components[c].faces) {
      for (const int other : bc.faces[f].components) {
        if (other >= 0) taken.push_back(color[other]);
      }
    }
    int free = 0;
    while (std::find(taken.begin(), taken.end(), free) != taken.end()) ++free;
    color[c] = free;
  }
  return color;
}

// A property of this name that holds nothing yet, said where it takes the place of another.
template <class T>
CellProperty<T> fresh_property(const cli::Program& program, HexMesh& mesh, const std::string& name,
                               const T& value) {
  if (property_registry<CellTag>(mesh)->erase(name))
    program.note("the cell data " + name + " of the input is replaced");
  return named_property<CellTag, T>(mesh, name, value);
}

Eigen::VectorXi row(const std::array<int, 3>& ids) {
  Eigen::VectorXi result(3);
  for (int i = 0; i < 3; ++i) result[i] = ids[i];
  return result;
}

void add_cell_data(const cli::Program& program, HexMesh& mesh, const Structure& s) {
  auto component = fresh_property(program, mesh, "component", -1);
  auto color = fresh_property(program, mesh, "color", -1);
  const Eigen::VectorXi none = row({-1, -1, -1});
  auto sheets = fresh_property(program, mesh, "sheets", none);
  auto chords = fresh_property(program, mesh, "chords", none);
  const Triples sheet_of = sheets_of_components(s), chord_of = chords_of_components(s);
  const std::vector<int> color_of = color_components(s.bc);
  for (const CellHandle c : mesh.cells()) {
    const int k = s.bc.component_of_cell[c.idx];
    if (k < 0) continue;
    component[c] = k;
    color[c] = color_of[k];
    sheets[c] = row(sheet_of[k]);
    chords[c] = row(chord_of[k]);
  }
}

cli::Polylines singular_lines(const SingularityGraph& graph) {
  cli::Polylines lines;
  lines.data = {{"curve", {}}, {"valence", {}}, {"boundary", {}}, {"closed", {}}};
  for (int i = 0; i < static_cast<int>(graph.curves.size()); ++i) {
    const SingularCurve& curve = graph.curves[i];
    lines.lines.push_back(curve.vertices);
    if (curve.closed) lines.lines.back().push_back(curve.vertices.front());
    int column = 0;
    for (const int x : {i, curve.valence, int{curve.boundary}, int{curve.closed}}) {
      lines.data[column++].second.push_back(x);
    }
  }
  return lines;
}

cli::Polylines base_lines(const Structure& s) {
  std::vector<int> sheet_of(s.bc.edges.size(), -1);
  for (int i = 0; i < static_cast<int>(s.sheets.size()); ++i) {
    for (const int e : s.sheets[i].edges) sheet_of[e] = i;
  }
  cli::Polylines lines;
  lines.data = {
      {"base_edge", {}}, {"sheet", {}}, {"valence", {}}, {"boundary", {}}, {"singular", {}}};
  for (int i = 0; i < static_cast<int>(s.bc.edges.size()); ++i) {
    const BaseEdge& e = s.bc.edges[i];
    const auto chain = s.bc.chain(e);
    lines.lines.emplace_back(chain.begin(), chain.end());
    int column = 0;
    for (const int x : {i, sheet_of[i], e.valence, int{e.boundary}, int{e.singular}}) {
      lines.data[column++].second.push_back(x);
    }
  }
  return lines;
}

Json to_json(const Structure& s) {
  Json j = {{"base_vertices", s.bc.vertices.size()}, {"base_edges", s.bc.edges.size()},
            {"base_faces", s.bc.faces.size()},       {"components", s.bc.components.size()},
            {"irregular", s.bc.irregular},           {"singular_curves", s.bc.graph.curves.size()}};
  j["sheets"] = Json::array();
  for (std::size_t i = 0; i < s.sheets.size(); ++i) {
    const Sheet& sheet = s.sheets[i];
    j["sheets"].push_back({{"id", i},
                           {"kind", name(sheet.kind)},
                           {"width", sheet.width},
                           {"base_edges", sheet.edges.size()},
                           {"crossings", sheet.crossings.size()}});
  }
  j["chords"] = Json::array();
  for (std::size_t i = 0; i < s.chords.size(); ++i) {
    const Chord& chord = s.chords[i];
    j["chords"].push_back({{"id", i},
                           {"closed", chord.closed},
                           {"self_crossing", chord.self_crossing},
                           {"twisted", chord.twisted},
                           {"components", chord.links.size()}});
  }
  return j;
}

std::string brief(const Structure& s) {
  std::map<std::string, int> kinds;
  for (const Sheet& sheet : s.sheets) ++kinds[std::string(name(sheet.kind))];
  std::string sheets;
  for (const auto& [kind, n] : kinds) {
    sheets += fmt::format("{}{} {}", sheets.empty() ? "" : ", ", n, kind);
  }
  return fmt::format("{} components, {} sheets ({}), {} chords, {} singular curves",
                     s.bc.components.size(), s.sheets.size(), sheets, s.chords.size(),
                     s.bc.graph.curves.size());
}

}  // namespace
}  // namespace hexweft

int main(int argc, char** argv) {
  using namespace hexweft;
  cli::Program program(
      "hexweft-structure",
      "Writes the mesh with its base complex as cell data: component, color (no two "
      "neighbours alike), and the ids of the three sheets and three chords through "
      "the component, as hexweft-rank and hexweft-collapse know them.");
  std::string singular_path, base_path;
  program.add_input();
  program.add_output();
  program.app().add_option("--singular-edges", singular_path,
                           "Write the singular curves as VTK lines, with valence");
  program.app().add_option("--base-edges", base_path,
                           "Write the base edges as VTK lines, with sheet and valence");
  program.add_json();
  return program.run(argc, argv, [&] {
    program.take_output("--singular-edges", singular_path);
    program.take_output("--base-edges", base_path);
    for (const std::string& path : {singular_path, base_path}) {
      if (!path.empty()) check_writable(path);
    }
    HexMesh mesh = program.read_valid_mesh();
    const Structure s(mesh);
    add_cell_data(program, mesh, s);
    program.write_mesh(mesh);
    if (!singular_path.empty()) {
      write_file(singular_path, cli::polyline_vtk(mesh, singular_lines(s.bc.graph)));
    }
    if (!base_path.empty()) write_file(base_path, cli::polyline_vtk(mesh, base_lines(s)));
    program.write_json(to_json(s));
    program.say(brief(s));
    return cli::kDone;
  });
}
