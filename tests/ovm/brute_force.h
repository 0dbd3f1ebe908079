/// \file
/// Incidences found from the cells' vertices alone, by looking at everything: what the kernel must
/// say.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <vector>

#include "ovm/hex_mesh.h"

namespace hexweft {

struct BruteForce {
  using Pair = std::array<VertexHandle, 2>;  // sorted
  using Quad = std::array<VertexHandle, 4>;  // sorted
  std::map<VertexHandle, std::set<CellHandle>> cells_of_vertex;
  std::map<VertexHandle, std::set<VertexHandle>> neighbors_of_vertex;
  std::map<Pair, std::set<CellHandle>> cells_of_edge;
  std::map<Quad, std::set<CellHandle>> cells_of_face;
  std::map<Pair, std::set<Quad>> faces_of_edge;
  std::set<VertexHandle> boundary_vertices;
  std::set<Pair> boundary_edges;

  template <std::size_t n>
  static std::array<VertexHandle, n> sorted(std::array<VertexHandle, n> v) {
    std::sort(v.begin(), v.end());
    return v;
  }

  explicit BruteForce(const HexMesh& mesh) {
    std::map<Quad, std::set<Pair>> edges_of_face;
    for (CellHandle c : mesh.cells()) {
      const CellVertices& v = mesh.vertices(c);
      for (VertexHandle x : v) cells_of_vertex[x].insert(c);
      for (const auto& k : kEdgeCorners) {
        cells_of_edge[sorted(Pair{v[k[0]], v[k[1]]})].insert(c);
        neighbors_of_vertex[v[k[0]]].insert(v[k[1]]);
        neighbors_of_vertex[v[k[1]]].insert(v[k[0]]);
      }
      for (const auto& k : kSideCorners) {
        const Quad quad = sorted(Quad{v[k[0]], v[k[1]], v[k[2]], v[k[3]]});
        cells_of_face[quad].insert(c);
        for (int i = 0; i < 4; ++i) {
          const Pair edge = sorted(Pair{v[k[i]], v[k[(i + 1) % 4]]});
          faces_of_edge[edge].insert(quad);
          edges_of_face[quad].insert(edge);
        }
      }
    }
    for (const auto& [quad, cells] : cells_of_face) {
      if (cells.size() > 1) continue;
      boundary_vertices.insert(quad.begin(), quad.end());
      boundary_edges.insert(edges_of_face[quad].begin(), edges_of_face[quad].end());
    }
  }
};

}  // namespace hexweft
