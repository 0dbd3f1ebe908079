#include "tools/surface_input.h"

#include <charconv>

#include "io/file.h"
#include "io/hex_mesh_io.h"
#include "io/surface_io.h"
#include "optimize/orient_surface.h"

namespace hexweft::cli {
namespace {

// Vertices look for the surface that faces their way.
void orient(SurfaceMesh& surface) {
  const auto n = static_cast<std::size_t>(orient_surface(surface.points, surface.triangles));
  if (n == 0) return;
  const std::size_t n_all = surface.triangles.size();
  surface.notes.push_back(
      (n == n_all ? "all triangles"
                  : std::to_string(n) + " of " + std::to_string(n_all) + " triangles") +
      " faced into the solid or against their neighbours; they were turned");
}

}  // namespace

ReferenceSurface read_surface_input(const std::filesystem::path& path,
                                    std::vector<std::string>& notes,
                                    const FeatureOptions& features) {
  if (is_surface_file(path)) {
    SurfaceMesh surface = read_surface_mesh(path);
    orient(surface);
    notes.insert(notes.end(), surface.notes.begin(), surface.notes.end());
    return {std::move(surface.points), std::move(surface.triangles), kNormalAngleDeg, features};
  }
  ReadReport report;
  const HexMesh mesh = read_hex_mesh(path, {}, &report);
  notes.insert(notes.end(), report.notes.begin(), report.notes.end());
  if (mesh.n_cells() == 0) throw InputError(display_name(path, true) + ": has no hexahedra");
  return boundary_of(mesh, features);
}

ReferenceSurface boundary_of(const HexMesh& mesh, const FeatureOptions& features) {
  return make_reference_surface(mesh, kNormalAngleDeg, features);
}

FeatureOptions parse_features(const std::string& text) {
  if (text == "auto") return {};
  if (text == "off") return {.mode = FeatureMode::off};
  FeatureOptions options = {.mode = FeatureMode::angle};
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, options.angle_deg);
  const std::string expected = "--features = " + text + ", expected auto, off or an angle";
  if (error != std::errc() || stop != end) throw InputError(expected + " in degrees");
  try {
    validate(options);
  } catch (const InputError& problem) {
    throw InputError(expected + ": " + problem.what());
  }
  return options;
}

}  // namespace hexweft::cli
