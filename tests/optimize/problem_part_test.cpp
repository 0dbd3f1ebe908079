// A part of a problem against the whole with the rest held fast.
#include "optimize/problem_part.h"

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

#include "tests/optimize/relaxation_problem.h"

namespace hexweft {
namespace {

std::vector<char> first_free(const RelaxationProblem& p, int n) {
  std::vector<char> moves(p.points.cols(), 0);
  std::fill_n(moves.begin(), n, 1);
  return moves;
}

TEST(ProblemPart, OfEverythingIsTheWhole) {
  RelaxationProblem whole = make_problem(0.2, 1), parted = whole;
  whole.pulls = parted.pulls = {point_pull(7, {1, 1, 1}, 20)};
  relax(whole, SymmetricDirichlet{});
  ProblemPart part(parted, first_free(parted, parted.n_free));
  EXPECT_EQ(part.n_hexes(), static_cast<int>(parted.hexes.size()));
  part.relax(parted, SymmetricDirichlet{}, {});
  EXPECT_LT((whole.points - parted.points).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(ProblemPart, MovesItsVerticesAloneAndLowersTheWholeEnergy) {
  for (const Energy& energy : all_energies()) {
    RelaxationProblem p = make_problem(0.2, 2);
    p.pulls = {point_pull(0, {1, 1, 1}, 20), point_pull(p.n_free - 1, {1, 1, 1}, 20)};
    const Eigen::Matrix3Xd before = p.points;
    constexpr int kMoving = 3;
    ProblemPart part(p, first_free(p, kMoving));
    EXPECT_LT(part.n_hexes(), static_cast<int>(p.hexes.size()));
    const double old = relaxation_objective(p, energy, p.points, nullptr);
    part.relax(p, energy, {});
    EXPECT_LT(relaxation_objective(p, energy, p.points, nullptr), old);
    EXPECT_EQ(p.points.rightCols(p.points.cols() - kMoving),
              before.rightCols(before.cols() - kMoving));
    EXPECT_NE(p.points.leftCols(kMoving), before.leftCols(kMoving));
  }
}

TEST(ProblemPart, TakesPointsTargetsAndPullsAsTheyAreWhenItRelaxes) {
  RelaxationProblem p = make_problem(0.2, 3);
  ProblemPart part(p, first_free(p, 4));
  part.relax(p, SymmetricDirichlet{}, {});
  const Eigen::Vector3d aim = p.points.col(0) + Eigen::Vector3d(0.05, 0, 0);
  p.pulls = {point_pull(0, aim, 1e6)};
  part.relax(p, SymmetricDirichlet{}, {.max_iterations = 100, .tolerance_rel = 1e-9});
  EXPECT_LT((p.points.col(0) - aim).norm(), 1e-3);
}

TEST(ProblemPart, RingsGrowByHexahedraThatShareAVertex) {
  // A row of five hexahedra: i has the vertices 4i .. 4i + 7.
  std::vector<HexCorners> row(5);
  for (int i = 0; i < 5; ++i) std::iota(row[i].begin(), row[i].end(), 4 * i);
  const auto marked = [&](int rings) {
    const std::vector<int> seeds = {2};
    const std::vector<char> m = vertices_round(row, 24, seeds, rings);
    return std::vector<int>{static_cast<int>(std::find(m.begin(), m.end(), 1) - m.begin()),
                            static_cast<int>(std::count(m.begin(), m.end(), 1))};
  };
  EXPECT_EQ(marked(0), (std::vector<int>{8, 8}));
  EXPECT_EQ(marked(1), (std::vector<int>{4, 16}));
  EXPECT_EQ(marked(2), (std::vector<int>{0, 24}));
}

}  // namespace
}  // namespace hexweft
