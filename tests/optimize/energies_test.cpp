// Every energy of the table keeps the promises of its comment.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/SVD>
#include <gtest/gtest.h>

#include "optimize/energies/singular_values.h"
#include "optimize/energies/table.h"
#include "tests/optimize/own_energy.h"
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
Eigen::Matrix3d diagonal(double a, double b, double c) {
  return Eigen::Vector3d(a, b, c).asDiagonal();
}

double value_and_stress(const Energy& energy, const Eigen::Matrix3d& j,
                        Eigen::Matrix3d* stress = nullptr) {
  Mat3<double> s;
  const double value = energy.value_and_stress(make_deformation(columns(j)), s);
  if (stress) *stress = matrix(s);
  return value;
}

/// A Jacobian with singular values in [0.5, 2] and positive determinant.
Eigen::Matrix3d random_jacobian(Random& random) {
  const Eigen::Vector3d s(random.uniform(0.5, 2), random.uniform(0.5, 2), random.uniform(0.5, 2));
  const Eigen::Matrix3d u = random.rotation(), v = random.rotation();
  return u * s.asDiagonal() * v.transpose();
}

/// uᵀ H u of the curvature model along u gᵀ.
double modelled(const Curvature<double>& k, const Deformation<double>& d, const Eigen::Vector3d& u,
                const Eigen::Vector3d& g) {
  const Eigen::Matrix3d c = matrix(d.cofactor);
  const Eigen::Vector3d b = c * g;
  return k.identity * u.squaredNorm() * g.squaredNorm() + k.normal * b.dot(u) * b.dot(u) +
         k.cofactor * b.squaredNorm() * (c.transpose() * u).squaredNorm();
}

class EveryEnergy : public testing::TestWithParam<Energy> {};

TEST_P(EveryEnergy, HasItsMinimumAtRotations) {
  Random random(1);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Matrix3d r = random.rotation();
    Eigen::Matrix3d stress;
    EXPECT_NEAR(value_and_stress(GetParam(), r, &stress), GetParam().minimum(), 1e-5);
    EXPECT_LT(stress.norm(), 1e-5);
    EXPECT_GT(value_and_stress(GetParam(), random_jacobian(random)), GetParam().minimum() - 1e-5);
  }
}

TEST_P(EveryEnergy, DoesNotFeelRotationsNorIfIsotropicThoseOfTheTarget) {
  Random random(2);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Matrix3d j = random_jacobian(random), r = random.rotation();
    Eigen::Matrix3d stress, turned;
    const double value = value_and_stress(GetParam(), j, &stress);
    EXPECT_NEAR(value_and_stress(GetParam(), r * j, &turned), value, 1e-10 * (1 + value));
    EXPECT_LT((turned - r * stress).norm(), 1e-9 * (1 + stress.norm()));
    if (!GetParam().isotropic()) continue;
    EXPECT_NEAR(value_and_stress(GetParam(), j * r, &turned), value, 1e-10 * (1 + value));
    EXPECT_LT((turned - stress * r).norm(), 1e-9 * (1 + stress.norm()));
  }
}

TEST_P(EveryEnergy, StressIsTheDerivative) {
  Random random(3);
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 50; ++i) {
    Eigen::Matrix3d j = random_jacobian(random), stress;
    const double scale = 1 + value_and_stress(GetParam(), j, &stress) + stress.norm();
    for (int k = 0; k < 9; ++k) {
      const double kept = j(k);
      j(k) = kept + kStep;
      const double above = value_and_stress(GetParam(), j);
      j(k) = kept - kStep;
      const double below = value_and_stress(GetParam(), j);
      j(k) = kept;
      EXPECT_NEAR(stress(k), (above - below) / (2 * kStep), 1e-7 * scale);
    }
  }
}

