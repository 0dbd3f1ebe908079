// Every energy of the table keeps the promises of its comment.
#include <cmath>

#include <Eigen/SVD>
#include <gtest/gtest.h>

#include "optimize/energies/table.h"
#include "tests/optimize/test_meshes.h"

namespace hexweft {
namespace {

Mat3<double> columns(const Eigen::Matrix3d& m) {
  Mat3<double> c;
  for (int k = 0; k < 3; ++k) c.col[k] = {m(0, k), m(1, k), m(2, k)};
  return c;
}
Eigen::Matrix3d matrix(const Mat3<double>& c) {
  Eigen::Matrix3d m;
  for (int k = 0; k < 3; ++k) m.col(k) = Eigen::Vector3d(c.col[k].x, c.col[k].y, c.col[k].z);
  return m;
}

double value_and_stress(const Energy& energy, const Eigen::Matrix3d& j,
                        Eigen::Matrix3d* stress = nullptr) {
  Mat3<double> s;
  const double value = std::visit(
      [&](const auto& e) { return e.value_and_stress(make_deformation(columns(j)), s); }, energy);
  if (stress) *stress = matrix(s);
  return value;
}
double minimum(const Energy& energy) {
  return std::visit([](const auto& e) { return e.minimum(); }, energy);
}
bool has_barrier(const Energy& energy) {
  return std::visit([](const auto& e) { return e.barrier; }, energy);
}

/// A Jacobian with singular values in [0.5, 2] and positive determinant.
Eigen::Matrix3d random_jacobian(Random& random) {
  const Eigen::Vector3d s(random.uniform(0.5, 2), random.uniform(0.5, 2), random.uniform(0.5, 2));
  const Eigen::Matrix3d u = random.rotation(), v = random.rotation();
  return u * s.asDiagonal() * v.transpose();
}

class EveryEnergy : public testing::TestWithParam<Energy> {};

TEST_P(EveryEnergy, HasItsMinimumAtRotations) {
  Random random(1);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Matrix3d r = random.rotation();
    Eigen::Matrix3d stress;
    EXPECT_NEAR(value_and_stress(GetParam(), r, &stress), minimum(GetParam()), 1e-5);
    EXPECT_LT(stress.norm(), 1e-5);
    EXPECT_GT(value_and_stress(GetParam(), random_jacobian(random)), minimum(GetParam()) - 1e-5);
  }
}

TEST_P(EveryEnergy, DoesNotFeelRotations) {
  Random random(2);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Matrix3d j = random_jacobian(random), r = random.rotation();
    const double value = value_and_stress(GetParam(), j);
    EXPECT_NEAR(value_and_stress(GetParam(), r * j), value, 1e-11 * value);
    EXPECT_NEAR(value_and_stress(GetParam(), j * r), value, 1e-11 * value);
  }
}

TEST_P(EveryEnergy, StressIsTheDerivative) {
  Random random(3);
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 50; ++i) {
    Eigen::Matrix3d j = random_jacobian(random), stress;
    value_and_stress(GetParam(), j, &stress);
    for (int k = 0; k < 9; ++k) {
      const double kept = j(k);
      j(k) = kept + kStep;
      const double above = value_and_stress(GetParam(), j);
      j(k) = kept - kStep;
      const double below = value_and_stress(GetParam(), j);
      j(k) = kept;
      EXPECT_NEAR(stress(k), (above - below) / (2 * kStep), 1e-6 * (1 + stress.norm()));
    }
  }
}

TEST_P(EveryEnergy, DerivativeBySingularValuesAgreesWithTheStress) {
  Random random(4);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3d sigma(random.uniform(0.5, 2), random.uniform(0.5, 2),
                                random.uniform(0.5, 2));
    const Eigen::Matrix3d u = random.rotation(), v = random.rotation();
    Eigen::Matrix3d stress;
    value_and_stress(GetParam(), u * sigma.asDiagonal() * v.transpose(), &stress);
    const Eigen::Vector3d d =
        std::visit([&](const auto& e) { return e.d_sigma(sigma); }, GetParam());
    EXPECT_LT((stress - u * d.asDiagonal() * v.transpose()).norm(), 1e-10 * (1 + stress.norm()));
  }
}

