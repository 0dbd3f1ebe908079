/// \file
/// A set of cells on flat arrays, for optimization: free vertices first, then the fixed rim.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "optimize/hex_energy.h"
#include "ovm/hex_mesh.h"

namespace hexweft {

/// Vertices, hexahedra and quads are numbered from 0 within the region.
struct Region {
  std::vector<CellHandle> cells;
  std::vector<VertexHandle>
      vertices;  ///< free ones first: those all of whose cells are in the region
  int n_free = 0;
  Eigen::Matrix3Xd points;        ///< 3 × #vertices, model units
  std::vector<HexCorners> hexes;  ///< parallel to `cells`
  std::vector<std::array<int, 4>>
      quads;                 ///< the mesh boundary in the region, counter-clockwise from outside
  std::vector<int> surface;  ///< free vertices on the mesh boundary, ascending
  std::vector<int>
      neighbor_side;  ///< 6 a hexahedron: 6 · neighbor + its side, -1 outside the region
};

/// \throws InputError for a cell that is not live or occurs twice
Region make_region(const HexMesh& mesh, std::span<const CellHandle> cells);

/// Takes the points of the mesh as it is now.
void load_points(const HexMesh& mesh, Region& region);

/// Writes the free points back. \return largest move, model units
double store_points(const Region& region, HexMesh& mesh);

/// Root mean square length of the edges at every vertex, within the region, model units.
std::vector<double> edge_lengths_at_vertices(const Region& region);

}  // namespace hexweft
