#include "optimize/preconditioned_objective.h"

#include <algorithm>
#include <cmath>

namespace hexweft {
namespace {

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

}  // namespace

PreconditionedObjective::PreconditionedObjective(const RelaxationProblem& problem,
                                                 const Energy& energy, double offset)
    : problem_(problem),
      energy_(energy),
      offset_(offset),
      factors_(inverse_factors(problem, energy)),
      points_(problem.points),
      gradient_(3, problem.points.cols()),
      best_points_(problem.points.leftCols(problem.n_free)) {}

bool PreconditionedObjective::Evaluate(const double* y, double* cost, double* gradient) const {
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

}  // namespace hexweft
