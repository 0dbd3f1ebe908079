/// \file
/// The surfaces that cut a mesh into the components of its base complex.
#pragma once

#include <span>
#include <vector>

#include "ovm/hex_mesh.h"
#include "simplify/singularity_graph.h"

namespace hexweft {

/// Spreads surfaces straight across regular edges until they end at singular or boundary edges.
class CutSurfaces {
 public:
  /// Surfaces of all singular edges and of all edges at singular vertices. Closed curves get nodes
  /// (marked as singular vertices in `graph`) until each has three.
  CutSurfaces(const HexMesh& mesh, SingularityGraph& graph);

  /// Adds the surface through a face.
  void cut(FaceHandle f);
  bool is_cut(FaceHandle f) const { return cut_[f.idx]; }
  /// True where a component ends: on a surface, or on the boundary.
  bool is_wall(HalfFaceHandle hf) const { return mesh_.is_boundary(hf) || is_cut(mesh_.face(hf)); }

 private:
  void trace(std::span<const EdgeHandle> seeds);
  void begin_at(HalfFaceHandle hf);
  void cut_at(EdgeHandle e);
  void cut_at_all_traced();
  void spread();
  void add_nodes(const SingularCurve& curve);
  bool is_crossed(const SingularCurve& curve, int i) const;

  const HexMesh& mesh_;
  SingularityGraph& graph_;
  std::vector<char> cut_, traced_, on_singular_edge_;
  std::vector<FaceHandle> front_;
};

}  // namespace hexweft
