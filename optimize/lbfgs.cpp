// Preconditioned L-BFGS. The unknowns are changed to y with x = x0 + L⁻ᵀ y, where L Lᵀ is each
// vertex's 3 × 3 block of the second derivative, pulls included; that evens out edge lengths and
// stiff pulls. The blocks are renewed, and L-BFGS restarted, every few iterations. Direction and
// line search are those of ceres.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Core>
#include <ceres/first_order_function.h>
#include <ceres/gradient_problem.h>
#include <ceres/gradient_problem_solver.h>
#include <ceres/iteration_callback.h>

#include "optimize/formulations.h"

namespace hexweft {
namespace {

/// L⁻¹ (lower triangular) of each free vertex's block, packed 00, 10, 11, 20, 21, 22.
using PackedFactors = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// Cholesky by hand: blocks are positive, but close to singular on near-degenerate elements, where
/// a little of the trace is added.
void invert_factor(const double* block, double* out) {
  const double floor = 1e-10 * (block[0] + block[3] + block[5]) + 1e-300;
  const double l00 = std::sqrt(std::max(block[0], floor));
  const double l10 = block[1] / l00, l20 = block[2] / l00;
  const double l11 = std::sqrt(std::max(block[3] - l10 * l10, floor));
  const double l21 = (block[4] - l20 * l10) / l11;
  const double l22 = std::sqrt(std::max(block[5] - l20 * l20 - l21 * l21, floor));
  out[0] = 1 / l00;
  out[2] = 1 / l11;
  out[5] = 1 / l22;
  out[1] = -l10 * out[0] / l11;
  out[4] = -l21 * out[2] / l22;
  out[3] = -(l20 * out[0] + l21 * out[1]) / l22;
}

PackedFactors inverse_factors(const RelaxationProblem& problem, const Energy& energy) {
  PackedFactors blocks = PackedFactors::Zero(6, problem.points.cols());
  add_hex_curvature(energy, problem.points, problem.hexes, problem.targets, blocks);
  for (const VertexPull& pull : problem.pulls) {
    const Eigen::Matrix3d& m = pull.metric;
    auto b = blocks.col(pull.vertex);
    b[0] += 2 * m(0, 0);
    b[1] += 2 * m(0, 1);
    b[2] += 2 * m(0, 2);
    b[3] += 2 * m(1, 1);
    b[4] += 2 * m(1, 2);
    b[5] += 2 * m(2, 2);
  }
  PackedFactors factors(6, problem.n_free);
  for (int v = 0; v < problem.n_free; ++v) invert_factor(&blocks(0, v), &factors(0, v));
  return factors;
}

/// The objective in the unknowns y. Remembers the lowest point it has seen, so that a line search
/// that gives up loses nothing.
class PreconditionedObjective final : public ceres::FirstOrderFunction {
 public:
  PreconditionedObjective(const RelaxationProblem& problem, const Energy& energy, double offset)
      : problem_(problem),
        energy_(energy),
        offset_(offset),
        factors_(inverse_factors(problem, energy)),
        points_(problem.points),
        gradient_(3, problem.points.cols()),
        best_points_(problem.points.leftCols(problem.n_free)) {}

  int NumParameters() const override { return 3 * problem_.n_free; }

  bool Evaluate(const double* y, double* cost, double* gradient) const override {
    ++evaluations_;
    for (int v = 0; v < problem_.n_free; ++v) {
      const double *f = &factors_(0, v), *u = y + 3 * v;
      points_(0, v) = problem_.points(0, v) + f[0] * u[0] + f[1] * u[1] + f[3] * u[2];
      points_(1, v) = problem_.points(1, v) + f[2] * u[1] + f[4] * u[2];
      points_(2, v) = problem_.points(2, v) + f[5] * u[2];
    }
    *cost =
        distortion_and_pulls(problem_, energy_, points_, gradient ? &gradient_ : nullptr) - offset_;
    if (!std::isfinite(*cost)) return false;
    if (*cost < best_cost_) {
      best_cost_ = *cost;
      best_points_ = points_.leftCols(problem_.n_free);
    }
    for (int v = 0; gradient && v < problem_.n_free; ++v) {
      const double *f = &factors_(0, v), *g = &gradient_(0, v);
      gradient[3 * v] = f[0] * g[0];
      gradient[3 * v + 1] = f[1] * g[0] + f[2] * g[1];
      gradient[3 * v + 2] = f[3] * g[0] + f[4] * g[1] + f[5] * g[2];
    }
    return true;
  }

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
