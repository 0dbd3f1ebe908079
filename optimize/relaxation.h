/// \file
/// Minimizes the distortion of hexahedra, with vertices fixed, pulled or grouped.
///
///     RelaxationProblem problem;           // flat arrays, free vertices first
///     problem.pulls.push_back(plane_pull(v, on_surface, normal, 1e3 / (edge * edge)));
///     RelaxationReport report = relax(problem, SymmetricDirichlet{});
///
/// The same problem and any energy can be posed in several ways, which differ by orders of magnitude
/// in time; formulations.h has them.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "optimize/hex_energy.h"

namespace hexweft {

/// The term (x − target)ᵀ metric (x − target) of one vertex. The metric is symmetric, positive
/// semidefinite, and in 1 / model units²: the term is a number like the distortion of one
/// hexahedron.
struct VertexPull {
  int vertex;
  Eigen::Matrix3d metric;
  Eigen::Vector3d target;
};

/// Onto the plane through `point`. \param stiffness  1 / model units²; `normal` has length 1
VertexPull plane_pull(int vertex, const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
                      double stiffness);
/// Onto the line through `point`; `direction` has length 1.
VertexPull line_pull(int vertex, const Eigen::Vector3d& point, const Eigen::Vector3d& direction,
                     double stiffness);
/// To `point`. Vertices pulled to one point are a group on its way to be merged.
VertexPull point_pull(int vertex, const Eigen::Vector3d& point, double stiffness);

struct RelaxationProblem {
  Eigen::Matrix3Xd points;  ///< 3 × #vertices; the first n_free move, the others are fixed
  int n_free = 0;
  std::vector<HexCorners> hexes;
  std::vector<TargetCuboid> targets;     ///< one a hexahedron
  std::vector<VertexPull> pulls;         ///< of free vertices
  std::vector<std::vector<int>> groups;  ///< vertices that share one place; see vertex_groups.h
  bool stay_valid = false;  ///< no corner may invert, not even with an energy without a barrier
};

/// How the problem is posed to ceres.
enum class Formulation {
  lbfgs,           ///< L-BFGS in preconditioned unknowns, the fastest known
  slim_by_edges,   ///< linear least squares over mesh edges, renewed at each step
  residual_blocks  ///< one residual block a corner and a sparse factorization
};
std::string_view name(Formulation formulation);

/// Where a relaxation stands; energies as in the report.
struct RelaxationProgress {
  int iteration;
  double energy;
};

/// How long to go on.
struct RelaxationOptions {
  Formulation formulation = Formulation::lbfgs;
  int max_iterations = 30;          ///< > 0
  int iterations_per_restart = 10;  ///< > 0, then new blocks and a fresh start; L-BFGS alone
  int lbfgs_rank = 5;               ///< > 0, remembered steps; L-BFGS alone
  double tolerance_rel = 1e-3;  ///< > 0; stop when an iteration lowers the excess energy by less
  std::function<void(const RelaxationProgress&)> observer = {};  ///< after every iteration
};
void validate(const RelaxationOptions& options);  ///< \throws InputError

/// Energies are means over the hexahedra, less the energy's minimum; the pulls are included.
struct RelaxationReport {
  bool feasible = false;  ///< the start had a finite energy; otherwise nothing was done
  double initial_energy = 0, final_energy = 0;
  int iterations = 0, evaluations = 0;
};

/// The objective of a problem without groups: Σ hexahedra + Σ pulls, less the energy's minimum per hexahedron.
/// \param gradient  null, or set to 3 × #vertices; zero at fixed vertices
/// \return infinity where a barrier energy is not defined
double relaxation_objective(const RelaxationProblem& problem, const Energy& energy,
                            const Eigen::Matrix3Xd& points, Eigen::Matrix3Xd* gradient);

/// Moves the free points downhill. Never ends higher than it started.
/// \throws InputError on bad options or groups
RelaxationReport relax(RelaxationProblem& problem, const Energy& energy,
                       const RelaxationOptions& options = {});

}  // namespace hexweft
