#include "optimize/relaxation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <ceres/first_order_function.h>
#include <ceres/gradient_problem.h>
#include <ceres/gradient_problem_solver.h>

#include "ovm/errors.h"

namespace hexweft {
namespace {

double weight_sum(const RelaxationProblem& p) {
  double sum = 0;
  for (const TargetCuboid& t : p.targets) sum += t.weight;
  return sum;
}

/// Distortion and pulls, without the minimum taken off.
double raw_objective(const RelaxationProblem& problem, const Energy& energy,
                     const Eigen::Matrix3Xd& points, Eigen::Matrix3Xd* gradient) {
  if (gradient) gradient->setZero(3, points.cols());
  double value = hex_energy(energy, points, problem.hexes, problem.targets, gradient);
  if (!std::isfinite(value)) return std::numeric_limits<double>::infinity();
  for (const VertexPull& pull : problem.pulls) {
    const Eigen::Vector3d off = points.col(pull.vertex) - pull.target;
    const Eigen::Vector3d force = pull.metric * off;
    value += off.dot(force);
    if (gradient) gradient->col(pull.vertex) += 2 * force;
  }
  return value;
}

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
    *cost = raw_objective(problem_, energy_, points_, gradient ? &gradient_ : nullptr) - offset_;
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

struct Round {
  double cost;
  int iterations, evaluations;
  bool converged;
};

/// One L-BFGS run from problem.points, which it moves.
Round run_lbfgs(RelaxationProblem& problem, const Energy& energy, double offset, int iterations,
                const RelaxationOptions& options) {
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
  std::vector<double> y(3 * problem.n_free, 0.0);
  ceres::GradientProblemSolver::Summary summary;
  ceres::Solve(solver, ceres_problem, y.data(), &summary);
  problem.points.leftCols(problem.n_free) = objective->best_points();
  return {objective->best_cost(), std::max(0, static_cast<int>(summary.iterations.size()) - 1),
          objective->evaluations(), summary.termination_type == ceres::CONVERGENCE};
}

}  // namespace

VertexPull plane_pull(int vertex, const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
                      double stiffness) {
  return {vertex, stiffness * normal * normal.transpose(), point};
}

VertexPull line_pull(int vertex, const Eigen::Vector3d& point, const Eigen::Vector3d& direction,
                     double stiffness) {
  return {vertex, stiffness * (Eigen::Matrix3d::Identity() - direction * direction.transpose()),
          point};
}

VertexPull point_pull(int vertex, const Eigen::Vector3d& point, double stiffness) {
  return {vertex, stiffness * Eigen::Matrix3d::Identity(), point};
}

void validate(const RelaxationOptions& o) {
  const auto positive = [](const char* what, double value) {
    if (!(value > 0)) {
      throw InputError(std::string(what) + " = " + std::to_string(value) + ", expected > 0");
    }
  };
  positive("max_iterations", o.max_iterations);
  positive("iterations_per_restart", o.iterations_per_restart);
  positive("lbfgs_rank", o.lbfgs_rank);
  positive("tolerance_rel", o.tolerance_rel);
}

double relaxation_objective(const RelaxationProblem& problem, const Energy& energy,
                            const Eigen::Matrix3Xd& points, Eigen::Matrix3Xd* gradient) {
  const double value = raw_objective(problem, energy, points, gradient);
  if (gradient) gradient->rightCols(points.cols() - problem.n_free).setZero();
  return value - energy.minimum() * weight_sum(problem);
}

RelaxationReport relax(RelaxationProblem& problem, const Energy& energy,
                       const RelaxationOptions& options) {
  validate(options);
  RelaxationReport report;
  const double per_hex = problem.hexes.empty() ? 1 : 1.0 / weight_sum(problem);
  const double offset = energy.minimum() * weight_sum(problem);
  double cost = raw_objective(problem, energy, problem.points, nullptr) - offset;
  report.feasible = std::isfinite(cost);
  report.initial_energy = report.final_energy = cost * per_hex;
  if (!report.feasible || problem.n_free == 0) return report;
  while (report.iterations < options.max_iterations) {
    const int n =
        std::min(options.iterations_per_restart, options.max_iterations - report.iterations);
    const Round round = run_lbfgs(problem, energy, offset, n, options);
    report.iterations += round.iterations;
    report.evaluations += round.evaluations;
    const bool stuck = !(round.cost < cost * (1 - options.tolerance_rel)) || round.iterations == 0;
    cost = std::min(cost, round.cost);
    if (round.converged || stuck) break;
  }
  report.final_energy = cost * per_hex;
  return report;
}

}  // namespace hexweft
