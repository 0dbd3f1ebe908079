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
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <ceres/cost_function.h>
#include <ceres/evaluation_callback.h>
#include <ceres/problem.h>
#include <ceres/sized_cost_function.h>
#include <ceres/solver.h>

#include "optimize/least_squares.h"
#include "ovm/hex_numbering.h"

namespace hexweft {
namespace {

/// The edges that move, each once, and where every hexahedron finds its own.
struct EdgeTable {
  std::vector<std::array<int, 2>> ends;  ///< vertices, lesser first
  std::vector<HexEdges> of_hex;          ///< edges that do not move share the index ends.size()
};

EdgeTable make_edge_table(const RelaxationProblem& problem) {
  struct Use {
    std::uint64_t ends;
    int slot;  // 12 · hexahedron + edge
    bool operator<(const Use& other) const {
      return ends != other.ends ? ends < other.ends : slot < other.slot;
    }
  };
  std::vector<Use> uses;
  uses.reserve(12 * problem.hexes.size());
  EdgeTable table;
  table.of_hex.resize(problem.hexes.size());
  for (std::size_t h = 0; h < problem.hexes.size(); ++h) {
    for (int e = 0; e < kHexEdges; ++e) {
      const auto [low, high] =
          std::minmax(problem.hexes[h][kEdgeCorners[e][0]], problem.hexes[h][kEdgeCorners[e][1]]);
      const std::uint64_t ends = (static_cast<std::uint64_t>(low) << 32) + high;
      const bool moves = low < problem.n_free && low != high;
      uses.push_back({moves ? ends : ~std::uint64_t{0}, static_cast<int>(12 * h) + e});
    }
  }
  std::sort(uses.begin(), uses.end());
  std::uint64_t last = ~std::uint64_t{0};
  for (const Use& use : uses) {
    const auto h = static_cast<std::size_t>(use.slot / 12);
    const int e = use.slot % 12;
    const int low = static_cast<int>(use.ends >> 32);
    if (use.ends == ~std::uint64_t{0}) {
      table.of_hex[h][e] = static_cast<int>(table.ends.size());
      continue;
    }
    if (use.ends != last) table.ends.push_back({low, static_cast<int>(use.ends & 0xffffffff)});
    last = use.ends;
    const int edge = static_cast<int>(table.ends.size()) - 1;
    table.of_hex[h][e] = problem.hexes[h][kEdgeCorners[e][0]] == low ? edge : ~edge;
  }
  return table;
}

/// What the blocks of one edge say at the current point: residual L⁻¹ g, and L by rows 00, 10, 11,
/// 20, 21, 22.
struct EdgeModel {
  std::array<double, 3> residual;
  std::array<double, 6> factor;
};

/// Cholesky by hand: a little of the trace keeps metrics of near-degenerate elements positive.
EdgeModel make_edge_model(const double* terms) {
  const double *g = terms, *h = terms + 3;
  const double floor = 1e-10 * (h[0] + h[3] + h[5]) + 1e-300;
  const double l00 = std::sqrt(std::max(h[0], floor));
  const double l10 = h[1] / l00, l20 = h[2] / l00;
  const double l11 = std::sqrt(std::max(h[3] - l10 * l10, floor));
  const double l21 = (h[4] - l20 * l10) / l11;
  const double l22 = std::sqrt(std::max(h[5] - l20 * l20 - l21 * l21, floor));
  const double r0 = g[0] / l00, r1 = (g[1] - l10 * r0) / l11;
  return {{r0, r1, (g[2] - l20 * r0 - l21 * r1) / l22}, {l00, l10, l11, l20, l21, l22}};
}

/// The local step: takes the energy downhill along the step ceres proposes, and renews the edge
/// models where it arrives. The unknowns of ceres are sums of its full steps; the points, sums of
/// what a line search left of them.
class LocalStep final : public ceres::EvaluationCallback {
 public:
  LocalStep(RelaxationProblem& problem, const Energy& energy)
      : problem_(problem),
        energy_(energy),
        least_(least_energy(problem, energy)),
        edges_(make_edge_table(problem)),
        terms_(9, static_cast<Eigen::Index>(edges_.ends.size()) + 1),
        models_(edges_.ends.size()),
        unknowns_(Eigen::Matrix3Xd::Zero(3, problem.n_free)),
        base_unknowns_(unknowns_),
        step_(unknowns_),
        base_(problem.points) {
    renew_models();
    headroom_ = 4 * model_cost_;
  }