TEST_P(EveryEnergy, DerivativeBySingularValuesAgreesWithStressAndDifferences) {
  Random random(4);
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3d sigma(random.uniform(0.5, 2), random.uniform(0.5, 2),
                                random.uniform(0.5, 2));
    const Eigen::Matrix3d u = random.rotation();
    const Eigen::Matrix3d v =
        GetParam().isotropic() ? random.rotation() : Eigen::Matrix3d::Identity();
    Eigen::Matrix3d stress;
    const double value =
        value_and_stress(GetParam(), u * sigma.asDiagonal() * v.transpose(), &stress);
    const Eigen::Vector3d d = GetParam().d_sigma(sigma);
    EXPECT_LT((stress - u * d.asDiagonal() * v.transpose()).norm(), 1e-9 * (1 + stress.norm()));
    for (int k = 0; k < 3; ++k) {
      Eigen::Vector3d moved = sigma;
      moved[k] += kStep;
      const double above = value_and_stress(GetParam(), moved.asDiagonal());
      moved[k] -= 2 * kStep;
      const double below = value_and_stress(GetParam(), moved.asDiagonal());
      EXPECT_NEAR(d[k], (above - below) / (2 * kStep), 1e-7 * (1 + value + d.norm()));
    }
  }
}

void expect_barrier(const Energy& energy) {
  double last = value_and_stress(energy, diagonal(1, 1, 0.1)), growth = 0;
  for (double s = 0.01; s > 1e-9; s /= 10) {
    const double value = value_and_stress(energy, diagonal(1, 1, s));
    EXPECT_GE(value - last, 0.999 * growth) << "a logarithm grows by as much each time, at " << s;
    growth = value - last;
    last = value;
  }
  EXPECT_GT(growth, 4);
}

void expect_finite_beyond(const Energy& energy) {
  Eigen::Matrix3d stress;
  for (const double s : {0.1, 0.0, -0.1, -1.0, -3.0}) {
    EXPECT_TRUE(std::isfinite(value_and_stress(energy, diagonal(1, 1, s), &stress)));
    EXPECT_TRUE(stress.allFinite());
    if (s <= -1) continue;
    EXPECT_LT(stress(2, 2), 0) << "moving out must lower the energy, s = " << s;
  }
  EXPECT_TRUE(std::isfinite(value_and_stress(energy, Eigen::Matrix3d::Zero(), &stress)));
  EXPECT_TRUE(stress.allFinite());
}

TEST_P(EveryEnergy, GrowsWithoutBoundTowardsFlatnessIfABarrierAndIsFiniteBeyondIfNot) {
  if (GetParam().barrier()) {
    expect_barrier(GetParam());
  } else {
    expect_finite_beyond(GetParam());
  }
}

TEST_P(EveryEnergy, CurvatureModelIsPositive) {
  Random random(6);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Matrix3d j = random_jacobian(random) * diagonal(1, 1, i % 2 ? 1 : 1e-3);
    const auto d = make_deformation(columns(j));
    const Curvature<double> k = GetParam().curvature(d);
    EXPECT_GT(k.identity, 0);
    EXPECT_GE(k.normal, 0);
    EXPECT_GE(k.cofactor, 0);
    for (int n = 0; n < 5; ++n) {
      EXPECT_GT(modelled(k, d, random.in_cube(1), random.in_cube(1)), 0);
    }
  }
}

TEST_P(EveryEnergy, CurvatureModelIsAboutTheSecondDerivativeAtRest) {
  Random random(7);
  constexpr double kStep = 1e-3;
  for (int i = 0; i < 20; ++i) {
    const Eigen::Matrix3d r = random.rotation();
    const Eigen::Vector3d u = random.in_cube(1).normalized(), g = random.in_cube(1).normalized();
    const auto at = [&](double t) {
      return value_and_stress(GetParam(), r + t * u * g.transpose());
    };
    const double second = (at(kStep) - 2 * at(0) + at(-kStep)) / (kStep * kStep);
    const auto d = make_deformation(columns(r));
    const double model = modelled(GetParam().curvature(d), d, u, g);
    EXPECT_GT(model, 0.9 * second);
    // Where only lengths change, an energy of the angles does not change.
    if (!GetParam().isotropic()) continue;
    EXPECT_LT(model, 3.1 * second);
  }
}

std::string name_of_test(const testing::TestParamInfo<Energy>& i) {
  std::string s(i.param.name());
  std::replace(s.begin(), s.end(), '-', '_');
  return s;
}

INSTANTIATE_TEST_SUITE_P(, EveryEnergy, testing::ValuesIn(all_energies()), name_of_test);
INSTANTIATE_TEST_SUITE_P(Sharper, EveryEnergy,
                         testing::Values(InverseScaledJacobian{.size = 1, .sharpness = 3},
                                         InverseScaledJacobian{.size = 1, .sharpness = 4}));
