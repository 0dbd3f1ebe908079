// The ways to pose a relaxation find the same minimum; groups and validity hold in each.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "optimize/corner_cost.h"
#include "optimize/least_squares.h"
#include "optimize/preconditioned_objective.h"
#include "optimize/relaxation.h"
#include "optimize/vertex_groups.h"
#include "ovm/errors.h"
#include "tests/optimize/relaxation_problem.h"

namespace hexweft {
namespace {

constexpr Formulation kFormulations[] = {Formulation::lbfgs, Formulation::slim_by_edges,
                                         Formulation::residual_blocks};

RelaxationOptions thorough(Formulation formulation) {
  return {.formulation = formulation, .max_iterations = 200, .tolerance_rel = 1e-9};
}

double least_determinant(const RelaxationProblem& p) {
  const auto d = min_relative_determinants(p.points, p.hexes, p.targets);
  return *std::min_element(d.begin(), d.end());
}

class EveryFormulation : public testing::TestWithParam<Formulation> {};

TEST_P(EveryFormulation, BringsAPerturbedGridBackToItsCubesWithEveryEnergy) {
  for (const Energy& energy : all_energies()) {
    SCOPED_TRACE(energy.name());
    RelaxationProblem p = make_problem(0.25, 2);
    const RelaxationProblem perfect = make_problem(0, 2);
    const RelaxationReport r = relax(p, energy, thorough(GetParam()));
    EXPECT_TRUE(r.feasible);
    EXPECT_GT(r.iterations, 0);
    EXPECT_GT(r.evaluations, 0);
    EXPECT_LT(r.final_energy, 1e-3 * r.initial_energy);
    EXPECT_LT((p.points - perfect.points).norm(), 0.1);
  }
}

TEST_P(EveryFormulation, FindsTheMinimumThatLbfgsFinds) {
  RelaxationProblem start = make_problem(0.2, 3);
  for (TargetCuboid& t : start.targets) t.lengths = {0.8, 1.1, 1.3};
  start.pulls = {plane_pull(3, {1, 2, 3}, Eigen::Vector3d(1, 2, 2) / 3, 3),
                 line_pull(5, {2, 1, 1}, Eigen::Vector3d(2, 1, 2) / 3, 5),
                 point_pull(7, {1.2, 1, 1}, 2)};
  RelaxationProblem a = start, b = start;
  const double expected = relax(a, SymmetricDirichlet{}, thorough(Formulation::lbfgs)).final_energy;
  const double got = relax(b, SymmetricDirichlet{}, thorough(GetParam())).final_energy;
  EXPECT_NEAR(got, expected, 1e-6 * expected);
  EXPECT_LT((a.points - b.points).cwiseAbs().maxCoeff(), 1e-2);
}

TEST_P(EveryFormulation, NeverEndsHigherThanItStartedAndReportsTheEnergyOfThePoints) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    RelaxationProblem p = make_problem(0.3, seed);
    for (int k = 0; k < 4; ++k) {
      const RelaxationReport r =
          relax(p, SymmetricDirichlet{}, {.formulation = GetParam(), .max_iterations = 3});
      if (!r.feasible) break;
      EXPECT_LE(r.final_energy, r.initial_energy);
      const double energy = relaxation_objective(p, SymmetricDirichlet{}, p.points, nullptr);
      EXPECT_NEAR(r.final_energy * static_cast<double>(p.hexes.size()), energy, 1e-9 * energy);
    }
  }
}

TEST_P(EveryFormulation, TellsTheObserverAnEnergyThatOnlyFalls) {
  RelaxationProblem p = make_problem(0.25, 6);
  RelaxationOptions options = thorough(GetParam());
  std::vector<RelaxationProgress> seen;
  options.observer = [&](const RelaxationProgress& progress) { seen.push_back(progress); };
  const RelaxationReport r = relax(p, SymmetricDirichlet{}, options);
  ASSERT_FALSE(seen.empty());
  double last = r.initial_energy;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    EXPECT_EQ(seen[i].iteration, static_cast<int>(i) + 1);
    EXPECT_LE(seen[i].energy, last * (1 + 1e-9));
    last = seen[i].energy;
  }
  EXPECT_NEAR(last, r.final_energy, 1e-9 + 1e-6 * r.final_energy);
}

