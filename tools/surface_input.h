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

/// The triangles of a file are made to face out of the solid (orient_surface.h).
/// \param path      "-" is a mesh on standard input
/// \param notes     what reading a mesh or a surface has to say is appended
/// \param features  which lines and corners of it are held
/// \throws FormatError if it cannot be read, InputError if a mesh has no cells
ReferenceSurface read_surface_input(const std::filesystem::path& path,
                                    std::vector<std::string>& notes,
                                    const FeatureOptions& features = {});

/// The boundary of a mesh that is at hand.
ReferenceSurface boundary_of(const HexMesh& mesh, const FeatureOptions& features);

/// The value of --features: auto, off, or an angle in degrees. \throws InputError
FeatureOptions parse_features(const std::string& text);
inline constexpr const char* kFeaturesHelp =
    "Sharp edges and corners of the surface that are held: auto, off, or those bent by more than "
    "this angle in degrees";

}  // namespace hexweft::cli
