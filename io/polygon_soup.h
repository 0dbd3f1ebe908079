/// \file
/// What a reader of surfaces gives, and the readers there are.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace hexweft::detail {

struct PolygonSoup {
  std::vector<Eigen::Vector3d> points;     ///< finite
  std::vector<std::vector<int>> polygons;  ///< three indices into points or more
  std::vector<std::string> notes;
};

/// \throws FormatError "path:line: ...", "path: byte N: ..." where the file is binary
PolygonSoup read_obj(std::string_view text, const std::string& path);
PolygonSoup read_off(std::string_view text, const std::string& path);
PolygonSoup read_ply(std::string_view text, const std::string& path);
PolygonSoup read_stl(std::string_view text, const std::string& path);

/// The most points or polygons a surface may have.
inline constexpr int kMostOfSurface = 1 << 28;

}  // namespace hexweft::detail
