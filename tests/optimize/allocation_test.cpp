// Nothing is allocated between the solver's steps. Linked so that calls of malloc and operator new
// from object files, hexweft's among them, come here first.
#include <cstddef>
#include <cstdlib>
#include <vector>

#include <gtest/gtest.h>

#include "optimize/corner_cost.h"
#include "optimize/least_squares.h"
#include "optimize/local_step.h"
#include "optimize/preconditioned_objective.h"
#include "tests/optimize/relaxation_problem.h"

// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming): the linker's names
namespace {
long allocations = 0;
}
extern "C" {
void* __real_malloc(std::size_t size);
void* __real__Znwm(std::size_t size);
void* __real__Znam(std::size_t size);
void* __wrap_malloc(std::size_t size) {
  ++allocations;
  return __real_malloc(size);
}
void* __wrap__Znwm(std::size_t size) {
  ++allocations;
  return __real__Znwm(size);
}
void* __wrap__Znam(std::size_t size) {
  ++allocations;
  return __real__Znam(size);
}
}
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)

namespace hexweft {
namespace {

RelaxationProblem sample() {
  RelaxationProblem p = make_problem(0.2, 1);
  p.pulls = {point_pull(0, {1, 1, 1}, 2), plane_pull(9, {1, 2, 3}, {0, 0, 1}, 100)};
  return p;
}

TEST(Allocations, AreCounted) {
  const long before = allocations;
  const RelaxationProblem p = sample();
  EXPECT_GT(allocations, before);
}

TEST(Allocations, NoneInAnEvaluationOverHexahedra) {
  const RelaxationProblem p = sample();
  Eigen::Matrix3Xd gradient(3, p.points.cols());
  Eigen::Matrix<double, 6, Eigen::Dynamic> blocks(6, p.points.cols());
  for (const Energy& energy : all_energies()) {
    const long before = allocations;
    hex_energy(energy, p.points, p.hexes, p.targets, &gradient);
    relaxation_objective(p, energy, p.points, &gradient);
    add_hex_curvature(energy, p.points, p.hexes, p.targets, blocks);
    EXPECT_EQ(allocations, before) << energy.name();
  }
}

TEST(Allocations, NoneInAnEvaluationOfLbfgs) {
  const RelaxationProblem p = sample();
  for (const Energy& energy : all_energies()) {
    const PreconditionedObjective objective(p, energy, 0);
    std::vector<double> y(objective.NumParameters(), 0.01), gradient(y.size());
    double cost = 0;
    const long before = allocations;
    EXPECT_TRUE(objective.Evaluate(y.data(), &cost, gradient.data()));
    EXPECT_TRUE(objective.Evaluate(y.data(), &cost, nullptr));
    EXPECT_EQ(allocations, before) << energy.name();
  }
}

TEST(Allocations, NoneInALocalStepOverEdges) {
  for (const Energy& energy : all_energies()) {
    RelaxationProblem p = sample();
    LocalStep step(p, energy);
    const long before = allocations;
    for (int trial = 0; trial < 3; ++trial) {
      step.unknowns(0)[0] += 0.01;
      step.PrepareForEvaluation(false, true);
      step.PrepareForEvaluation(true, false);
    }
    EXPECT_EQ(allocations, before) << energy.name();
  }
}

TEST(Allocations, NoneInAResidualBlock) {
  const RelaxationProblem p = sample();
  for (const Energy& energy : all_energies()) {
    const CornerCost corner(p, energy, 21, 0);
    const PullCost pull(p.pulls[0]);
    ASSERT_EQ(corner.vertices().size(), 4u);
    const double* x[4];
    double residuals[9], jacobian[4][27];
    double* jacobians[4] = {jacobian[0], jacobian[1], jacobian[2], jacobian[3]};
    for (int k = 0; k < 4; ++k) x[k] = &p.points(0, corner.vertices()[k]);
    const long before = allocations;
    EXPECT_TRUE(corner.Evaluate(x, residuals, jacobians));
    EXPECT_TRUE(pull.Evaluate(x, residuals, jacobians));
    EXPECT_EQ(allocations, before) << energy.name();
  }
}

}  // namespace
}  // namespace hexweft
