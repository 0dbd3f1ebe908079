#include "optimize/local_parametrization.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "ovm/errors.h"

namespace hexweft {
namespace {

/// Corners flatter than this, relative to the target, count as inverted: a barrier energy started
/// there would spend its iterations on them alone.
constexpr double kFlat = 1e-3;

/// A projection does not take a scaled Jacobian below this; hexahedra with several sides on a
/// smooth surface would be flat with all their vertices on it.
constexpr double kLeastOnProjection = 0.15;

class Parametrization {
 public:
  Parametrization(Region region, const ReferenceSurface& reference,
                  const ParametrizationOptions& options, std::vector<VertexPull> goals)
      : region_(std::move(region)),
        reference_(reference),
        options_(options),
        goal_pulls_(std::move(goals)) {
    lengths_ = edge_lengths_at_vertices(region_);
    goals_ = surface_goals(region_, reference_, options_.surface);
  }

  ParametrizationReport run();
  const Region& region() const { return region_; }

 private:
  double least_determinant(const std::vector<TargetCuboid>& targets) const {
    const auto d = min_relative_determinants(region_.points, region_.hexes, targets);
    return d.empty() ? 1 : *std::min_element(d.begin(), d.end());
  }
  double least_scaled_jacobian() const {
    const auto sj = scaled_jacobians(region_.points, region_.hexes);
    return sj.empty() ? 1 : *std::min_element(sj.begin(), sj.end());
  }
  void weigh_bad_hexes(std::vector<TargetCuboid>& targets) const;
  RelaxationReport relax_once(const Energy& energy, const std::vector<TargetCuboid>& targets,
                              int iterations);
  bool untangle();
  void iterate();
  double largest_relative_move(const Eigen::Matrix3Xd& from) const;

