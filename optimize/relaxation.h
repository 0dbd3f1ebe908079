/// \file
/// Minimizes the distortion of hexahedra, with vertices fixed or pulled, by preconditioned L-BFGS.
///
///     RelaxationProblem problem;           // flat arrays, free vertices first
///     problem.pulls.push_back(plane_pull(v, on_surface, normal, 1e3 / (edge * edge)));
///     RelaxationReport report = relax(problem, SymmetricDirichlet{});
///
/// The unknowns are changed to y with x = x0 + L⁻ᵀ y, where L Lᵀ is each vertex's 3 × 3 block of
/// the second derivative, pulls included; that evens out edge lengths and stiff pulls. The blocks
/// are renewed, and L-BFGS restarted, every few iterations. Source of the direction and line
/// search: ceres.
#pragma once

#include <span>
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
  std::vector<TargetCuboid> targets;  ///< one a hexahedron
  std::vector<VertexPull> pulls;      ///< of free vertices
};

/// How long to go on.
struct RelaxationOptions {
  int max_iterations = 30;          ///< > 0
  int iterations_per_restart = 10;  ///< > 0, then new blocks and a fresh start
  int lbfgs_rank = 5;               ///< > 0, remembered steps
  double tolerance_rel = 1e-3;  ///< > 0; stop when an iteration lowers the excess energy by less
};
void validate(const RelaxationOptions& options);  ///< \throws InputError

/// Energies are means over the hexahedra, less the energy's minimum; the pulls are included.
struct RelaxationReport {
  bool feasible = false;  ///< the start had a finite energy; otherwise nothing was done
  double initial_energy = 0, final_energy = 0;
  int iterations = 0, evaluations = 0;
};

/// The objective: Σ hexahedra + Σ pulls, less the energy's minimum per hexahedron.
/// \param gradient  null, or set to 3 × #vertices; zero at fixed vertices
/// \return infinity where a barrier energy is not defined
double relaxation_objective(const RelaxationProblem& problem, const Energy& energy,
                            const Eigen::Matrix3Xd& points, Eigen::Matrix3Xd* gradient);

/// Moves the free points downhill. Never ends higher than it started.
RelaxationReport relax(RelaxationProblem& problem, const Energy& energy,
                       const RelaxationOptions& options = {});

}  // namespace hexweft
