#include "optimize/corner_cost.h"

#include <algorithm>
#include <cmath>

#include "ovm/hex_numbering.h"

namespace hexweft {
namespace {

double entry(const Mat3<double>& m, int i) {
  const Vec3<double>& c = m.col[i / 3];
  return i % 3 == 0 ? c.x : i % 3 == 1 ? c.y : c.z;
}

}  // namespace

CornerCost::CornerCost(const RelaxationProblem& problem, const Energy& energy, std::size_t hex,
                       int corner)
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

Deformation<double> CornerCost::deformation(double const* const* x) const {
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
void CornerCost::root_residual(const Deformation<double>& d, double& residual,
                               std::array<Mat3<double>, 9>& change) const {
  constexpr double kLeast = 1e-12;
  Mat3<double> stress;
  const double excess = energy_.value_and_stress(d, stress) - energy_.minimum();
  residual = std::sqrt(weight_ * std::max(excess, kLeast));
  for (int i = 0; i < 9; ++i) change[i].col[0].x = weight_ * entry(stress, i) / (2 * residual);
}

void CornerCost::write_jacobian(int block, const std::array<Mat3<double>, 9>& change,
                                double* out) const {
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

bool CornerCost::Evaluate(double const* const* x, double* residuals, double** jacobians) const {
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

}  // namespace hexweft
