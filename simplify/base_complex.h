/// \file
/// The base complex B = (B_V, B_E, B_F, B_C): the coarse cuboid blocks a hex mesh consists of.
/// Surfaces swept straight from the singular edges, and from every mesh edge at a singular vertex,
/// cut the mesh into components; each is a structured grid. Source [Gao2015, §4], spec "Words".
///
///     const BaseComplex bc = extract_base_complex(mesh);
///     for (const Component& b : bc.components)
///       for (CellHandle c : bc.cells(b)) ...
#pragma once

#include <array>
#include <span>
#include <vector>

#include "ovm/hex_mesh.h"
#include "simplify/singularity_graph.h"

namespace hexweft {

/// A straight chain of mesh edges between two base vertices.
struct BaseEdge {
  std::array<int, 2> ends;  ///< base vertices
  int first = 0;            ///< into BaseComplex::edge_vertices
  int n = 0;                ///< mesh edges in it; it has n + 1 mesh vertices
  int valence = 0;          ///< cells at each of its mesh edges
  bool boundary = false;
  bool singular = false;
  int regular_valence() const { return boundary ? 2 : 4; }
  /// |v(e) - q(e)|
  int valence_error() const {
    return valence > regular_valence() ? valence - regular_valence() : regular_valence() - valence;
  }
};

/// A quadrilateral patch between components.
struct BaseFace {
  std::array<int, 4> edges;                  ///< cyclic
  std::array<int, 2> components = {-1, -1};  ///< the second is -1 on the boundary
  bool boundary() const { return components[1] < 0; }
};

/// A cuboid block: a structured grid of cells. Corners, edges and sides are numbered as those of a
/// cell (hex_numbering.h).
struct Component {
  std::array<int, 3> n = {0, 0, 0};  ///< cells along each axis
  int first_cell = 0, first_vertex = 0;
  std::array<int, 8> corners;  ///< base vertices
  std::array<int, 12> edges;   ///< base edges
  std::array<int, 6> faces;    ///< base faces
  int n_cells() const { return n[0] * n[1] * n[2]; }
  int n_vertices() const { return (n[0] + 1) * (n[1] + 1) * (n[2] + 1); }
};

struct BaseComplex {
  SingularityGraph graph;              ///< with the nodes put on closed curves
  std::vector<VertexHandle> vertices;  ///< B_V
  std::vector<BaseEdge> edges;         ///< B_E
  std::vector<BaseFace> faces;         ///< B_F
  std::vector<Component> components;   ///< B_C
  /// Cells that belong to no structured grid, and grids that do not meet their neighbours side to side.
  /// 0 on every mesh this project writes; where it is not, `components` has only the regular ones.
  int irregular = 0;

  std::vector<VertexHandle> edge_vertices;  ///< pool of BaseEdge chains
  std::vector<CellHandle> grid_cells;       ///< pool of grids, axis 0 fastest
  std::vector<VertexHandle> grid_vertices;  ///< pool of grids, axis 0 fastest
  std::vector<int> component_of_cell;       ///< by cell handle, -1 if in none
  std::vector<int> base_edge_of_edge;       ///< by edge handle, -1 if on none

  std::span<const VertexHandle> chain(const BaseEdge& e) const {
    return {edge_vertices.data() + e.first, static_cast<std::size_t>(e.n + 1)};
  }
  std::span<const CellHandle> cells(const Component& c) const {
    return {grid_cells.data() + c.first_cell, static_cast<std::size_t>(c.n_cells())};
  }
  std::span<const VertexHandle> grid(const Component& c) const {
    return {grid_vertices.data() + c.first_vertex, static_cast<std::size_t>(c.n_vertices())};
  }
  CellHandle cell(const Component& c, int i, int j, int k) const {
    return grid_cells[c.first_cell + (k * c.n[1] + j) * c.n[0] + i];
  }
  VertexHandle vertex(const Component& c, int i, int j, int k) const {
    return grid_vertices[c.first_vertex + (k * (c.n[1] + 1) + j) * (c.n[0] + 1) + i];
  }
};

/// \param mesh  conforming and manifold (check_topology)
/// Cost O(#cells).
BaseComplex extract_base_complex(const HexMesh& mesh);

}  // namespace hexweft
