/// \file
/// The ways to pose a relaxation to ceres, behind one signature. Callers use relax().
#pragma once

#include "optimize/relaxation.h"

namespace hexweft {

/// What a formulation did. Cost: the objective, pulls included, less the energy's minimum.
struct Descent {
  double cost;
  int iterations = 0, evaluations = 0;
};

/// Each moves problem.points.leftCols(n_free) downhill from a feasible start.
/// \param problem  without groups, with at least one free vertex
/// \param cost     at problem.points, finite
/// \return a cost no higher, that of problem.points
Descent descend_by_lbfgs(RelaxationProblem& problem, const Energy& energy,
                         const RelaxationOptions& options, double cost);
Descent descend_by_edges(RelaxationProblem& problem, const Energy& energy,
                         const RelaxationOptions& options, double cost);
Descent descend_by_residual_blocks(RelaxationProblem& problem, const Energy& energy,
                                   const RelaxationOptions& options, double cost);

/// Distortion and pulls, without the minimum taken off.
/// \param gradient  null, or set to 3 × #vertices, fixed ones too
double distortion_and_pulls(const RelaxationProblem& problem, const Energy& energy,
                            const Eigen::Matrix3Xd& points, Eigen::Matrix3Xd* gradient);
/// \param gradient  null, or 3 × #vertices to which the gradient is added
double pull_energy(const RelaxationProblem& problem, const Eigen::Matrix3Xd& points,
                   Eigen::Matrix3Xd* gradient);
/// The energy's minimum times the weights of the hexahedra.
double least_energy(const RelaxationProblem& problem, const Energy& energy);
/// Turns a cost into a mean over the hexahedra, by their weights.
double energy_per_hex(const RelaxationProblem& problem);

}  // namespace hexweft