TEST_P(EveryFormulation, PullsAreFollowedAndFixedVerticesStay) {
  RelaxationProblem p = make_problem(0.1, 4);
  const Eigen::Matrix3Xd before = p.points;
  const Eigen::Vector3d goal = p.points.col(0) + Eigen::Vector3d(0.2, 0.1, 0);
  const Eigen::Vector3d n = Eigen::Vector3d(0, 1, 1).normalized();
  p.pulls = {point_pull(0, goal, 1e5), plane_pull(9, p.points.col(9), n, 1e5)};
  relax(p, SymmetricDirichlet{}, {.formulation = GetParam(), .max_iterations = 60});
  EXPECT_LT((p.points.col(0) - goal).norm(), 1e-3);
  EXPECT_LT(std::abs(n.dot(p.points.col(9) - before.col(9))), 1e-3);
  EXPECT_EQ(p.points.rightCols(p.points.cols() - p.n_free),
            before.rightCols(p.points.cols() - p.n_free));
}

TEST_P(EveryFormulation, GroupedVerticesShareTheBestPlaceForAll) {
  RelaxationProblem p = make_problem(0.15, 5);
  p.groups = {{0, 1}};
  std::erase_if(p.hexes, [](const HexCorners& h) {  // those that lose their volume
    return std::count(h.begin(), h.end(), 0) > 0 && std::count(h.begin(), h.end(), 1) > 0;
  });
  p.targets.resize(p.hexes.size());
  RelaxationProblem together = p;
  const RelaxationReport r = relax(together, FoldoverFree{}, thorough(GetParam()));
  EXPECT_TRUE(r.feasible);
  EXPECT_EQ(together.points.col(0), together.points.col(1));
  EXPECT_NE(together.points.col(0), p.points.col(0));
  GroupedProblem end = merge_groups(together);
  Eigen::Matrix3Xd gradient;
  relaxation_objective(end.problem, FoldoverFree{}, end.problem.points, &gradient);
  EXPECT_LT(gradient.norm(), 0.05);
}

TEST_P(EveryFormulation, StaysValidWithAnEnergyThatHasNoBarrierIfAskedTo) {
  RelaxationProblem p = make_problem(0.1, 7);
  p.stay_valid = true;
  p.pulls = {point_pull(0, p.points.col(0) + Eigen::Vector3d(3, 3, 0), 100)};
  RelaxationProblem free = p;
  free.stay_valid = false;
  relax(p, Arap{}, {.formulation = GetParam(), .max_iterations = 40});
  relax(free, Arap{}, {.formulation = GetParam(), .max_iterations = 40});
  EXPECT_GT(least_determinant(p), 0);
  EXPECT_LT(least_determinant(free), 0);
  p.points.col(0) = free.points.col(0);
  EXPECT_FALSE(relax(p, Arap{}, {.formulation = GetParam()}).feasible);
}

TEST_P(EveryFormulation, SameInputSameBytes) {
  RelaxationProblem a = make_problem(0.2, 5), b = a;
  relax(a, SymmetricDirichlet{}, {.formulation = GetParam()});
  relax(b, SymmetricDirichlet{}, {.formulation = GetParam()});
  EXPECT_EQ(a.points, b.points);
}

TEST_P(EveryFormulation, HasNothingToDoWithoutFreeVerticesOrAtTheMinimum) {
  RelaxationProblem fixed = make_problem(0.2, 1);
  fixed.n_free = 0;
  const Eigen::Matrix3Xd before = fixed.points;
  EXPECT_TRUE(relax(fixed, SymmetricDirichlet{}, {.formulation = GetParam()}).feasible);
  EXPECT_EQ(fixed.points, before);
  RelaxationProblem perfect = make_problem(0, 1);
  relax(perfect, SymmetricDirichlet{}, {.formulation = GetParam()});
  EXPECT_LT((perfect.points - make_problem(0, 1).points).cwiseAbs().maxCoeff(), 1e-5);
}

