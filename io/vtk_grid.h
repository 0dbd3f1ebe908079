/// \file
/// What an unstructured grid's points and cells become, by the same rules in all of VTK's formats.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "io/mesh_data.h"

namespace hexweft::detail {

inline constexpr int kVtkHexahedron = 12;

/// The points of coordinates x, y, z, x, y and so on, of integers or reals.
/// \param fail  throws; called with the place of a coordinate that is not finite, and a sentence
std::vector<Eigen::Vector3d> points_of(
    const DataArray& coordinates,
    const std::function<void(std::size_t place, const std::string& problem)>& fail);

/// The cells of all types as a file lists them.
struct VtkCellList {
  std::vector<std::int64_t> types;
  std::vector<std::int64_t> corners;         ///< of all cells, one after the other
  std::vector<std::size_t> first_corner{0};  ///< of each cell, and the end of the last
  std::size_t size() const { return first_corner.size() - 1; }
};

/// Throws, telling a cell of the list and what is wrong with it.
using FailAtVtkCell = std::function<void(int cell, const std::string& problem)>;

/// Calls `fail` with a whole sentence at the first solid cell that is no hexahedron.
void check_vtk_types(const VtkCellList& list, const FailAtVtkCell& fail);

/// Appends the hexahedra and voxels, the latter renumbered, to `data.cells`, whose points are
/// there. Cells without volume are left out.
/// \param fail  called with a problem such as "has 4 corners, expected 8"
/// \return      which cells of the list became the cells of the mesh, in order
/// \pre         check_vtk_types finds nothing
std::vector<int> pick_hexahedra(const VtkCellList& list, MeshData& data, const FailAtVtkCell& fail);

/// Notes that so many cells were left out, if any.
void note_cells_without_volume(std::size_t n, std::vector<std::string>& notes);

}  // namespace hexweft::detail
