// An energy of a user's own goes through every formulation and the parametrization.
#include "tests/optimize/own_energy.h"

#include <gtest/gtest.h>

#include "optimize/local_parametrization.h"
#include "optimize/relaxation.h"
#include "ovm/errors.h"
#include "ovm/quality.h"
#include "tests/optimize/relaxation_problem.h"

namespace hexweft {
namespace {

using someone_else::InverseVolume;
using someone_else::InverseVolumeValue;
using someone_else::PlainInverseVolume;

class OwnEnergy : public testing::TestWithParam<Energy> {};

TEST_P(OwnEnergy, GivesTheSameOnLanesOnNumbersAndFromItsValueAlone) {
  const RelaxationProblem p = make_problem(0.2, 1);
  Eigen::Matrix3Xd expected = Eigen::Matrix3Xd::Zero(3, p.points.cols());
  const double value = hex_energy(InverseVolume{}, p.points, p.hexes, p.targets, &expected,
                                  InstructionSet::portable);
  for (InstructionSet set : {InstructionSet::portable, InstructionSet::avx2, InstructionSet::avx512,
                             InstructionSet::automatic}) {
    Eigen::Matrix3Xd gradient = Eigen::Matrix3Xd::Zero(3, p.points.cols());
    try {
      EXPECT_NEAR(hex_energy(GetParam(), p.points, p.hexes, p.targets, &gradient, set), value,
                  1e-11 * value);
      EXPECT_LT((gradient - expected).cwiseAbs().maxCoeff(), 1e-10);
    } catch (const InputError&) {  // this machine cannot
    }
  }
}

TEST_P(OwnEnergy, IsMinimizedByEveryFormulation) {
  for (const Formulation f :
       {Formulation::lbfgs, Formulation::slim_by_edges, Formulation::residual_blocks}) {
    RelaxationProblem p = make_problem(0.25, 2);
    const RelaxationProblem perfect = make_problem(0, 2);
    const RelaxationReport r =
        relax(p, GetParam(), {.formulation = f, .max_iterations = 100, .tolerance_rel = 1e-8});
    EXPECT_TRUE(r.feasible);
    EXPECT_LT(r.final_energy, 1e-3 * r.initial_energy) << name(f);
    EXPECT_LT((p.points - perfect.points).norm(), 0.1) << name(f);
  }
}

TEST_P(OwnEnergy, ParametrizesAMesh) {
  HexMesh mesh = make_octree_like(Shape::blob, 8, 3);
  const ReferenceSurface surface = make_reference_surface(mesh);
  perturb(mesh, 0.03, false, 4);
  const double before = summarize_quality(mesh).mean_scaled_jacobian;
  const ParametrizationReport report =
      parametrize(mesh, all_cells(mesh), surface, {.energy = GetParam()});
  EXPECT_TRUE(report.valid());
  EXPECT_GT(summarize_quality(mesh).mean_scaled_jacobian, before);
}

INSTANTIATE_TEST_SUITE_P(, OwnEnergy,
                         testing::Values(Energy(InverseVolume{}), Energy(PlainInverseVolume{}),
                                         Energy(Differentiated<InverseVolumeValue>{})));

}  // namespace
}  // namespace hexweft
