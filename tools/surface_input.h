/// \file
/// A command line's surface: a triangle file, or the boundary of a hexahedral mesh.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "optimize/reference_surface.h"

namespace hexweft::cli {

/// What a path may name, for --help.
inline constexpr const char* kSurfaceHelp =
    "a hexahedral mesh (its boundary counts), or a surface: .obj, .off, .ply, .stl";

/// \param path   "-" is a mesh on standard input
/// \param notes  what reading a mesh has to say is appended
/// \throws FormatError if it cannot be read, InputError if a mesh has no cells
ReferenceSurface read_surface_input(const std::filesystem::path& path,
                                    std::vector<std::string>& notes);

}  // namespace hexweft::cli
