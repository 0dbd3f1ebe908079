/// \file
/// Reads surfaces: OBJ, OFF, PLY and STL files, text and binary.
///
///     const SurfaceMesh surface = read_surface_mesh("scan.ply");
///
/// Polygons are cut into fans of triangles. The values are those of the file, in double precision;
/// points that have all three in common are one.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace hexweft {

struct SurfaceMesh {
  Eigen::Matrix3Xd points;  ///< 3 × #points, different, each used by a triangle
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::string> notes;  ///< what was left out
};

/// Whether the extension, in any case, is that of a surface file.
bool is_surface_file(const std::filesystem::path& path);

/// \throws FormatError "path:line: ..." or "path: byte N: ..." if the file cannot be read, is not what
///         its extension says, or has no triangles
SurfaceMesh read_surface_mesh(const std::filesystem::path& path);

/// As read_surface_mesh, from the content of a file. \param name  for messages; its extension tells
/// the format
SurfaceMesh read_surface_mesh_text(std::string_view text, const std::filesystem::path& name);

}  // namespace hexweft