INSTANTIATE_TEST_SUITE_P(
    OfAUser, EveryEnergy,
    testing::Values(Energy(someone_else::InverseVolume{}),
                    Energy(Differentiated<someone_else::InverseVolumeValue>{})),
    name_of_test);

/// What is compiled for lanes is the same formula: the types of the table, without their wrapper.
template <class E>
class EveryEnergyType : public testing::Test {};

#define ROW(Kind) , Kind
template <class, class... E>
using TypesAfterFirst = testing::Types<E...>;
using EnergyTypes = TypesAfterFirst<void HEXWEFT_ENERGIES(ROW)>;
#undef ROW
TYPED_TEST_SUITE(EveryEnergyType, EnergyTypes);

TYPED_TEST(EveryEnergyType, EightLanesGiveWhatOneScalarGives) {
  static_assert(DistortionEnergy<TypeParam>);
  const TypeParam energy;
  Random random(5);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<Eigen::Matrix3d> j;
    Mat3<Lanes> packed;
    for (int i = 0; i < 8; ++i) {
      j.push_back(random_jacobian(random) * diagonal(1, 1, trial % 2 ? 1 : 0.1));
      for (int k = 0; k < 3; ++k) {
        packed.col[k].x[i] = j[i](0, k);
        packed.col[k].y[i] = j[i](1, k);
        packed.col[k].z[i] = j[i](2, k);
      }
    }
    Mat3<Lanes> stress;
    const Deformation<Lanes> d = make_deformation(packed);
    const Lanes value = energy.value_and_stress(d, stress);
    const Curvature<Lanes> curvature = energy.curvature(d);
    for (int i = 0; i < 8; ++i) {
      Eigen::Matrix3d expected;
      const double one = value_and_stress(energy, j[i], &expected);
      EXPECT_NEAR(value[i], one, 1e-11 * (1 + one));
      EXPECT_NEAR(stress.col[1].z[i], expected(2, 1), 1e-10 * (1 + expected.norm()));
      const Curvature<double> k = energy.curvature(make_deformation(columns(j[i])));
      EXPECT_NEAR(curvature.identity[i], k.identity, 1e-10 * k.identity);
      EXPECT_NEAR(curvature.normal[i], k.normal, 1e-10 * k.normal);
      EXPECT_NEAR(curvature.cofactor[i], k.cofactor, 1e-10 * k.cofactor);
    }
  }
}

TEST(SymmetricDirichlet, HasAResidualOfItsValue) {
  static_assert(HasResidual<SymmetricDirichlet>);
  const SymmetricDirichlet energy;
  Random random(8);
  constexpr double kStep = 1e-6;
  const auto residual = [&](const Eigen::Matrix3d& j) {
    Mat3<double> r;
    energy.residual(make_deformation(columns(j)), r);
    return matrix(r);
  };
  for (int i = 0; i < 20; ++i) {
    const Eigen::Matrix3d j = random_jacobian(random);
    EXPECT_NEAR(residual(j).squaredNorm(), value_and_stress(energy, j) - energy.minimum(), 1e-10);
    const auto d = make_deformation(columns(j));
    for (int k = 0; k < 9; ++k) {
      Eigen::Matrix3d above = j, below = j;
      above(k) += kStep;
      below(k) -= kStep;
      const Eigen::Matrix3d change = (residual(above) - residual(below)) / (2 * kStep);
      EXPECT_LT((matrix(energy.residual_change(d, k / 3, k % 3)) - change).norm(), 1e-7);
    }
  }
}

TEST(EnergyTable, FindsByNameAndNamesTheChoicesOtherwise) {
  for (const Energy& energy : all_energies()) {
    EXPECT_EQ(make_energy(energy.name()).name(), energy.name());
  }
  EXPECT_GE(all_energies().size(), 9u);
  try {
    make_energy("no-such-energy");
    FAIL() << "an unknown name was taken";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("symmetric-dirichlet, "), std::string::npos);
  }
}

TEST(FoldoverFree, PullsInvertedElementsBack) {
  FoldoverFree energy;
  energy.epsilon = FoldoverFree::epsilon_for(-0.5);
  Eigen::Matrix3d stress;
  value_and_stress(energy, diagonal(1, 1, -0.5), &stress);
  EXPECT_LT(stress(2, 2), 0);  // downhill is towards a positive third axis
}

