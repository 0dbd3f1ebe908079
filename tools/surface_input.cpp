#include "tools/surface_input.h"

#include <charconv>

#include "io/file.h"
#include "io/hex_mesh_io.h"
#include "io/surface_io.h"

namespace hexweft::cli {

ReferenceSurface read_surface_input(const std::filesystem::path& path,
                                    std::vector<std::string>& notes,
                                    const FeatureOptions& features) {
  if (is_surface_file(path)) {
    SurfaceMesh surface = read_surface_mesh(path);
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
