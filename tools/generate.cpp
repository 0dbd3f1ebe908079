// hexweft-generate: sample meshes with known structure.
#include <algorithm>
#include <optional>

#include "ovm/generators.h"
#include "tools/cli.h"

namespace hexweft {
namespace {

struct Request {
  std::string kind;
  std::optional<int> resolution;  // empty: the kind's own
  std::string shape = std::string(name(Shape::sphere));
  bool square = false;
  int quarter_turns = 0;
  int sheets = 0;
  unsigned seed = 0;
};

struct Kind {
  std::string name;
  int default_resolution;
  HexMesh (*make)(int n, const Request& request);
};

Shape shape_named(const std::string& wanted) {
  return *std::find_if(kShapes.begin(), kShapes.end(),
                       [&](Shape shape) { return name(shape) == wanted; });
}

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> kKinds{
      {"grid", 4,
       [](int n, const Request&) {
         return make_grid({n, n, n});
       }},
      {"o-grid", 3,
       [](int n, const Request&) {
         return make_o_grid({.n_core = n, .n_ring = n, .n_layers = 2 * n});
       }},
      {"torus", 2,
       [](int n, const Request& request) {
         TorusOptions options;
         options.n_core = options.n_ring = n;
         options.n_around = 8 * n;
         options.round_section = !request.square;
         options.n_quarter_turns = request.quarter_turns;
         return make_torus(options);
       }},
      {"l-shape", 3, [](int n, const Request&) { return make_l_shape(n); }},
      {"octree-like", 16, [](int n, const Request& request) {
         return make_octree_like(shape_named(request.shape), n, request.seed);
       }}};
  return kKinds;
}

const Kind& kind_named(const std::string& name) {
  return *std::find_if(kinds().begin(), kinds().end(),
                       [&](const Kind& k) { return k.name == name; });
}

void add_options(CLI::App& app, Request& request) {
  std::vector<std::string> names;
  for (const Kind& kind : kinds()) names.push_back(kind.name);
  app.add_option("KIND", request.kind, "What to make")->required()->check(CLI::IsMember(names));
  names.clear();
  for (Shape shape : kShapes) names.emplace_back(name(shape));
  app.add_option("--shape", request.shape, "Shape of an octree-like mesh")
      ->check(CLI::IsMember(names))
      ->capture_default_str();
  app.add_option(
         "--resolution", request.resolution,
         "Cells along a side (grid, l-shape: default 4, 3), across the core and in each of its "
         "rings (o-grid, torus: default 3, 2), voxels along the longest side (octree-like: "
         "default 16, at least 6)")
      ->check(cli::in_range(1, 200));
  app.add_flag("--square", request.square,
               "Give the torus a square section instead of a round one");
  app.add_option("--quarter-turns", request.quarter_turns,
                 "By how many quarter turns the torus twists on its way round")
      ->check(cli::in_range(-8, 8))
      ->capture_default_str();
  app.add_option("--sheets", request.sheets, "Insert up to this many sheets at random places")
      ->check(cli::in_range(0, 10000))
      ->capture_default_str();
  app.add_option("--seed", request.seed, "Of the random sheets and of the shape blob")
      ->check(cli::in_range(0, 4294967295.0))
      ->capture_default_str();
}

int generate(cli::Program& program, const Request& request) {
  const Kind& kind = kind_named(request.kind);
  const int resolution = request.resolution.value_or(kind.default_resolution);
  HexMesh mesh = kind.make(resolution, request);
  const int inserted = insert_random_sheets(mesh, request.sheets, request.seed);
  program.write_mesh(mesh);
  program.write_json({{"kind", request.kind},
                      {"resolution", resolution},
                      {"seed", request.seed},
                      {"sheets_inserted", inserted},
                      {"vertices", mesh.n_vertices()},
                      {"hexahedra", mesh.n_cells()}});
  std::string line = request.kind + ": " + std::to_string(mesh.n_cells()) + " hexahedra, " +
                     std::to_string(mesh.n_vertices()) + " vertices";
  if (request.sheets > 0) {
    line += ", " + std::to_string(inserted) + " of " + std::to_string(request.sheets) +
            " sheets inserted";
  }
  program.say(line);
  return cli::kDone;
}

}  // namespace
}  // namespace hexweft

int main(int argc, char** argv) {
  using namespace hexweft;
  cli::Program program("hexweft-generate", "Makes a sample hexahedral mesh with known structure.");
  Request request;
  add_options(program.app(), request);
  program.add_output();
  program.add_json();
  return program.run(argc, argv, [&] { return generate(program, request); });
}
