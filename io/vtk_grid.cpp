#include "io/vtk_grid.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "ovm/hex_numbering.h"

namespace hexweft::detail {
namespace {

constexpr int kVoxel = 11;
constexpr std::array<int, 8> kVoxelToHexahedron{0, 1, 3, 2, 4, 5, 7, 6};

// Points, curves and surface cells of VTK, linear and curved.
bool has_no_volume(std::int64_t type) {
  static constexpr int kTypes[] = {0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  21, 22, 23, 28, 30,
                                   34, 35, 36, 51, 52, 53, 60, 61, 62, 68, 69, 70, 75, 76, 77};
  return std::find(std::begin(kTypes), std::end(kTypes), type) != std::end(kTypes);
}

std::string type_name(std::int64_t type) {
  static const std::map<std::int64_t, const char*> names{
      {10, "a tetrahedron"}, {13, "a wedge"}, {14, "a pyramid"}, {42, "a polyhedron"}};
  const auto it = names.find(type);
  return (it == names.end() ? "a cell" : it->second) + (" of type " + std::to_string(type));
}

std::array<int, 8> hexahedron_of(const VtkCellList& list, int c, std::int64_t n_points,
                                 const FailAtVtkCell& fail) {
  const std::size_t first = list.first_corner[c], n_corners = list.first_corner[c + 1] - first;
  if (n_corners != kCorners) {
    fail(c, "has " + std::to_string(n_corners) + " corners, expected 8");
  }
  std::array<int, 8> cell;
  for (int i = 0; i < kCorners; ++i) {
    const int corner = list.types[c] == kVoxel ? kVoxelToHexahedron[i] : i;
    const std::int64_t v = list.corners[first + corner];
    if (v < 0 || v >= n_points) {
      fail(c, "uses vertex " + std::to_string(v) + ", expected one of [0, " +
                  std::to_string(n_points - 1) + "]");
    }
    cell[i] = static_cast<int>(v);
  }
  return cell;
}

}  // namespace

std::vector<Eigen::Vector3d> points_of(
    const DataArray& coordinates,
    const std::function<void(std::size_t place, const std::string& problem)>& fail) {
  std::vector<Eigen::Vector3d> points(coordinates.size() / 3);
  const bool is_real = coordinates.kind == ValueKind::real;
  for (std::size_t i = 0; i < 3 * points.size(); ++i) {
    const double x = is_real ? coordinates.reals[i] : static_cast<double>(coordinates.integers[i]);
    if (!std::isfinite(x)) {
      fail(i, "expected finite coordinates, found another value at point " + std::to_string(i / 3));
    }
    points[i / 3][i % 3] = x;
  }
  return points;
}

void check_vtk_types(const VtkCellList& list, const FailAtVtkCell& fail) {
  for (std::size_t c = 0; c < list.types.size(); ++c) {
    const std::int64_t type = list.types[c];
    if (type == kVtkHexahedron || type == kVoxel || has_no_volume(type)) continue;
    fail(static_cast<int>(c),
         "expected hexahedra (type 12), found cell " + std::to_string(c) + ", " + type_name(type));
  }
}

std::vector<int> pick_hexahedra(const VtkCellList& list, MeshData& data,
                                const FailAtVtkCell& fail) {
  std::vector<int> hexahedra;
  data.cells.reserve(list.size());
  for (int c = 0; c < static_cast<int>(list.size()); ++c) {
    if (has_no_volume(list.types[c])) continue;
    data.cells.push_back(
        hexahedron_of(list, c, static_cast<std::int64_t>(data.points.size()), fail));
    hexahedra.push_back(c);
  }
  check_cells(data, 0,
              [&](int cell, const std::string& problem) { fail(hexahedra[cell], problem); });
  return hexahedra;
}

void note_cells_without_volume(std::size_t n, std::vector<std::string>& notes) {
  if (n == 0) return;
  notes.push_back(std::to_string(n) + " cells without volume (points, lines, faces) were left out");
}

}  // namespace hexweft::detail
