// The plain way: one residual block a corner over its four vertices, Levenberg–Marquardt, and a
// sparse Cholesky factorization. An energy that states a residual (|r|² = value − minimum) gives
// nine numbers a corner and with them a Gauss–Newton model; any other gives √(value − minimum).
// Slow, and the yardstick of the others.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include <Eigen/Core>
#include <ceres/cost_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include "optimize/least_squares.h"
#include "ovm/hex_numbering.h"

namespace hexweft {
namespace {

/// One corner of a hexahedron. Its four vertices: the corner, then those across the three axes.
class CornerCost final : public ceres::CostFunction {
 public:
  CornerCost(const RelaxationProblem& problem, const Energy& energy, std::size_t hex, int corner)
      : energy_(energy), positive_only_(energy.barrier() || problem.stay_valid) {
    const TargetCuboid& target = problem.targets[hex];
    weight_ = 2 * target.weight / 8;
    for (int k = 0; k < 4; ++k) {
      const int v = problem.hexes[hex][k == 0 ? corner : kCornerAcross[corner][k - 1]];
      fixed_.col(k) = problem.points.col(v);
      if (k > 0) {
        scale_[k - 1] = (kCornerCoords[corner][k - 1] ? -1 : 1) / target.lengths[k - 1];
      }
      slot_[k] = -1;
      if (v >= problem.n_free) continue;
      const auto known = std::find(vertices_.begin(), vertices_.end(), v);
      slot_[k] = static_cast<int>(known - vertices_.begin());
      if (known == vertices_.end()) vertices_.push_back(v);
    }
    set_num_residuals(energy.model().has_residual() ? 9 : 1);
    mutable_parameter_block_sizes()->assign(vertices_.size(), 3);
  }

  /// Free ones, each once, in the order of the parameter blocks.
  const std::vector<int>& vertices() const { return vertices_; }

  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    const Deformation<double> d = deformation(x);
    if (positive_only_ && !(d.det > 0)) return false;
    std::array<Mat3<double>, 9> change;  // of the residuals, along e_axis e_columnᵀ
    if (energy_.model().has_residual()) {
      Mat3<double> r;
      energy_.model().residual(d, r, jacobians ? change.data() : nullptr);
      const double root = std::sqrt(weight_);
      for (int i = 0; i < 9; ++i) residuals[i] = root * entry(r, i);
      for (auto& c : change) c = combine<double>(root, c, 0, c);
    } else {
      root_residual(d, residuals[0], change);
    }
    for (std::size_t b = 0; jacobians && b < vertices_.size(); ++b) {
      if (jacobians[b]) write_jacobian(static_cast<int>(b), change, jacobians[b]);
    }
    return true;
  }

 private:
  static double entry(const Mat3<double>& m, int i) {
    const Vec3<double>& c = m.col[i / 3];
    return i % 3 == 0 ? c.x : i % 3 == 1 ? c.y : c.z;
  }

  Deformation<double> deformation(double const* const* x) const {
    Eigen::Matrix<double, 3, 4> p = fixed_;
    for (int k = 0; k < 4; ++k) {
      if (slot_[k] >= 0) p.col(k) = Eigen::Map<const Eigen::Vector3d>(x[slot_[k]]);
    }
    Mat3<double> j;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d c = scale_[k] * (p.col(k + 1) - p.col(0));
      j.col[k] = {c[0], c[1], c[2]};
    }
    return make_deformation(j);
  }

  /// √(weight (value − minimum)), kept off zero, where the root has no derivative.
  void root_residual(const Deformation<double>& d, double& residual,
                     std::array<Mat3<double>, 9>& change) const {
    constexpr double kLeast = 1e-12;
    Mat3<double> stress;
    const double excess = energy_.value_and_stress(d, stress) - energy_.minimum();
    residual = std::sqrt(weight_ * std::max(excess, kLeast));
    for (int i = 0; i < 9; ++i) change[i].col[0].x = weight_ * entry(stress, i) / (2 * residual);
  }

  void write_jacobian(int block, const std::array<Mat3<double>, 9>& change, double* out) const {
    const int n = num_residuals();
    std::fill_n(out, 3 * n, 0.0);
    for (int k = 0; k < 4; ++k) {
      if (slot_[k] != block) continue;
      for (int column = 0; column < 3; ++column) {
        const double factor = k == 0 ? -scale_[column] : k == column + 1 ? scale_[column] : 0;
        if (factor == 0) continue;
        for (int axis = 0; axis < 3; ++axis) {
          const Mat3<double>& c = change[3 * column + axis];
          for (int i = 0; i < n; ++i) out[3 * i + axis] += factor * entry(c, i);
        }
      }
    }
  }

  const Energy& energy_;
  bool positive_only_;
  double weight_;
  Eigen::Matrix<double, 3, 4> fixed_;
  std::array<double, 3> scale_;
  std::array<int, 4> slot_;  // parameter block of each vertex, -1 where it is fixed
  std::vector<int> vertices_;
};

}  // namespace

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