TEST_P(EveryEnergy, GrowsWithoutBoundTowardsFlatnessIfABarrierAndIsFiniteBeyondIfNot) {
  const auto squeezed = [](double s) {
    return Eigen::Matrix3d(Eigen::Vector3d(1, 1, s).asDiagonal());
  };
  if (has_barrier(GetParam())) {
    double last = value_and_stress(GetParam(), squeezed(0.1));
    for (double s = 0.01; s > 1e-6; s /= 10) {
      const double value = value_and_stress(GetParam(), squeezed(s));
      EXPECT_GT(value, 5 * last);
      last = value;
    }
  } else {
    for (double s : {0.1, 0.0, -0.1, -1.0, -3.0}) {
      Eigen::Matrix3d stress;
      EXPECT_TRUE(std::isfinite(value_and_stress(GetParam(), squeezed(s), &stress)));
      EXPECT_TRUE(stress.allFinite());
      EXPECT_LT(stress(2, 2), 0) << "moving the flat direction out must lower the energy, s = "
                                 << s;
      if (s >= 0.1) break;
    }
  }
}

TEST_P(EveryEnergy, EightLanesGiveWhatOneScalarGives) {
  Random random(5);
  Deformation<Lanes> lanes;
  std::vector<Eigen::Matrix3d> j;
  for (int i = 0; i < 8; ++i) j.push_back(random_jacobian(random));
  Mat3<Lanes> packed;
  for (int k = 0; k < 3; ++k) {
    for (int i = 0; i < 8; ++i) {
      packed.col[k].x[i] = j[i](0, k);
      packed.col[k].y[i] = j[i](1, k);
      packed.col[k].z[i] = j[i](2, k);
    }
  }
  lanes = make_deformation(packed);
  Mat3<Lanes> stress;
  const Lanes value =
      std::visit([&](const auto& e) { return e.value_and_stress(lanes, stress); }, GetParam());
  for (int i = 0; i < 8; ++i) {
    Eigen::Matrix3d expected;
    EXPECT_NEAR(value[i], value_and_stress(GetParam(), j[i], &expected), 1e-12 * value[i]);
    EXPECT_NEAR(stress.col[1].z[i], expected(2, 1), 1e-11 * (1 + expected.norm()));
  }
}

TEST_P(EveryEnergy, CurvatureIsPositive) {
  Random random(6);
  for (int i = 0; i < 50; ++i) {
    const auto d = make_deformation(columns(random_jacobian(random)));
    const auto k = std::visit([&](const auto& e) { return e.curvature(d); }, GetParam());
    EXPECT_GT(k.identity, 0);
    EXPECT_GE(k.normal, 0);
    EXPECT_GE(k.cofactor, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(, EveryEnergy, testing::ValuesIn(all_energies()), [](const auto& i) {
  std::string s(name(i.param));
  for (char& c : s) {
    if (c == '-') c = '_';
  }
  return s;
});

TEST(EnergyTable, FindsByNameAndNamesTheChoicesOtherwise) {
  EXPECT_EQ(name(make_energy("symmetric-dirichlet")), "symmetric-dirichlet");
  EXPECT_THROW(make_energy("no-such-energy"), InputError);
}

TEST(FoldoverFree, PullsInvertedElementsBack) {
  FoldoverFree energy;
  energy.epsilon = FoldoverFree::epsilon_for(-0.5);
  Mat3<double> stress;
  energy.value_and_stress(make_deformation(columns(Eigen::Vector3d(1, 1, -0.5).asDiagonal())),
                          stress);
  EXPECT_LT(stress.col[2].z, 0);  // downhill is towards a positive third axis
}

}  // namespace
}  // namespace hexweft
