#include "optimize/relaxation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "optimize/formulations.h"
#include "optimize/vertex_groups.h"
#include "ovm/errors.h"

namespace hexweft {
namespace {

double weight_sum(const RelaxationProblem& p) {
  double sum = 0;
  for (const TargetCuboid& t : p.targets) sum += t.weight;
  return sum;
}

Descent descend(RelaxationProblem& problem, const Energy& energy, const RelaxationOptions& options,
                double cost) {
  switch (options.formulation) {
    case Formulation::slim_by_edges:
      return descend_by_edges(problem, energy, options, cost);
    case Formulation::residual_blocks:
      return descend_by_residual_blocks(problem, energy, options, cost);
    case Formulation::lbfgs:
      break;
  }
  return descend_by_lbfgs(problem, energy, options, cost);
}

RelaxationReport relax_ungrouped(RelaxationProblem& problem, const Energy& energy,
                                 const RelaxationOptions& options) {
  RelaxationReport report;
  const double per_hex = energy_per_hex(problem);
  const double cost = distortion_and_pulls(problem, energy, problem.points, nullptr) -
                      least_energy(problem, energy);
  report.feasible = std::isfinite(cost);
  report.initial_energy = report.final_energy = cost * per_hex;
  if (!report.feasible || problem.n_free == 0) return report;
  const Descent done = descend(problem, energy, options, cost);
  report.final_energy = std::min(cost, done.cost) * per_hex;
  report.iterations = done.iterations;
  report.evaluations = done.evaluations;
  return report;
}

}  // namespace

double distortion_and_pulls(const RelaxationProblem& problem, const Energy& energy,
                            const Eigen::Matrix3Xd& points, Eigen::Matrix3Xd* gradient) {
  if (gradient) gradient->setZero(3, points.cols());
  const double value = hex_energy(energy, points, problem.hexes, problem.targets, gradient,
                                  InstructionSet::automatic, problem.stay_valid);
  if (!std::isfinite(value)) return std::numeric_limits<double>::infinity();
  return value + pull_energy(problem, points, gradient);
}

double pull_energy(const RelaxationProblem& problem, const Eigen::Matrix3Xd& points,
                   Eigen::Matrix3Xd* gradient) {
  double value = 0;
  for (const VertexPull& pull : problem.pulls) {
    const Eigen::Vector3d off = points.col(pull.vertex) - pull.target;
    const Eigen::Vector3d force = pull.metric * off;
    value += off.dot(force);
    if (gradient) gradient->col(pull.vertex) += 2 * force;
  }
  return value;
}

double least_energy(const RelaxationProblem& problem, const Energy& energy) {
  return energy.minimum() * weight_sum(problem);
}

double energy_per_hex(const RelaxationProblem& problem) {
  return problem.hexes.empty() ? 1 : 1 / weight_sum(problem);
}

std::string_view name(Formulation formulation) {
  switch (formulation) {
    case Formulation::slim_by_edges:
      return "slim-by-edges";
    case Formulation::residual_blocks:
      return "residual-blocks";
    case Formulation::lbfgs:
      break;
  }
  return "lbfgs";
}

VertexPull plane_pull(int vertex, const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
                      double stiffness) {
  return {vertex, stiffness * normal * normal.transpose(), point};
}

VertexPull line_pull(int vertex, const Eigen::Vector3d& point, const Eigen::Vector3d& direction,
                     double stiffness) {
  return {vertex, stiffness * (Eigen::Matrix3d::Identity() - direction * direction.transpose()),
          point};
}

VertexPull point_pull(int vertex, const Eigen::Vector3d& point, double stiffness) {
  return {vertex, stiffness * Eigen::Matrix3d::Identity(), point};
}

void validate(const RelaxationOptions& o) {
  const auto positive = [](const char* what, double value) {
    if (!(value > 0)) {
      throw InputError(std::string(what) + " = " + std::to_string(value) + ", expected > 0");
    }
  };
  positive("max_iterations", o.max_iterations);
  positive("iterations_per_restart", o.iterations_per_restart);
  positive("lbfgs_rank", o.lbfgs_rank);
  positive("tolerance_rel", o.tolerance_rel);
}

double relaxation_objective(const RelaxationProblem& problem, const Energy& energy,
                            const Eigen::Matrix3Xd& points, Eigen::Matrix3Xd* gradient) {
  const double value = distortion_and_pulls(problem, energy, points, gradient);
  if (gradient) gradient->rightCols(points.cols() - problem.n_free).setZero();
  return value - least_energy(problem, energy);
}

RelaxationReport relax(RelaxationProblem& problem, const Energy& energy,
                       const RelaxationOptions& options) {
  validate(options);
  if (problem.groups.empty()) return relax_ungrouped(problem, energy, options);
  GroupedProblem grouped = merge_groups(problem);
  const RelaxationReport report = relax_ungrouped(grouped.problem, energy, options);
  spread_groups(grouped, problem.points);
  return report;
}

}  // namespace hexweft
