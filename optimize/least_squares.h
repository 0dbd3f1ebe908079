/// \file
/// What the formulations by least squares share: pulls as residual blocks, and one way to run ceres.
#pragma once

#include <Eigen/Core>
#include <ceres/problem.h>
#include <ceres/sized_cost_function.h>
#include <ceres/solver.h>

#include "optimize/formulations.h"

namespace hexweft {

/// √2 metric^½ (x − target): its half square is the pull's energy.
class PullCost final : public ceres::SizedCostFunction<3, 3> {
 public:
  /// \param place  null, or where x is to be read instead of from the parameter block
  explicit PullCost(const VertexPull& pull, const double* place = nullptr);
  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override;

 private:
  Eigen::Matrix3d root_;
  Eigen::Vector3d target_;
  const double* place_;
};

/// Solves, with limits and observer of the options. Stops where the energy hardly falls any more.
/// The blocks' sum may differ from the objective by a constant. On return problem.points has a cost
/// no higher than `cost`, that of the start.
Descent solve_least_squares(RelaxationProblem& problem, const Energy& energy,
                            const RelaxationOptions& options, double cost,
                            ceres::Solver::Options solver, ceres::Problem& ceres_problem);

}  // namespace hexweft
