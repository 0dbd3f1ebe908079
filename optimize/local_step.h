/// \file
/// The local step of SLIM by edges: where the points go along a proposed step, and what each mesh
/// edge says of the energy there. slim_by_edges.cpp has the idea.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Core>
#include <ceres/evaluation_callback.h>

#include "optimize/formulations.h"

namespace hexweft {

/// The edges that move, each once, and where every hexahedron finds its own.
struct EdgeTable {
  std::vector<std::array<int, 2>> ends;  ///< vertices, lesser first
  std::vector<HexEdges> of_hex;          ///< edges that do not move share the index ends.size()
};
EdgeTable make_edge_table(const RelaxationProblem& problem);

/// What the blocks of one edge say at the current point: residual L⁻¹ g, and L by rows 00, 10, 11,
/// 20, 21, 22.
struct EdgeModel {
  std::array<double, 3> residual;
  std::array<double, 6> factor;
};

/// The local step: takes the energy downhill along the step ceres proposes, and renews the edge
/// models where it arrives. The unknowns of ceres are sums of its full steps; the points, sums of
/// what a line search left of them.
class LocalStep final : public ceres::EvaluationCallback {
 public:
  LocalStep(RelaxationProblem& problem, const Energy& energy);

  void PrepareForEvaluation(bool jacobians, bool new_point) override;

  double* unknowns(int vertex) { return &unknowns_(0, vertex); }
  bool feasible() const { return std::isfinite(distortion_); }
  const EdgeTable& edges() const { return edges_; }
  const EdgeModel& model(int edge) const { return models_[edge]; }
  /// Ceres asks for the cost alone at a trial point; the edges then stay out of it.
  bool with_models() const { return with_models_; }
  /// Half the square of the residual that tops up to the energy plus a constant.
  double rest() const {
    return std::max(0.0, distortion_ + headroom_ - (with_models_ ? model_cost_ : 0.0));
  }

 private:
  void renew_models();
  void search_line();
  double slope() const;

  RelaxationProblem& problem_;
  const Energy& energy_;
  double least_;
  EdgeTable edges_;
  EdgeTerms terms_;
  std::vector<EdgeModel> models_;
  Eigen::Matrix3Xd unknowns_, base_unknowns_, step_, base_;
  double distortion_ = 0, model_cost_ = 0, headroom_ = 0, base_cost_ = 0;
  bool with_models_ = false;
};

}  // namespace hexweft