TEST(Arap, IsTheDistanceToTheClosestRotationAlsoOfInvertedJacobians) {
  Random random(9);
  for (int i = 0; i < 200; ++i) {
    Eigen::Matrix3d j, stress;
    for (int k = 0; k < 3; ++k) j.col(k) = random.in_cube(1);
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(j, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Matrix3d u = svd.matrixU();
    if (j.determinant() < 0) u.col(2) *= -1;
    if (std::abs(j.determinant()) < 1e-3) continue;
    const Eigen::Matrix3d off = j - u * svd.matrixV().transpose();
    EXPECT_NEAR(value_and_stress(Arap{}, j, &stress), off.squaredNorm(), 1e-8);
    EXPECT_LT((stress - 2 * off).norm(), 1e-6);
  }
}

TEST(Exponential, StaysFiniteOnPoorElementsAndSmoothWhereItsCurveChanges) {
  ExponentialSymmetricDirichlet energy;
  EXPECT_TRUE(std::isfinite(value_and_stress(energy, diagonal(1, 1, 1e-4))));
  double s = 0.3;  // where the exponent passes 20
  while (value_and_stress(SymmetricDirichlet{}, diagonal(1, 1, s)) - 6 < 20) s *= 1 - 1e-6;
  Eigen::Matrix3d inside, beyond;
  value_and_stress(energy, diagonal(1, 1, s * (1 + 2e-6)), &inside);
  value_and_stress(energy, diagonal(1, 1, s), &beyond);
  EXPECT_NEAR(beyond(2, 2) / inside(2, 2), 1, 1e-3);
}

TEST(SingularVectors, AreThoseOfADecompositionAlsoWhereTheyAreFarApart) {
  Random random(10);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Matrix3d j = random_jacobian(random) * diagonal(1, 1e-3, i % 2 ? 1 : 1e-8);
    const OneSided<double> s = singular_vectors(columns(j));
    const Eigen::Matrix3d left = matrix(s.scaled_left), right = matrix(s.right);
    EXPECT_LT((left * right.transpose() - j).norm(), 1e-14 * 8);
    EXPECT_LT((right.transpose() * right - Eigen::Matrix3d::Identity()).norm(), 1e-14);
    Eigen::Vector3d sigma = left.colwise().norm();
    std::sort(sigma.data(), sigma.data() + 3, std::greater<>());
    const Eigen::Vector3d expected = Eigen::JacobiSVD<Eigen::Matrix3d>(j).singularValues();
    EXPECT_LT((sigma - expected).cwiseQuotient(expected).cwiseAbs().maxCoeff(), 1e-7);
  }
}

TEST(Lanes, LogarithmAndExponentialAreTheLibrarys) {
  Random random(11);
  for (int i = 0; i < 1000; ++i) {
    Lanes x, small;
    for (int l = 0; l < 8; ++l) {
      x[l] = random.uniform(-700, 700);
      small[l] = random.uniform(-1, 1);
    }
    const Lanes e = exponential(x), round = logarithm(e), f = exponential(small), g = logarithm(f);
    for (int l = 0; l < 8; ++l) {
      EXPECT_NEAR(e[l] / std::exp(x[l]), 1, 1e-15);
      EXPECT_NEAR(round[l], std::log(e[l]), 1e-15 * std::abs(x[l]) + 1e-16);
      EXPECT_NEAR(f[l] / std::exp(small[l]), 1, 1e-15);
      EXPECT_NEAR(g[l], std::log(f[l]), 4e-16);
    }
  }
  const Lanes far = exponential(Lanes{710, 1e5, -710, -1e5, 0, 709, -708, 1});
  EXPECT_EQ(far[0], std::numeric_limits<double>::infinity());
  EXPECT_EQ(far[1], std::numeric_limits<double>::infinity());
  EXPECT_LT(far[2], 1e-300);
  EXPECT_LT(far[3], 1e-300);
  EXPECT_EQ(far[4], 1);
  EXPECT_EQ(logarithm(Lanes{1, 1, 1, 1, 1, 1, 1, 1})[0], 0);
}

}  // namespace
}  // namespace hexweft
