/// \file
/// What a format reader gives: the file's points, hexahedra and data, before they are a mesh.
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "io/data_array.h"
#include "ovm/hex_mesh.h"

namespace hexweft {

/// The most cells a mesh can hold, and the most points, edges or faces: handles are ints, a cell has 12
/// slots of edges, an edge or a face two halves.
inline constexpr int kMostCells = std::numeric_limits<int>::max() / 12;
inline constexpr int kMostPoints = std::numeric_limits<int>::max() / 2;

struct MeshData {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 8>> cells;  ///< indices into points, corners in VTK order
  std::vector<DataArray> point_data;      ///< a row each point
  std::vector<DataArray> cell_data;       ///< a row each cell
  std::vector<std::string> notes;         ///< what the file had that the mesh does not
};

/// Appends the array unless one of its name is there already, which is noted.
void add_array(std::vector<DataArray>& arrays, DataArray array, std::vector<std::string>& notes);

/// Keeps these rows, in ascending order.
void keep_rows(DataArray& array, const std::vector<int>& rows);

/// Calls `fail(cell, problem)`, which throws, at the first cell that no mesh can hold: an index out
/// of range or given twice, or a vertex crowded by more cells than any real mesh has. \param base
/// what the file calls its first vertex, 0 or 1; for the message
/// \param name  what the file calls a vertex; by default "vertex", its index and `base` added
void check_cells(const MeshData& data, int base,
                 const std::function<void(int cell, const std::string& problem)>& fail,
                 const std::function<std::string(int vertex)>& name = {});

/// Builds the mesh; points and cells keep the file's order. Where more than half of the cells have a
/// negative volume the file numbers its corners mirrored, and all are turned into VTK order, which is
/// noted. \param keep_isolated_vertices  points that no cell uses: kept, or left out and counted in
/// `notes` \pre check_cells finds nothing
HexMesh build_hex_mesh(MeshData data, bool keep_isolated_vertices, std::vector<std::string>& notes);

}  // namespace hexweft
