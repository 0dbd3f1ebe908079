/// \file
/// What is wrong with the topology of a mesh, and where.
///
/// A mesh is *valid* when it is conforming, a manifold with manifold boundary, and its cells are
/// glued the right way round. Degenerate places (doublets, cells glued twice, interior edges with
/// fewer than three cells) are tolerated in an input, but no edit may make one: their cells cannot
/// have positive Jacobians all over.
///
///     for (const TopologyViolation& v : check_topology(mesh)) std::cerr << v.message << '\n';
#pragma once

#include <span>
#include <string>
#include <vector>

#include "ovm/hex_mesh.h"

namespace hexweft {

enum class TopologyDefect {
  nonconforming_face,    ///< a face: three or more half-faces on the same four vertices
  inside_out_face,       ///< a face: its two half-faces run round it the same way, or twisted
  nonmanifold_edge,      ///< an edge: its cells are not one fan
  nonmanifold_vertex,    ///< a vertex: its link is no sphere (inside), no disk (on the boundary)
  low_valence_edge,      ///< an interior edge with fewer than three cells
  multiply_glued_cells,  ///< a cell: it shares two or more faces with one neighbour
  doublet,               ///< a vertex: two different faces share two edges there
  isolated_vertex,       ///< a vertex: no cell uses it
};

enum class Severity {
  note,        ///< harmless
  degenerate,  ///< met in inputs of octree meshers; an edit must not make one
  invalid      ///< not a mesh of cuboids glued face to face
};

Severity severity(TopologyDefect defect);

struct TopologyViolation {
  TopologyDefect defect;
  int index;            ///< of the vertex, edge, face or cell that TopologyDefect names
  std::string message;  ///< one sentence
};

/// Everything wrong with the mesh, sorted by defect and index.
/// Cost O(#cells) on meshes of bounded valence.
std::vector<TopologyViolation> check_topology(const HexMesh& mesh);

/// What is wrong at these vertices and at the edges, faces and cells that touch them. Deleted
/// vertices are passed over. The cost is that of what is looked at, not of the mesh.
std::vector<TopologyViolation> check_topology(const HexMesh& mesh,
                                              std::span<const VertexHandle> vertices);

/// True if nothing of severity `at_least` or above is wrong.
bool is_clean(std::span<const TopologyViolation> violations, Severity at_least = Severity::invalid);

/// What is_clean(check_topology(mesh, vertices), at_least) is, without looking further than the first.
bool is_clean(const HexMesh& mesh, std::span<const VertexHandle> vertices, Severity at_least);

/// No violation is `invalid`.
bool is_valid(const HexMesh& mesh);

}  // namespace hexweft
