#include "io/formats.h"

#include <algorithm>
#include <array>

#include "io/gmsh.h"
#include "io/medit.h"
#include "io/ovm.h"
#include "io/text_scanner.h"
#include "io/vtk_legacy.h"
#include "io/vtu.h"

namespace hexweft {

std::span<const Format> formats() {
  static constexpr std::array<Format, 6> kFormats{{
      {"vtk", ".vtk", "legacy VTK, text or binary, with point and cell data", true, is_vtk_legacy,
       read_vtk_legacy, write_vtk_legacy},
      {"vtu", ".vtu", "VTK's XML unstructured grid, text or binary, with point and cell data", true,
       is_vtu, read_vtu, write_vtu},
      {"medit", ".mesh", "Medit, text, with references", false, is_medit, read_medit, write_medit},
      {"ovm", ".ovm", "OpenVolumeMesh, text, with numbers on vertices and cells", false, is_ovm,
       read_ovm, write_ovm},
      {"ovmb", ".ovmb", "OpenVolumeMesh, binary, with numbers on vertices and cells", true, is_ovmb,
       read_ovmb, write_ovmb},
      {"gmsh", ".msh", "Gmsh, text or binary, with tags and node and element data", true, is_gmsh,
       read_gmsh, write_gmsh},
  }};
  return kFormats;
}

const Format& format_named(std::string_view name) {
  std::string names;
  for (const Format& format : formats()) {
    if (format.name == name) return format;
    names += (names.empty() ? "" : ", ") + std::string(format.name);
  }
  throw InputError("format = \"" + std::string(name) + "\", expected one of " + names);
}

const Format* format_of_extension(const std::filesystem::path& path) {
  const std::string extension = detail::lower_case(path.extension().string());
  for (const Format& format : formats()) {
    if (format.extension == extension) return &format;
  }
  return nullptr;
}

}  // namespace hexweft
