// hexweft-generate: sample meshes with known structure.
#include <algorithm>
#include <optional>

#include "ovm/generators.h"
#include "tools/cli.h"

namespace hexweft {
namespace {

constexpr std::string_view kPlateWithHoles = "plate-with-holes";  // takes --holes

struct Request {
  std::string kind;
  std::optional<int> resolution, layers;  // empty: the kind's own
  std::string shape = std::string(name(Shape::sphere));
  int holes = 12;
  bool oblique = false;
  int cells_per_voxel = 1;
  bool square = false;
  int quarter_turns = 0;
  int sheets = 0;
  int copies = 1;
  bool rotate = false;
  double scale = 1;
  std::vector<double> offset{0, 0, 0};
  unsigned seed = 0;
};

struct Kind {
  std::string name;
  int default_resolution;
  std::vector<std::string> options;  // that not every kind takes
  HexMesh (*make)(int n, const Request& request);
};

std::vector<std::string> shape_names() {
  std::vector<std::string> names;
  names.reserve(kShapes.size() + sample_solids().size());
  for (Shape shape : kShapes) names.emplace_back(name(shape));
  for (const SampleSolid& sample : sample_solids()) names.emplace_back(sample.name);
  return names;
}

Solid solid_named(const Request& request) {
  if (request.shape == kPlateWithHoles) return plate_with_holes(request.holes);
  for (Shape shape : kShapes) {
    if (name(shape) == request.shape) return solid_of(shape, request.seed);
  }
  const auto samples = sample_solids();
  return std::find_if(samples.begin(), samples.end(),
                      [&](const SampleSolid& sample) { return sample.name == request.shape; })
      ->make();
}

HexMesh make_octree_like_as_asked(int n, const Request& request) {
  Solid solid = solid_named(request);
  if (request.oblique) solid = turned(solid, random_rotation(request.seed));
  return make_octree_like(solid, {.resolution = n, .cells_per_voxel = request.cells_per_voxel});
}

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> kKinds{
      {"grid",
       4,
       {"--layers"},
       [](int n, const Request& request) {
         return make_grid({n, n, request.layers.value_or(n)});
       }},
      {"o-grid",
       3,
       {"--layers"},
       [](int n, const Request& request) {
         return make_o_grid({.n_core = n, .n_ring = n, .n_layers = request.layers.value_or(2 * n)});
       }},
      {"torus",
       2,
       {"--layers", "--square", "--quarter-turns"},
       [](int n, const Request& request) {
         TorusOptions options;
         options.n_core = options.n_ring = n;
         options.n_around = request.layers.value_or(8 * n);
         options.round_section = !request.square;
         options.n_quarter_turns = request.quarter_turns;
         return make_torus(options);
       }},
      {"l-shape", 3, {}, [](int n, const Request&) { return make_l_shape(n); }},
      {"octree-like",
       16,
       {"--shape", "--holes", "--oblique", "--cells-per-voxel"},
       make_octree_like_as_asked}};
  return kKinds;
}

const Kind& kind_named(const std::string& name) {
  return *std::find_if(kinds().begin(), kinds().end(),
                       [&](const Kind& k) { return k.name == name; });
}

// \throws InputError for an option that would change nothing
void check_options(const CLI::App& app, const Request& request) {
  const std::vector<std::string>& own = kind_named(request.kind).options;
  for (const Kind& kind : kinds()) {
    for (const std::string& option : kind.options) {
      const bool is_own = std::find(own.begin(), own.end(), option) != own.end();
      if (app.count(option) > 0 && !is_own)
        throw InputError(option + " has no meaning for " + request.kind);
    }
  }
  if (app.count("--holes") > 0 && request.shape != kPlateWithHoles)
    throw InputError("--holes has no meaning for the shape " + request.shape);
}

void add_structure_options(CLI::App& app, Request& request) {
  std::vector<std::string> names;
  for (const Kind& kind : kinds()) names.push_back(kind.name);
  app.add_option("KIND", request.kind, "What to make")->required()->check(CLI::IsMember(names));
  app.add_option(
         "--resolution", request.resolution,
         "Cells along a side (grid, l-shape: default 4, 3), across the core and in each of its "
         "rings (o-grid, torus: default 3, 2), voxels along the longest side (octree-like: "
         "default 16, at least 6)")
      ->check(cli::in_range(1, 200));
  app.add_option("--layers", request.layers,
                 "Cells upwards (grid: default as --resolution; o-grid: twice that) or around "
                 "(torus: eight times, at least 3)")
      ->check(cli::in_range(1, 10000));
  app.add_flag("--square", request.square,
               "Give the torus a square section instead of a round one");
  app.add_option("--quarter-turns", request.quarter_turns,
                 "By how many quarter turns the torus twists on its way round")
      ->check(cli::in_range(-8, 8))
      ->capture_default_str();
  app.add_option("--sheets", request.sheets, "Insert up to this many sheets at random places")
      ->check(cli::in_range(0, 10000))
      ->capture_default_str();
  app.add_option("--seed", request.seed, "Of all that is random, and of the shape blob")
      ->check(cli::in_range(0, 4294967295.0))
      ->capture_default_str();
}

void add_octree_options(CLI::App& app, Request& request) {
  const std::string group = "Octree-like meshes";
  app.add_option("--shape", request.shape, "Shape")
      ->check(CLI::IsMember(shape_names()))
      ->capture_default_str()
      ->group(group);
  app.add_option("--holes", request.holes,
                 "Holes in the plate-with-holes: its genus, if the voxels are fine enough to tell "
                 "them apart")
      ->check(cli::in_range(0, 400))
      ->capture_default_str()
      ->group(group);
  app.add_flag("--oblique", request.oblique,
               "Turn the shape, so that its faces lie askew to the voxels")
      ->group(group);
  app.add_option("--cells-per-voxel", request.cells_per_voxel,
                 "Cells along a side of a voxel; several give few large blocks, as polycube "
                 "meshers do")
      ->check(cli::in_range(1, 16))
      ->capture_default_str()
      ->group(group);
}

void add_placement_options(CLI::App& app, Request& request) {
  const std::string group = "Placement";
  app.add_option("--copies", request.copies, "Copies side by side, each a part of its own")
      ->check(cli::in_range(1, 100))
      ->capture_default_str()
      ->group(group);
  app.add_flag("--rotate", request.rotate, "Turn the mesh, so that nothing lies along an axis")
      ->group(group);
  app.add_option("--scale", request.scale, "Factor of all lengths, before the offset")
      ->check(cli::in_range(1e-30, 1e30))
      ->capture_default_str()
      ->group(group);
  app.add_option("--offset", request.offset, "Where the origin goes")
      ->expected(3)
      ->check(cli::in_range(-1e30, 1e30))
      ->capture_default_str()
      ->group(group);
}

void place(HexMesh& mesh, const Request& request) {
  if (request.copies > 1) {
    Eigen::AlignedBox3d box;
    for (VertexHandle v : mesh.vertices()) box.extend(mesh.point(v));
    const HexMesh one = mesh;
    for (int i = 1; i < request.copies; ++i) {
      append_copy(mesh, one, Eigen::Vector3d(1.25 * i * box.sizes().x(), 0, 0));
    }
  }
  Eigen::Affine3d map = Eigen::Affine3d::Identity();
  map.translate(Eigen::Map<const Eigen::Vector3d>(request.offset.data()));
  map.scale(request.scale);
  if (request.rotate) map.rotate(random_rotation(request.seed));
  transform(mesh, map);
}

int generate(cli::Program& program, const Request& request) {
  check_options(program.app(), request);
  const Kind& kind = kind_named(request.kind);
  const int resolution = request.resolution.value_or(kind.default_resolution);
  HexMesh mesh = kind.make(resolution, request);
  const int inserted = insert_random_sheets(mesh, request.sheets, request.seed);
  place(mesh, request);
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
  add_structure_options(program.app(), request);
  add_octree_options(program.app(), request);
  add_placement_options(program.app(), request);
  program.add_output();
  program.add_json();
  return program.run(argc, argv, [&] { return generate(program, request); });
}
