#include "optimize/least_squares.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <ceres/iteration_callback.h>

namespace hexweft {
namespace {

/// Tells the observer, and stops where the energy hardly falls any more.
class Watch final : public ceres::IterationCallback {
 public:
  Watch(const RelaxationOptions& options, double per_hex, double cost)
      : options_(options), per_hex_(per_hex), cost_(cost) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& s) override {
    if (s.iteration == 0) {
      difference_ = cost_ - s.cost;
      return ceres::SOLVER_CONTINUE;
    }
    const double cost = std::min(cost_, s.cost + difference_);
    if (options_.observer) options_.observer({s.iteration, cost * per_hex_});
    const bool settled = s.step_is_successful && cost > cost_ * (1 - options_.tolerance_rel);
    cost_ = cost;
    return settled ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }

 private:
  const RelaxationOptions& options_;
  double per_hex_, cost_, difference_ = 0;
};

}  // namespace

PullCost::PullCost(const VertexPull& pull, const double* place)
    : target_(pull.target), place_(place) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(2 * pull.metric);
  root_ =
      eigen.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal() * eigen.eigenvectors().transpose();
}

bool PullCost::Evaluate(double const* const* x, double* residuals, double** jacobians) const {
  Eigen::Map<Eigen::Vector3d>{residuals} =
      root_ * (Eigen::Map<const Eigen::Vector3d>(place_ ? place_ : x[0]) - target_);
  if (jacobians && jacobians[0]) {
    Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>{jacobians[0]} = root_;
  }
  return true;
}

Descent solve_least_squares(RelaxationProblem& problem, const Energy& energy,
                            const RelaxationOptions& options, double cost,
                            ceres::Solver::Options solver, ceres::Problem& ceres_problem) {
  const Eigen::Matrix3Xd start = problem.points;
  Watch watch(options, energy_per_hex(problem), cost);
  solver.logging_type = ceres::SILENT;
  solver.max_num_iterations = options.max_iterations;
  solver.function_tolerance = 0;
  solver.gradient_tolerance = 1e-14;
  solver.parameter_tolerance = 1e-12;
  solver.callbacks.push_back(&watch);
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &ceres_problem, &summary);
  Descent done{distortion_and_pulls(problem, energy, problem.points, nullptr) -
                   least_energy(problem, energy),
               std::max(0, static_cast<int>(summary.iterations.size()) - 1),
               summary.num_residual_evaluations};
  if (!(done.cost <= cost)) {
    done.cost = cost;
    problem.points = start;
  }
  return done;
}

}  // namespace hexweft
