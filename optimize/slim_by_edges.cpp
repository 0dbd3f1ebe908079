// Scalable locally injective mapping over mesh edges. The target is a cuboid, so each column of a
// corner's Jacobian is one edge vector, and the quadratic model of the energy splits into a metric
// H and a gradient g an edge: a residual block of 3 numbers and 2 vertices, with H = L Lᵀ, residual
// L⁻¹ g and derivative ±Lᵀ. One more residual, of derivative zero, tops the sum of squares up to the
// energy itself. With it a single Solve() of ceres is the whole iteration of global and local steps,
// with true energy, true gradient, and the model for second derivative: the linear solver is the
// global step, and the evaluation callback follows it by a line search, then renews H and g.
// Source [Rabinovich2017]. Differs: blocks by edges, and a metric without the singular value
// decomposition (hex_edge_terms).
#include <algorithm>
#include <cmath>

#include <ceres/cost_function.h>
#include <ceres/problem.h>
#include <ceres/sized_cost_function.h>
#include <ceres/solver.h>

#include "optimize/least_squares.h"
#include "optimize/local_step.h"

namespace hexweft {
namespace {

class EdgeCost final : public ceres::CostFunction {
 public:
  EdgeCost(const LocalStep& step, int edge, bool both_free) : step_(step), edge_(edge) {
    set_num_residuals(3);
    mutable_parameter_block_sizes()->assign(both_free ? 2 : 1, 3);
  }

  bool Evaluate(double const* const*, double* residuals, double** jacobians) const override {
    if (!step_.feasible()) return false;
    const EdgeModel& m = step_.model(edge_);
    for (int i = 0; i < 3; ++i) residuals[i] = step_.with_models() ? m.residual[i] : 0;
    if (!jacobians) return true;
    const auto& f = m.factor;
    const double transposed[9] = {f[0], f[1], f[3], 0, f[2], f[4], 0, 0, f[5]};
    for (std::size_t k = 0; k < parameter_block_sizes().size(); ++k) {
      if (!jacobians[k]) continue;
      for (int i = 0; i < 9; ++i) jacobians[k][i] = k == 0 ? -transposed[i] : transposed[i];
    }
    return true;
  }

 private:
  const LocalStep& step_;
  int edge_;
};

/// Tops the sum of squares up to the energy. Ceres wants a parameter block; any will do.
class RestCost final : public ceres::SizedCostFunction<1, 3> {
 public:
  explicit RestCost(const LocalStep& step) : step_(step) {}
  bool Evaluate(double const* const*, double* residuals, double** jacobians) const override {
    if (!step_.feasible()) return false;
    residuals[0] = std::sqrt(2 * step_.rest());
    if (jacobians && jacobians[0]) std::fill_n(jacobians[0], 3, 0.0);
    return true;
  }

 private:
  const LocalStep& step_;
};

}  // namespace

Descent descend_by_edges(RelaxationProblem& problem, const Energy& energy,
                         const RelaxationOptions& options, double cost) {
  LocalStep step(problem, energy);
  ceres::Problem::Options ownership;
  ownership.evaluation_callback = &step;
  ownership.disable_all_safety_checks = true;
  ceres::Problem ceres_problem(ownership);
  for (int v = 0; v < problem.n_free; ++v) ceres_problem.AddParameterBlock(step.unknowns(v), 3);
  for (int e = 0; const auto& [low, high] : step.edges().ends) {
    const bool both_free = high < problem.n_free;
    auto* block = new EdgeCost(step, e++, both_free);
    if (both_free) {
      ceres_problem.AddResidualBlock(block, nullptr, step.unknowns(low), step.unknowns(high));
    } else {
      ceres_problem.AddResidualBlock(block, nullptr, step.unknowns(low));
    }
  }
  ceres_problem.AddResidualBlock(new RestCost(step), nullptr, step.unknowns(0));
  for (const VertexPull& pull : problem.pulls) {
    if (pull.vertex >= problem.n_free) continue;
    ceres_problem.AddResidualBlock(new PullCost(pull, &problem.points(0, pull.vertex)), nullptr,
                                   step.unknowns(pull.vertex));
  }
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::CGNR;
  solver.preconditioner_type = ceres::JACOBI;
  solver.eta = 0.1;
  return solve_least_squares(problem, energy, options, cost, solver, ceres_problem);
}

}  // namespace hexweft
