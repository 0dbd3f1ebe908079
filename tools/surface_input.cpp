#include "tools/surface_input.h"

#include "io/file.h"
#include "io/hex_mesh_io.h"
#include "optimize/surface_io.h"

namespace hexweft::cli {

ReferenceSurface read_surface_input(const std::filesystem::path& path,
                                    std::vector<std::string>& notes) {
  if (is_surface_file(path)) return read_surface(path);
  ReadReport report;
  const HexMesh mesh = read_hex_mesh(path, {}, &report);
  notes.insert(notes.end(), report.notes.begin(), report.notes.end());
  if (mesh.n_cells() == 0) throw InputError(display_name(path, true) + ": has no hexahedra");
  return make_reference_surface(mesh);
}

}  // namespace hexweft::cli
