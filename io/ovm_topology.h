/// \file
/// Hexahedra as OpenVolumeMesh files hold them: edges, faces of half-edges, cells of half-faces.
///
/// Edge e has the half-edges 2e, as it is stored, and 2e + 1, turned round; face f the half-faces 2f
/// and 2f + 1 likewise. The half-faces of a cell face inward. In the order they are written in, with
/// a cell's corners in VTK order:
///
///     (1,2,3,0) (7,6,5,4) (3,2,6,7) (4,5,1,0) (3,7,4,0) (2,1,5,6)
///
/// Any other order is read too, and half-faces that all face outward.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "io/mesh_data.h"
#include "io/ovm_types.h"
#include "ovm/hex_mesh.h"

namespace hexweft::detail {

struct OvmTopology {
  std::vector<std::array<int, 2>> edges;  ///< vertices, from and to
  std::vector<std::array<int, 4>> faces;  ///< half-edges, one after the other
  std::vector<std::array<int, 6>> cells;  ///< half-faces
};

/// Of the live cells, in their order; vertices are numbered as vertex_numbers() (number_text.h). Edges
/// and faces come in the order in which the cells meet them.
OvmTopology make_ovm_topology(const HexMesh& mesh);

/// Makes the cells of the mesh; faces that none of them has are counted in the notes.
/// \param fail  called with the first cell that is no hexahedron, and what is wrong with it; throws
/// \pre every index is within its range, and the points of the mesh are there
void add_hexahedra(const OvmTopology& topology, MeshData& data,
                   const std::function<void(int cell, const std::string& problem)>& fail);

/// How many values a property has in a file of so many vertices.
std::size_t count(OvmEntity entity, std::size_t n_vertices, const OvmTopology& topology);

}  // namespace hexweft::detail