INSTANTIATE_TEST_SUITE_P(, EveryFormulation, testing::ValuesIn(kFormulations), [](const auto& i) {
  std::string s(name(i.param));
  std::replace(s.begin(), s.end(), '-', '_');
  return s;
});

TEST(EdgeTerms, GradientIsThatOfTheVerticesAndMetricIsPositive) {
  const RelaxationProblem p = make_problem(0.2, 8);
  for (const Energy& energy : all_energies()) {
    SCOPED_TRACE(energy.name());
    // Every edge of every hexahedron on its own, every second one against its axis.
    std::vector<HexEdges> edges(p.hexes.size());
    for (int i = 0; HexEdges & hex : edges) {
      for (int& e : hex) {
        e = i % 2 ? ~i : i;
        ++i;
      }
    }
    EdgeTerms terms = EdgeTerms::Zero(9, static_cast<Eigen::Index>(12 * edges.size()));
    const double value = hex_edge_terms(energy, p.points, p.hexes, p.targets, edges, terms);
    Eigen::Matrix3Xd expected = Eigen::Matrix3Xd::Zero(3, p.points.cols()), got = expected;
    EXPECT_NEAR(value, hex_energy(energy, p.points, p.hexes, p.targets, &expected), 1e-9 * value);
    for (Eigen::Index i = 0; i < terms.cols(); ++i) {
      const auto& ends = kEdgeCorners[i % 12];
      const HexCorners& h = p.hexes[i / 12];
      const Eigen::Vector3d g = (i % 2 ? -1 : 1) * terms.col(i).head<3>();
      got.col(h[ends[0]]) -= g;
      got.col(h[ends[1]]) += g;
      const auto m = terms.col(i).tail<6>();
      Eigen::Matrix3d metric;
      metric << m[0], m[1], m[2], m[1], m[3], m[4], m[2], m[4], m[5];
      EXPECT_EQ(metric.llt().info(), Eigen::Success);
    }
    EXPECT_LT((got - expected).cwiseAbs().maxCoeff(), 1e-9 * (1 + expected.norm()));
  }
}

/// Compares a gradient with central differences of a value, both at x.
template <class Value>
void expect_gradient(const std::vector<double>& gradient, std::vector<double> x,
                     const Value& value) {
  constexpr double kStep = 1e-6;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double kept = x[i];
    x[i] = kept + kStep;
    const double above = value(x);
    x[i] = kept - kStep;
    const double below = value(x);
    x[i] = kept;
    EXPECT_NEAR(gradient[i], (above - below) / (2 * kStep), 1e-5 * (1 + std::abs(gradient[i])));
  }
}

TEST(PreconditionedObjective, GradientAgreesWithDifferences) {
  RelaxationProblem p = make_problem(0.15, 1);
  p.pulls = {plane_pull(3, {1, 2, 3}, Eigen::Vector3d(1, 2, 2) / 3, 100),
             line_pull(5, {2, 1, 1}, Eigen::Vector3d(2, 1, 2) / 3, 50),
             point_pull(7, {1, 1, 1}, 20)};
  for (const Energy& energy : all_energies()) {
    SCOPED_TRACE(energy.name());
    const PreconditionedObjective objective(p, energy, 0);
    std::vector<double> y(objective.NumParameters(), 0.01), gradient(y.size());
    double cost = 0;
    ASSERT_TRUE(objective.Evaluate(y.data(), &cost, gradient.data()));
    expect_gradient(gradient, y, [&](const std::vector<double>& at) {
      objective.Evaluate(at.data(), &cost, nullptr);
      return cost;
    });
  }
}