  void PrepareForEvaluation(bool jacobians, bool /*new_point*/) override {
    if (!jacobians) {
      search_line();
    } else if (unknowns_ != base_unknowns_) {  // the trial has been accepted
      base_ = problem_.points;
      base_unknowns_ = unknowns_;
      renew_models();
    } else {
      problem_.points = base_;
      renew_models();
    }
  }

  double* unknowns(int vertex) { return &unknowns_(0, vertex); }
  bool feasible() const { return std::isfinite(distortion_); }
  const EdgeTable& edges() const { return edges_; }
  const EdgeModel& model(int edge) const { return models_[edge]; }
  /// Ceres asks for the cost alone at a trial point; the edges then stay out of it.
  bool with_models() const { return with_models_; }
  /// Half the square of the residual that tops up to the energy plus a constant.
  double rest() const {
    return std::max(0.0, distortion_ + headroom_ - (with_models_ ? model_cost_ : 0.0));
  }

 private:
  void renew_models();
  void search_line();
  double slope() const;

  RelaxationProblem& problem_;
  const Energy& energy_;
  double least_;
  EdgeTable edges_;
  EdgeTerms terms_;
  std::vector<EdgeModel> models_;
  Eigen::Matrix3Xd unknowns_, base_unknowns_, step_, base_;
  double distortion_ = 0, model_cost_ = 0, headroom_ = 0, base_cost_ = 0;
  bool with_models_ = false;
};

void LocalStep::renew_models() {
  with_models_ = true;
  terms_.setZero();
  distortion_ =
      hex_edge_terms(energy_, problem_.points, problem_.hexes, problem_.targets, edges_.of_hex,
                     terms_, InstructionSet::automatic, problem_.stay_valid) -
      least_;
  if (!feasible()) return;
  base_cost_ = distortion_ + pull_energy(problem_, problem_.points, nullptr);
  model_cost_ = 0;
  for (std::size_t e = 0; e < models_.size(); ++e) {
    models_[e] = make_edge_model(terms_.col(static_cast<Eigen::Index>(e)).data());
    for (const double r : models_[e].residual) model_cost_ += 0.5 * r * r;
  }
}

/// The derivative of the objective along the step, at its start.
double LocalStep::slope() const {
  double sum = 0;
  for (std::size_t e = 0; e < edges_.ends.size(); ++e) {
    const auto [low, high] = edges_.ends[e];
    Eigen::Vector3d along = -step_.col(low);
    if (high < problem_.n_free) along += step_.col(high);
    sum += along.dot(terms_.col(static_cast<Eigen::Index>(e)).head<3>());
  }
  for (const VertexPull& pull : problem_.pulls) {
    if (pull.vertex >= problem_.n_free) continue;
    const Eigen::Vector3d off = base_.col(pull.vertex) - pull.target;
    sum += 2 * step_.col(pull.vertex).dot(pull.metric * off);
  }
  return sum;
}

/// Backtracks to the least of the parabola through what is known, until the energy falls.
void LocalStep::search_line() {
  constexpr double kSufficient = 1e-4;
  constexpr int kMaxTrials = 12;
  with_models_ = false;
  step_ = unknowns_ - base_unknowns_;
  const double descent = slope();
  double fraction = 1;
  for (int trial = 0; trial < kMaxTrials; ++trial) {
    problem_.points.leftCols(problem_.n_free) = base_.leftCols(problem_.n_free) + fraction * step_;
    distortion_ = hex_energy(energy_, problem_.points, problem_.hexes, problem_.targets, nullptr,
                             InstructionSet::automatic, problem_.stay_valid) -
                  least_;
    const double gain = base_cost_ - distortion_ - pull_energy(problem_, problem_.points, nullptr);
    if (gain >= -kSufficient * fraction * descent) return;
    const double parabola = std::isfinite(gain)
                                ? 0.5 * fraction * descent / (descent + gain / fraction)
                                : 0.25 * fraction;
    fraction = std::clamp(parabola, 0.1 * fraction, 0.5 * fraction);
  }
}

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
