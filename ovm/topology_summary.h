/// \file
/// Global topology of a mesh in a few numbers.
#pragma once

#include <vector>

#include "ovm/hex_mesh.h"

namespace hexweft {

/// Counts of a manifold mesh; vertices that no cell uses are left out.
struct TopologySummary {
  int n_vertices = 0, n_edges = 0, n_faces = 0, n_cells = 0;
  int n_boundary_vertices = 0, n_boundary_edges = 0, n_boundary_faces = 0;
  int n_parts = 0;                ///< connected through faces
  int n_boundary_components = 0;  ///< closed surfaces, connected through edges
  int euler_characteristic = 0;   ///< V - E + F - C
  int genus = 0;  ///< parts less half the boundary's Euler number: handles, less 1 a cavity, as
                  ///< the published tables count
};

/// Cost O(#cells).
TopologySummary summarize_topology(const HexMesh& mesh);

/// V - E + F - C, vertices that no cell uses left out.
int euler_characteristic(const HexMesh& mesh);

/// The part each cell slot belongs to, numbered from 0 in order of the lowest cell; -1 for deleted
/// cells.
std::vector<int> parts_of_cells(const HexMesh& mesh);

}  // namespace hexweft