  Region region_;
  const ReferenceSurface& reference_;
  const ParametrizationOptions& options_;
  std::vector<VertexPull> goal_pulls_;
  std::vector<double> lengths_;  // of edges at each vertex, at the start
  std::vector<SurfaceGoal>
      goals_;  // of the last projection; also the planes of the next relaxation
  ParametrizationReport report_;
};

void Parametrization::weigh_bad_hexes(std::vector<TargetCuboid>& targets) const {
  const std::vector<double> sj = scaled_jacobians(region_.points, region_.hexes);
  for (std::size_t h = 0; h < targets.size(); ++h) {
    const double shortfall = options_.quality_goal / std::max(sj[h], 1e-3);
    targets[h].weight = std::clamp(shortfall * shortfall, 1.0, options_.quality_weight_limit);
  }
}

RelaxationReport Parametrization::relax_once(const Energy& energy,
                                             const std::vector<TargetCuboid>& targets,
                                             int iterations) {
  RelaxationProblem problem;
  problem.points = region_.points;
  problem.n_free = region_.n_free;
  problem.hexes = region_.hexes;
  problem.targets = targets;
  problem.pulls = surface_pulls(region_, goals_, options_.surface.weight);
  problem.pulls.insert(problem.pulls.end(), goal_pulls_.begin(), goal_pulls_.end());
  RelaxationOptions relaxation;
  relaxation.max_iterations = iterations;
  relaxation.iterations_per_restart = std::max(10, iterations);
  const RelaxationReport r = relax(problem, energy, relaxation);
  region_.points = std::move(problem.points);
  report_.relaxation_iterations += r.iterations;
  return r;
}

/// Follows the regularized energy with ε tied to the worst corner, until no corner is flat.
bool Parametrization::untangle() {
  constexpr int kIterations = 8;     // short rounds: the last one ends soon after nothing is flat
  constexpr int kRoundsPerGoal = 3;  // closest points cost as much as a round
  std::vector<TargetCuboid> targets = target_cuboids(region_, options_.target);
  double least = least_determinant(targets);
  if (least > kFlat) return true;
  report_.untangled = true;
  int rounds_without_gain = 0;
  for (int round = 0; round < options_.untangling_rounds; ++round) {
    FoldoverFree energy;
    energy.epsilon = FoldoverFree::epsilon_for(least - kFlat);
    relax_once(energy, targets, kIterations);
    targets = target_cuboids(region_, options_.target);
    if ((round + 1) % kRoundsPerGoal == 0) {
      goals_ = surface_goals(region_, reference_, options_.surface);
    }
    const double now = least_determinant(targets);
    if (now > kFlat) return true;
    rounds_without_gain = now > least + 0.1 * std::abs(least) ? 0 : rounds_without_gain + 1;
    if (rounds_without_gain == 4) break;
    least = now;
  }
  return least_determinant(targets) > 0;
}

double Parametrization::largest_relative_move(const Eigen::Matrix3Xd& from) const {
  double largest = 0;
  for (int v = 0; v < region_.n_free; ++v) {
    largest = std::max(
        largest, (region_.points.col(v) - from.col(v)).norm() / std::max(lengths_[v], 1e-300));
  }
  return largest;
}

void Parametrization::iterate() {
  constexpr double kSmallMove = 2e-3;  // of an edge length
  constexpr double kLeastKept = 0.5;   // of the best scaled Jacobian met on the way
  double best = least_scaled_jacobian();
  Eigen::Matrix3Xd best_points = region_.points;
  while (report_.iterations < options_.max_iterations) {
    const Eigen::Matrix3Xd before = region_.points;
    std::vector<TargetCuboid> targets = target_cuboids(region_, options_.target);
    weigh_bad_hexes(targets);
    if (!relax_once(options_.energy, targets, options_.relaxation_iterations).feasible) break;
    goals_ = surface_goals(region_, reference_, options_.surface);
    report_.on_surface = move_to_goals(region_, goals_, kLeastOnProjection);
    ++report_.iterations;
    const double least = least_scaled_jacobian();
    if (least > best) {
      best = least;
      best_points = region_.points;
    }
    if (largest_relative_move(before) < kSmallMove) break;
  }
  // Later iterations are better spread and closer to the surface; go back only for validity.
  const double now = least_scaled_jacobian();
  if (now < best && (now < kLeastKept * best || now <= options_.min_scaled_jacobian)) {
    region_.points = best_points;
  }
}

ParametrizationReport Parametrization::run() {
  report_.initial_min_scaled_jacobian = least_scaled_jacobian();
  if (untangle()) iterate();
  const std::vector<double> sj = scaled_jacobians(region_.points, region_.hexes);
  if (sj.empty()) return report_;
  report_.min_scaled_jacobian = *std::min_element(sj.begin(), sj.end());
  report_.mean_scaled_jacobian =
      std::accumulate(sj.begin(), sj.end(), 0.0) / static_cast<double>(sj.size());
  if (!(report_.min_scaled_jacobian > 0)) {
    report_.failure = ParametrizationFailure::still_inverted;
  } else if (report_.min_scaled_jacobian < options_.min_scaled_jacobian) {
    report_.failure = ParametrizationFailure::low_quality;
  }
  return report_;
}

std::vector<VertexPull> goal_pulls(const Region& region, int vertex_slots,
                                   std::span<const VertexGoal> goals, double weight) {
  if (goals.empty()) return {};
  std::vector<int> local(vertex_slots, -1);
  for (int i = 0; i < region.n_free; ++i) local[region.vertices[i].idx] = i;
  const std::vector<double> lengths = edge_lengths_at_vertices(region);
  std::vector<VertexPull> pulls;
  for (const VertexGoal& g : goals) {
    const int v = local.at(g.vertex.idx);
    if (v < 0) continue;  // fixed
    const double length = std::max(lengths[v], 1e-300);
    pulls.push_back(point_pull(v, g.point, weight / (length * length)));
  }
  return pulls;
}

}  // namespace

void validate(const ParametrizationOptions& o) {
  const auto require = [](bool ok, const char* what, double value, const char* expected) {
    if (!ok) {
      throw InputError(std::string(what) + " = " + std::to_string(value) + ", expected " +
                       expected);
    }
  };
  require(o.max_iterations > 0, "max_iterations", o.max_iterations, "> 0");
  require(o.relaxation_iterations > 0, "relaxation_iterations", o.relaxation_iterations, "> 0");
  require(o.untangling_rounds >= 0, "untangling_rounds", o.untangling_rounds, ">= 0");
  require(o.min_scaled_jacobian >= -1 && o.min_scaled_jacobian < 1, "min_scaled_jacobian",
          o.min_scaled_jacobian, "[-1, 1)");
  require(o.quality_goal >= 0 && o.quality_goal <= 1, "quality_goal", o.quality_goal, "[0, 1]");
  require(o.quality_weight_limit >= 1, "quality_weight_limit", o.quality_weight_limit, ">= 1");
  require(o.surface.weight > 0, "surface.weight", o.surface.weight, "> 0");
  require(o.surface.feature_angle_deg > 0 && o.surface.feature_angle_deg <= 180,
          "surface.feature_angle_deg", o.surface.feature_angle_deg, "(0, 180]");
  require(o.goal_weight > 0, "goal_weight", o.goal_weight, "> 0");
  require(o.target.size_blend >= 0 && o.target.size_blend <= 1, "size_blend", o.target.size_blend,
          "[0, 1]");
}

std::string_view name(ParametrizationFailure failure) {
  switch (failure) {
    case ParametrizationFailure::still_inverted:
      return "still inverted";
    case ParametrizationFailure::low_quality:
      return "low quality";
    case ParametrizationFailure::none:
      break;
  }
  return "none";
}

ParametrizationReport parametrize(HexMesh& mesh, std::span<const CellHandle> cells,
                                  const ReferenceSurface& reference,
                                  const ParametrizationOptions& options,
                                  std::span<const VertexGoal> goals) {
  validate(options);
  Region region = make_region(mesh, cells);
  auto pulls = goal_pulls(region, mesh.vertex_slots(), goals, options.goal_weight);
  Parametrization parametrization(std::move(region), reference, options, std::move(pulls));
  ParametrizationReport report = parametrization.run();
  report.max_move = store_points(parametrization.region(), mesh);
  return report;
}

}  // namespace hexweft
