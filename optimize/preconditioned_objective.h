/// \file
/// The objective of a relaxation in unknowns that make it easy to minimize.
#pragma once

#include <limits>

#include <Eigen/Core>
#include <ceres/first_order_function.h>

#include "optimize/formulations.h"

namespace hexweft {

/// L⁻¹ (lower triangular) of each free vertex's block, packed 00, 10, 11, 20, 21, 22.
using PackedFactors = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// The objective in unknowns y with x = x0 + L⁻ᵀ y, where L Lᵀ is each vertex's 3 × 3 block of the
/// second derivative at x0, pulls included; that evens out edge lengths and stiff pulls. Remembers
/// the lowest point it has seen, so that a line search that gives up loses nothing.
class PreconditionedObjective final : public ceres::FirstOrderFunction {
 public:
  /// \param offset  taken off the objective
  PreconditionedObjective(const RelaxationProblem& problem, const Energy& energy, double offset);

  int NumParameters() const override { return 3 * problem_.n_free; }

  bool Evaluate(const double* y, double* cost, double* gradient) const override;

  double best_cost() const { return best_cost_; }
  const Eigen::Matrix3Xd& best_points() const { return best_points_; }
  int evaluations() const { return evaluations_; }

 private:
  const RelaxationProblem& problem_;
  const Energy& energy_;
  double offset_;
  PackedFactors factors_;
  mutable Eigen::Matrix3Xd points_, gradient_, best_points_;
  mutable double best_cost_ = std::numeric_limits<double>::infinity();
  mutable int evaluations_ = 0;
};

}  // namespace hexweft
