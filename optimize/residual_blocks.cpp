// The plain way: one residual block a corner over its four vertices, Levenberg–Marquardt, and a
// sparse Cholesky factorization. An energy that states a residual (|r|² = value − minimum) gives
// nine numbers a corner and with them a Gauss–Newton model; any other gives √(value − minimum).
// Slow, and the yardstick of the others.
#include <memory>
#include <vector>

#include <ceres/problem.h>
#include <ceres/solver.h>

#include "optimize/corner_cost.h"
#include "optimize/least_squares.h"
#include "ovm/hex_numbering.h"

namespace hexweft {
Descent descend_by_residual_blocks(RelaxationProblem& problem, const Energy& energy,
                                   const RelaxationOptions& options, double cost) {
  ceres::Problem::Options ownership;
  ownership.disable_all_safety_checks = true;
  ceres::Problem ceres_problem(ownership);
  std::vector<double*> parameters;
  for (std::size_t h = 0; h < problem.hexes.size(); ++h) {
    for (int c = 0; c < kCorners; ++c) {
      auto block = std::make_unique<CornerCost>(problem, energy, h, c);
      if (block->vertices().empty()) continue;
      parameters.clear();
      for (const int v : block->vertices()) parameters.push_back(&problem.points(0, v));
      ceres_problem.AddResidualBlock(block.release(), nullptr, parameters);
    }
  }
  for (const VertexPull& pull : problem.pulls) {
    if (pull.vertex >= problem.n_free) continue;
    ceres_problem.AddResidualBlock(new PullCost(pull), nullptr, &problem.points(0, pull.vertex));
  }
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  return solve_least_squares(problem, energy, options, cost, solver, ceres_problem);
}

}  // namespace hexweft
