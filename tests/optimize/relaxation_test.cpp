// The objective with its pulls, and the minimizer.
#include "optimize/relaxation.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/optimize/relaxation_problem.h"

namespace hexweft {
namespace {

TEST(Relaxation, GradientOfTheWholeObjectiveAgreesWithDifferences) {
  RelaxationProblem p = make_problem(0.2, 1);
  p.pulls = {plane_pull(3, {1, 2, 3}, Eigen::Vector3d(1, 2, 2) / 3, 100),
             line_pull(5, {2, 1, 1}, Eigen::Vector3d(2, 1, 2) / 3, 50),
             point_pull(7, {1, 1, 1}, 20)};
  for (const Energy& energy : all_energies()) {
    Eigen::Matrix3Xd gradient, x = p.points;
    relaxation_objective(p, energy, x, &gradient);
    constexpr double kStep = 1e-6;
    for (int i = 0; i < 3 * p.n_free; ++i) {
      const double kept = x(i);
      x(i) = kept + kStep;
      const double above = relaxation_objective(p, energy, x, nullptr);
      x(i) = kept - kStep;
      const double below = relaxation_objective(p, energy, x, nullptr);
      x(i) = kept;
      EXPECT_NEAR(gradient(i), (above - below) / (2 * kStep), 1e-5 * (1 + std::abs(gradient(i))));
    }
    EXPECT_EQ(gradient.rightCols(x.cols() - p.n_free).norm(), 0);
  }
}

TEST(Relaxation, BringsAPerturbedGridBackToItsCubes) {
  for (const Energy& energy : all_energies()) {
    RelaxationProblem p = make_problem(0.25, 2);
    const RelaxationProblem perfect = make_problem(0, 2);
    const RelaxationReport r = relax(p, energy, {.max_iterations = 100, .tolerance_rel = 1e-8});
    EXPECT_TRUE(r.feasible);
    EXPECT_LT(r.final_energy, 1e-4 * r.initial_energy);
    EXPECT_LT((p.points - perfect.points).norm(), 0.02);
  }
}

TEST(Relaxation, UntanglesWithTheRegularizedEnergyWhereTheBarrierCannotStart) {
  RelaxationProblem p = make_problem(0.9, 3);
  const Eigen::Matrix3Xd before = p.points;
  EXPECT_FALSE(relax(p, SymmetricDirichlet{}).feasible);
  EXPECT_EQ(p.points, before);
  const auto least = [&] {
    const auto d = min_relative_determinants(p.points, p.hexes, p.targets);
    return *std::min_element(d.begin(), d.end());
  };
  ASSERT_LT(least(), -0.5);
  for (int round = 0; round < 10 && least() <= 0; ++round) {
    FoldoverFree energy;
    energy.epsilon = FoldoverFree::epsilon_for(least());
    relax(p, energy, {.max_iterations = 30});
  }
  EXPECT_GT(least(), 0);
}

TEST(Relaxation, PullsAreFollowedAndFixedVerticesStay) {
  RelaxationProblem p = make_problem(0.1, 4);
  const Eigen::Matrix3Xd before = p.points;
  const Eigen::Vector3d goal = p.points.col(0) + Eigen::Vector3d(0.2, 0.1, 0);
  const Eigen::Vector3d n = Eigen::Vector3d(0, 1, 1).normalized();
  p.pulls = {point_pull(0, goal, 1e5), plane_pull(9, p.points.col(9), n, 1e5)};
  relax(p, SymmetricDirichlet{}, {.max_iterations = 60});
  EXPECT_LT((p.points.col(0) - goal).norm(), 1e-3);
  EXPECT_LT(std::abs(n.dot(p.points.col(9) - before.col(9))), 1e-3);
  EXPECT_EQ(p.points.rightCols(p.points.cols() - p.n_free),
            before.rightCols(p.points.cols() - p.n_free));
}

TEST(Relaxation, NeverEndsHigherThanItStarted) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    RelaxationProblem p = make_problem(0.3, seed);
    for (int k = 0; k < 4; ++k) {
      const RelaxationReport r = relax(p, SymmetricDirichlet{}, {.max_iterations = 3});
      if (!r.feasible) break;
      EXPECT_LE(r.final_energy, r.initial_energy);
    }
  }
}

TEST(Relaxation, SameInputSameBytes) {
  RelaxationProblem a = make_problem(0.2, 5), b = a;
  relax(a, SymmetricDirichlet{});
  relax(b, SymmetricDirichlet{});
  EXPECT_EQ(a.points, b.points);
}

TEST(Relaxation, RefusesBadOptions) {
  RelaxationProblem p = make_problem(0, 1);
  EXPECT_THROW(relax(p, SymmetricDirichlet{}, {.max_iterations = 0}), InputError);
  EXPECT_THROW(relax(p, SymmetricDirichlet{}, {.tolerance_rel = 0}), InputError);
}

}  // namespace
}  // namespace hexweft
