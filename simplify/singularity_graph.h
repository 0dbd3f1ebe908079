/// \file
/// The singularity graph of a hex mesh: its singular edges, joined to curves between singular
/// vertices. Source [Gao2017, §3], spec "Words".
#pragma once

#include <vector>

#include "ovm/hex_mesh.h"

namespace hexweft {

/// A maximal chain of singular mesh edges of one valence, all inside or all on the boundary.
struct SingularCurve {
  std::vector<VertexHandle> vertices;  ///< in order; a closed curve does not repeat the first
  std::vector<EdgeHandle> edges;       ///< edges[i] joins vertices[i] and the next one
  bool closed = false;                 ///< true: no singular vertex on it
  int valence = 0;                     ///< cells at each of its edges
  bool boundary = false;
};

/// Valence, boundary flags and singular elements, indexed by handle.
struct SingularityGraph {
  std::vector<int> edge_valence;  ///< cells at the edge
  std::vector<char> boundary_edge, boundary_vertex;
  std::vector<char> singular_edge;    ///< valence is not the regular one
  std::vector<char> singular_vertex;  ///< ends a curve, or is a node put on a closed one
  std::vector<int> curve_of_edge;     ///< -1: regular
  std::vector<SingularCurve> curves;  ///< ordered by their lowest edge

  int regular_valence(EdgeHandle e) const { return boundary_edge[e.idx] ? 2 : 4; }
};

/// Cost O(#cells).
SingularityGraph extract_singularity_graph(const HexMesh& mesh);

}  // namespace hexweft
