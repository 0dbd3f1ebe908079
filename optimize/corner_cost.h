/// \file
/// The energy of one corner as a residual block.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>
#include <ceres/cost_function.h>

#include "optimize/formulations.h"

namespace hexweft {

/// One corner of a hexahedron. Its four vertices: the corner, then those across the three axes.
class CornerCost final : public ceres::CostFunction {
 public:
  CornerCost(const RelaxationProblem& problem, const Energy& energy, std::size_t hex, int corner);

  /// Free ones, each once, in the order of the parameter blocks.
  const std::vector<int>& vertices() const { return vertices_; }

  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override;

 private:
  Deformation<double> deformation(double const* const* x) const;
  void root_residual(const Deformation<double>& d, double& residual,
                     std::array<Mat3<double>, 9>& change) const;
  void write_jacobian(int block, const std::array<Mat3<double>, 9>& change, double* out) const;

  const Energy& energy_;
  bool positive_only_;
  double weight_;
  Eigen::Matrix<double, 3, 4> fixed_;
  std::array<double, 3> scale_;
  std::array<int, 4> slot_;  // parameter block of each vertex, -1 where it is fixed
  std::vector<int> vertices_;
};

}  // namespace hexweft
