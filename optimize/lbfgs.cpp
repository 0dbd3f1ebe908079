// L-BFGS in the unknowns of PreconditionedObjective, which are renewed, and L-BFGS restarted, every
// few iterations. Direction and line search are those of ceres.
#include <algorithm>
#include <vector>

#include <ceres/gradient_problem.h>
#include <ceres/gradient_problem_solver.h>
#include <ceres/iteration_callback.h>

#include "optimize/formulations.h"
#include "optimize/preconditioned_objective.h"

namespace hexweft {
namespace {

/// Tells the observer.
class Reporter final : public ceres::IterationCallback {
 public:
  Reporter(const RelaxationOptions& options, double per_hex, int before)
      : options_(options), per_hex_(per_hex), before_(before) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& s) override {
    if (s.iteration > 0) options_.observer({before_ + s.iteration, s.cost * per_hex_});
    return ceres::SOLVER_CONTINUE;
  }

 private:
  const RelaxationOptions& options_;
  double per_hex_;
  int before_;
};

struct Round {
  double cost;
  int iterations, evaluations;
  bool converged;
};

/// One L-BFGS run from problem.points, which it moves. \param before  iterations already done
Round run_lbfgs(RelaxationProblem& problem, const Energy& energy, double offset, int iterations,
                int before, const RelaxationOptions& options) {
  auto* objective =
      new PreconditionedObjective(problem, energy, offset);  // the ceres problem owns it
  const ceres::GradientProblem ceres_problem(objective);
  ceres::GradientProblemSolver::Options solver;
  solver.logging_type = ceres::SILENT;
  solver.line_search_direction_type = ceres::LBFGS;
  solver.line_search_type = ceres::WOLFE;
  solver.use_approximate_eigenvalue_bfgs_scaling = true;  // a fifth fewer evaluations
  solver.max_lbfgs_rank = options.lbfgs_rank;
  solver.max_num_iterations = iterations;
  solver.function_tolerance = options.tolerance_rel;
  solver.gradient_tolerance = 1e-12;
  solver.parameter_tolerance = 1e-12;
  Reporter reporter(options, energy_per_hex(problem), before);
  if (options.observer) solver.callbacks.push_back(&reporter);
  std::vector<double> y(3 * problem.n_free, 0.0);
  ceres::GradientProblemSolver::Summary summary;
  ceres::Solve(solver, ceres_problem, y.data(), &summary);
  problem.points.leftCols(problem.n_free) = objective->best_points();
  return {objective->best_cost(), std::max(0, static_cast<int>(summary.iterations.size()) - 1),
          objective->evaluations(), summary.termination_type == ceres::CONVERGENCE};
}

}  // namespace

Descent descend_by_lbfgs(RelaxationProblem& problem, const Energy& energy,
                         const RelaxationOptions& options, double cost) {
  Descent done{cost};
  const double offset = least_energy(problem, energy);
  while (done.iterations < options.max_iterations) {
    const int n =
        std::min(options.iterations_per_restart, options.max_iterations - done.iterations);
    const Round round = run_lbfgs(problem, energy, offset, n, done.iterations, options);
    done.iterations += round.iterations;
    done.evaluations += round.evaluations;
    const bool stuck =
        !(round.cost < done.cost * (1 - options.tolerance_rel)) || round.iterations == 0;
    done.cost = std::min(done.cost, round.cost);
    if (round.converged || stuck) break;
  }
  return done;
}

}  // namespace hexweft
