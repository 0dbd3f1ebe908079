// The evaluation over hexahedra: gradient, preconditioner, instruction sets, quality.
#include "optimize/hex_energy.h"

#include <limits>

#include <gtest/gtest.h>

#include "ovm/quality.h"
#include "tests/optimize/test_meshes.h"

namespace hexweft {
namespace {

struct Sample {
  Region region;
  std::vector<TargetCuboid> targets;
};

Sample make_sample() {
  HexMesh mesh = make_grid({3, 4, 2});
  perturb(mesh, 0.15, true, 1);
  Sample s{make_region(mesh, all_cells(mesh)), {}};
  Random random(2);
  for (std::size_t i = 0; i < s.region.hexes.size(); ++i) {
    const Eigen::Vector3d lengths(random.uniform(0.7, 1.4), random.uniform(0.7, 1.4),
                                  random.uniform(0.7, 1.4));
    s.targets.push_back({lengths, random.uniform(0.5, 2)});
  }
  return s;
}

class HexEnergyOfEveryKind : public testing::TestWithParam<Energy> {};

TEST_P(HexEnergyOfEveryKind, GradientAgreesWithDifferences) {
  Sample s = make_sample();
  Eigen::Matrix3Xd& p = s.region.points;
  Eigen::Matrix3Xd gradient = Eigen::Matrix3Xd::Zero(3, p.cols());
  hex_energy(GetParam(), p, s.region.hexes, s.targets, &gradient);
  constexpr double kStep = 1e-6;
  for (Eigen::Index i = 0; i < p.size(); ++i) {
    const double kept = p(i);
    p(i) = kept + kStep;
    const double above = hex_energy(GetParam(), p, s.region.hexes, s.targets, nullptr);
    p(i) = kept - kStep;
    const double below = hex_energy(GetParam(), p, s.region.hexes, s.targets, nullptr);
    p(i) = kept;
    EXPECT_NEAR(gradient(i), (above - below) / (2 * kStep), 1e-5);
  }
}

TEST_P(HexEnergyOfEveryKind, InstructionSetsAgree) {
  const Sample s = make_sample();
  const auto run = [&](InstructionSet set, Eigen::Matrix3Xd& g) {
    g.setZero(3, s.region.points.cols());
    return hex_energy(GetParam(), s.region.points, s.region.hexes, s.targets, &g, set);
  };
  Eigen::Matrix3Xd expected, got;
  const double value = run(InstructionSet::portable, expected);
  for (InstructionSet set :
       {InstructionSet::avx2, InstructionSet::avx512, InstructionSet::automatic}) {
    try {
      EXPECT_NEAR(run(set, got), value, 1e-12 * value);
      EXPECT_LT((got - expected).cwiseAbs().maxCoeff(), 1e-11);
    } catch (const InputError&) {  // this machine cannot
    }
  }
}

TEST_P(HexEnergyOfEveryKind, IsItsMinimumOnTargetsInAnyPosition) {
  HexMesh mesh =
      make_grid({2, 3, 2}, Eigen::AlignedBox3d(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(4, 3, 1)));
  const Eigen::Matrix3d turn = Random(3).rotation();
  for (VertexHandle v : mesh.vertices()) mesh.set_point(v, turn * mesh.point(v));
  const Region region = make_region(mesh, all_cells(mesh));
  const std::vector<TargetCuboid> targets(region.hexes.size(), {{2, 1, 0.5}, 1});
  const double minimum = GetParam().minimum();
  EXPECT_NEAR(hex_energy(GetParam(), region.points, region.hexes, targets, nullptr),
              minimum * static_cast<double>(region.hexes.size()), 1e-4);
}

TEST_P(HexEnergyOfEveryKind, CurvatureBlocksArePositiveAndOfTheRightSize) {
  const Sample s = make_sample();
  Eigen::Matrix<double, 6, Eigen::Dynamic> blocks =
      Eigen::Matrix<double, 6, Eigen::Dynamic>::Zero(6, s.region.points.cols());
  add_hex_curvature(GetParam(), s.region.points, s.region.hexes, s.targets, blocks);
  Eigen::Matrix3Xd p = s.region.points;
  constexpr double kStep = 1e-4;
  for (Eigen::Index v = 0; v < p.cols(); ++v) {
    const auto b = blocks.col(v);
    Eigen::Matrix3d block;
    block << b[0], b[1], b[2], b[1], b[3], b[4], b[2], b[4], b[5];
    EXPECT_GT(block.llt().matrixL().determinant(), 0);
    const auto value = [&] {
      return hex_energy(GetParam(), p, s.region.hexes, s.targets, nullptr);
    };
    const double here = value();
    double trace = 0;
    for (int k = 0; k < 3; ++k) {
      p(k, v) += kStep;
      const double above = value();
      p(k, v) -= 2 * kStep;
      const double below = value();
      p(k, v) += kStep;
      trace += (above - 2 * here + below) / (kStep * kStep);
    }
    EXPECT_GT(block.trace(), 0.3 * trace);
    EXPECT_LT(block.trace(), 5 * trace);
  }
}

INSTANTIATE_TEST_SUITE_P(, HexEnergyOfEveryKind, testing::ValuesIn(all_energies()));

TEST(HexEnergy, BarrierIsInfiniteOnAnInvertedCorner) {
  Sample s = make_sample();
  s.region.points.col(s.region.hexes[0][0]) += 3 * Eigen::Vector3d::Ones();
  EXPECT_EQ(hex_energy(SymmetricDirichlet{}, s.region.points, s.region.hexes, s.targets, nullptr),
            std::numeric_limits<double>::infinity());
  EXPECT_LT(hex_energy(FoldoverFree{}, s.region.points, s.region.hexes, s.targets, nullptr), 1e12);
  const auto least = min_relative_determinants(s.region.points, s.region.hexes, s.targets);
  EXPECT_LT(least[0], 0);
}

TEST(ScaledJacobians, AreTheKernelsOwn) {
  HexMesh mesh = make_octree_like(Shape::blob, 8, 3);
  perturb(mesh, 0.05, true, 4);
  const Region region = make_region(mesh, all_cells(mesh));
  const std::vector<double> sj = scaled_jacobians(region.points, region.hexes);
  const std::vector<double> of_cells = scaled_jacobians(mesh, region.cells);
  ASSERT_EQ(of_cells.size(), sj.size());
  for (std::size_t i = 0; i < sj.size(); ++i) {
    EXPECT_NEAR(sj[i], scaled_jacobian(mesh, region.cells[i]), 1e-12);
    EXPECT_EQ(of_cells[i], sj[i]);
  }
}

TEST(ShapeMetrics, AreTheKernelsOwn) {
  HexMesh mesh = make_octree_like(Shape::blob, 8, 3);
  perturb(mesh, 0.05, true, 4);
  const VertexHandle v = mesh.vertices(CellHandle(0))[0];
  mesh.set_point(v, mesh.point(v) + Eigen::Vector3d(3, 3, 3));
  const std::vector<CellHandle> cells = all_cells(mesh);
  const std::vector<double> shape = shape_metrics(mesh, cells);
  ASSERT_EQ(shape.size(), cells.size());
  EXPECT_EQ(shape[0], 0);  // inverted
  for (std::size_t i = 0; i < shape.size(); ++i)
    EXPECT_NEAR(shape[i], shape_metric(mesh, cells[i]), 1e-12);
}

}  // namespace
}  // namespace hexweft