/// A block of 3 parameters a vertex: half its square, and the gradient of that if asked for.
double half_square(const ceres::CostFunction& block, const std::vector<double>& x,
                   std::vector<double>* gradient) {
  const std::size_t n = block.parameter_block_sizes().size();
  std::vector<double> residuals(block.num_residuals());
  std::vector<std::vector<double>> jacobian(n, std::vector<double>(3 * residuals.size()));
  std::vector<const double*> blocks;
  std::vector<double*> jacobians;
  for (std::size_t k = 0; k < n; ++k) {
    blocks.push_back(&x[3 * k]);
    jacobians.push_back(jacobian[k].data());
  }
  EXPECT_TRUE(
      block.Evaluate(blocks.data(), residuals.data(), gradient ? jacobians.data() : nullptr));
  double sum = 0;
  if (gradient) gradient->assign(3 * n, 0);
  for (std::size_t r = 0; r < residuals.size(); ++r) {
    sum += 0.5 * residuals[r] * residuals[r];
    for (std::size_t i = 0; gradient && i < 3 * n; ++i) {
      (*gradient)[i] += residuals[r] * jacobian[i / 3][3 * r + i % 3];
    }
  }
  return sum;
}

TEST(ResidualBlocks, HaveTheDerivativeTheySay) {
  const RelaxationProblem p = make_problem(0.15, 2);
  const PullCost pull(plane_pull(0, {1, 2, 3}, Eigen::Vector3d(1, 2, 2) / 3, 100));
  std::vector<double> gradient, x{0.1, 0.2, 0.3};
  half_square(pull, x, &gradient);
  expect_gradient(gradient, x, [&](const auto& at) { return half_square(pull, at, nullptr); });
  for (const Energy& energy : all_energies()) {
    SCOPED_TRACE(energy.name());
    for (int c = 0; c < 8; ++c) {
      const CornerCost corner(p, energy, 21, c);
      x.clear();
      for (const int v : corner.vertices()) x.insert(x.end(), &p.points(0, v), &p.points(0, v) + 3);
      half_square(corner, x, &gradient);
      expect_gradient(gradient, x,
                      [&](const auto& at) { return half_square(corner, at, nullptr); });
    }
  }
}

TEST(VertexGroups, GradientOfTheGroupedObjectiveAgreesWithDifferences) {
  RelaxationProblem p = make_problem(0.2, 9);
  p.groups = {{0, 13}, {2, 26}, {26, 7}};
  p.pulls = {point_pull(13, {1, 1, 1}, 3), plane_pull(7, {1, 2, 3}, {0, 0, 1}, 5)};
  const GroupedProblem grouped = merge_groups(p);
  const RelaxationProblem& m = grouped.problem;
  EXPECT_EQ(m.n_free, p.n_free - 3);
  EXPECT_EQ(m.pulls.size(), 2u);
  EXPECT_TRUE(
      m.points.col(grouped.merged_of[0]).isApprox((p.points.col(0) + p.points.col(13)) / 2));
  Eigen::Matrix3Xd gradient, x = m.points;
  relaxation_objective(m, FoldoverFree{.epsilon = 0.1}, x, &gradient);
  const std::vector<double> at(x.data(), x.data() + 3 * m.n_free);
  expect_gradient({gradient.data(), gradient.data() + at.size()}, at, [&](const auto& moved) {
    std::copy(moved.begin(), moved.end(), x.data());
    return relaxation_objective(m, FoldoverFree{.epsilon = 0.1}, x, nullptr);
  });
}

TEST(VertexGroups, AFixedMemberFixesAllAndTwoInDifferentPlacesAreRefused) {
  RelaxationProblem p = make_problem(0.1, 10);
  const int fixed = p.n_free, other = p.n_free + 1;
  p.groups = {{0, fixed}};
  GroupedProblem grouped = merge_groups(p);
  EXPECT_EQ(grouped.problem.n_free, p.n_free - 1);
  Eigen::Matrix3Xd points = p.points;
  spread_groups(grouped, points);
  EXPECT_EQ(points.col(0), p.points.col(fixed));
  p.groups = {{0, fixed}, {other, 0}};
  EXPECT_THROW(merge_groups(p), InputError);
  p.groups = {{0, static_cast<int>(p.points.cols())}};
  EXPECT_THROW(merge_groups(p), InputError);
}

}  // namespace
}  // namespace hexweft
