/// \file
/// Reference surfaces out of triangle files: OBJ, OFF, PLY and STL, through OpenMesh.
///
///     const ReferenceSurface surface = read_surface("scan.ply");
///
/// Polygons are cut into fans of triangles. Coordinates are those of the file in single precision:
/// more OpenMesh's readers do not keep.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include "optimize/reference_surface.h"

namespace hexweft {

/// Extensions with their dot, lower case.
std::span<const std::string_view> surface_extensions();

/// Whether the extension, in any case, is that of a surface file.
bool is_surface_file(const std::filesystem::path& path);

/// \param feature_angle_deg, features  as in ReferenceSurface
/// \throws FormatError "path: ..." if the file cannot be read, is not what its extension says, or
///         has no triangles
ReferenceSurface read_surface(const std::filesystem::path& path,
                              double feature_angle_deg = kNormalAngleDeg,
                              const FeatureOptions& features = {});

}  // namespace hexweft
