#include "optimize/local_step.h"

#include <algorithm>
#include <cstdint>

#include "ovm/hex_numbering.h"

namespace hexweft {
namespace {

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

constexpr std::uint64_t kUnmoved = ~std::uint64_t{0};

/// An edge of one hexahedron, by its two vertices.
struct EdgeUse {
  std::uint64_t ends;  ///< lesser vertex · 2³² + greater one, or kUnmoved
  int slot;            ///< 12 · hexahedron + edge
};

std::vector<EdgeUse> sorted_edge_uses(const RelaxationProblem& problem) {
  std::vector<EdgeUse> uses;
  uses.reserve(kHexEdges * problem.hexes.size());
  for (const HexCorners& hex : problem.hexes) {
    for (const auto& [from, to] : kEdgeCorners) {
      const auto [low, high] = std::minmax(hex[from], hex[to]);
      const bool moves = low < problem.n_free && low != high;
      const std::uint64_t ends = (static_cast<std::uint64_t>(low) << 32) + high;
      uses.push_back({moves ? ends : kUnmoved, static_cast<int>(uses.size())});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
    return a.ends != b.ends ? a.ends < b.ends : a.slot < b.slot;
  });
  return uses;
}

}  // namespace

EdgeTable make_edge_table(const RelaxationProblem& problem) {
  const std::vector<EdgeUse> uses = sorted_edge_uses(problem);
  EdgeTable table;
  table.of_hex.resize(problem.hexes.size());
  const EdgeUse* last = nullptr;
  for (const EdgeUse& use : uses) {
    const auto h = static_cast<std::size_t>(use.slot / kHexEdges);
    const int e = use.slot % kHexEdges;
    if (use.ends == kUnmoved) {  // these come last
      table.of_hex[h][e] = static_cast<int>(table.ends.size());
      continue;
    }
    const int low = static_cast<int>(use.ends >> 32);
    if (!last || use.ends != last->ends) {
      table.ends.push_back({low, static_cast<int>(use.ends & 0xffffffff)});
    }
    last = &use;
    const int edge = static_cast<int>(table.ends.size()) - 1;
    table.of_hex[h][e] = problem.hexes[h][kEdgeCorners[e][0]] == low ? edge : ~edge;
  }
  return table;
}

LocalStep::LocalStep(RelaxationProblem& problem, const Energy& energy)
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

void LocalStep::PrepareForEvaluation(bool jacobians, bool /*new_point*/) {
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

}  // namespace hexweft
