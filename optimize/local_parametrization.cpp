#include "optimize/local_parametrization.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <optional>
#include <string>

#include "optimize/problem_part.h"
#include "ovm/errors.h"

namespace hexweft {
namespace {

/// Corners flatter than this, relative to the target, count as inverted: a barrier energy started
/// there would spend its iterations on them alone.
constexpr double kFlat = 1e-3;

class Parametrization {
 public:
  /// \param region  is moved
  Parametrization(Region& region, SurfaceConstraint& constraint,
                  const ParametrizationOptions& options, std::vector<VertexPull> goals)
      : region_(region),
        options_(options),
        goal_pulls_(std::move(goals)),
        lengths_(edge_lengths_at_vertices(region_)),
        constraint_(constraint),
        goals_(find_goals()) {
    problem_.n_free = region_.n_free;
    problem_.hexes = region_.hexes;
    problem_.targets = target_cuboids(region_, options_.target);
  }

  ParametrizationReport run();

 private:
  std::vector<SurfaceGoal> find_goals() { return constraint_.goals(region_, options_.surface); }
  double least_determinant() const {
    const auto d = min_relative_determinants(region_.points, region_.hexes, problem_.targets);
    return d.empty() ? 1 : *std::min_element(d.begin(), d.end());
  }
  /// Measures the hexahedra anew. \return the least scaled Jacobian
  double measure() {
    scaled_jacobians_ = scaled_jacobians(region_.points, region_.hexes);
    return scaled_jacobians_.empty()
               ? 1
               : *std::min_element(scaled_jacobians_.begin(), scaled_jacobians_.end());
  }
  void weigh_bad_hexes();
  RelaxationReport relax_once(const Energy& energy, int iterations, ProblemPart* part = nullptr);
  std::optional<ProblemPart> part_round_flat() const;
  bool untangle();
  bool untangle(ProblemPart* part);
  void iterate(const Energy& energy, int iterations);
  double largest_relative_move(const Eigen::Matrix3Xd& from) const;

  Region& region_;
  const ParametrizationOptions& options_;
  std::vector<VertexPull> goal_pulls_;
  std::vector<double> lengths_;  // of edges at each vertex, at the start
  SurfaceConstraint& constraint_;
  std::vector<SurfaceGoal>
      goals_;                  // of the last projection; also the planes of the next relaxation
  RelaxationProblem problem_;  // has the points during a relaxation only; targets of the points
  std::vector<double> scaled_jacobians_;  // at the last measure()
  ParametrizationReport report_;
};

void Parametrization::weigh_bad_hexes() {
  for (std::size_t h = 0; h < problem_.targets.size(); ++h) {
    const double shortfall =
        std::max(1.0, options_.quality_goal / std::max(scaled_jacobians_[h], 1e-3));
    double weight = 1;
    for (int n = std::abs(options_.quality_exponent); n > 0; --n) weight *= shortfall;
    weight = std::min(weight, options_.quality_weight_limit);
    problem_.targets[h].weight = options_.quality_exponent > 0 ? weight : 1 / weight;
  }
}

RelaxationReport Parametrization::relax_once(const Energy& energy, int iterations,
                                             ProblemPart* part) {
  problem_.points.swap(region_.points);
  constraint_.pulls(problem_.points, goals_, options_.surface.weight, problem_.pulls);
  problem_.pulls.insert(problem_.pulls.end(), goal_pulls_.begin(), goal_pulls_.end());
  RelaxationOptions relaxation;
  relaxation.max_iterations = iterations;
  relaxation.iterations_per_restart = std::max(10, iterations);
  const RelaxationReport r =
      part ? part->relax(problem_, energy, relaxation) : relax(problem_, energy, relaxation);
  problem_.points.swap(region_.points);
  report_.relaxation_iterations += r.iterations;
  return r;
}

/// The hexahedra that are flat, with a few rings round them; none if that is most of the region.
std::optional<ProblemPart> Parametrization::part_round_flat() const {
  constexpr int kRings = 2;
  constexpr double kMost = 0.5;  // of the hexahedra
  const auto d = min_relative_determinants(region_.points, region_.hexes, problem_.targets);
  std::vector<int> flat;
  for (int h = 0; h < static_cast<int>(d.size()); ++h) {
    if (!(d[h] > kFlat)) flat.push_back(h);
  }
  const auto n_vertices = static_cast<int>(region_.points.cols());
  ProblemPart part(problem_, vertices_round(region_.hexes, n_vertices, flat, kRings));
  if (part.n_hexes() > kMost * static_cast<double>(region_.hexes.size())) return std::nullopt;
  return part;
}

/// Where few hexahedra are flat, as after most merges, what lies round them mostly suffices.
bool Parametrization::untangle() {
  if (least_determinant() > kFlat) return true;
  report_.untangled = true;
  if (options_.untangling_rounds == 0) return false;
  std::optional<ProblemPart> part = part_round_flat();
  if (part && untangle(&*part)) return true;
  return (!part || options_.untangle_widely) && untangle(nullptr);
}

/// Follows the regularized energy with ε tied to the worst corner, until no corner is flat.
/// \param part  moves, if not null; else all
bool Parametrization::untangle(ProblemPart* part) {
  constexpr int kIterations = 8;     // short rounds: the last one ends soon after nothing is flat
  constexpr int kRoundsPerGoal = 3;  // closest points cost as much as a round
  double least = least_determinant();
  int rounds_without_gain = 0;
  for (int round = 0; round < options_.untangling_rounds; ++round) {
    FoldoverFree energy;
    energy.epsilon = FoldoverFree::epsilon_for(least - kFlat);
    relax_once(energy, kIterations, part);
    problem_.targets = target_cuboids(region_, options_.target);
    if ((round + 1) % kRoundsPerGoal == 0) goals_ = find_goals();
    const double now = least_determinant();
    if (now > kFlat) return true;
    rounds_without_gain = now > least + 0.1 * std::abs(least) ? 0 : rounds_without_gain + 1;
    if (rounds_without_gain == 4) break;
    least = now;
  }
  return least_determinant() > 0;
}

double Parametrization::largest_relative_move(const Eigen::Matrix3Xd& from) const {
  double largest = 0;
  for (int v = 0; v < region_.n_free; ++v) {
    const double length = std::max(lengths_[v], 1e-300);
    largest =
        std::max(largest, (region_.points.col(v) - from.col(v)).squaredNorm() / (length * length));
  }
  return std::sqrt(largest);
}

/// \param iterations  at most, in the count of the report
void Parametrization::iterate(const Energy& energy, int iterations) {
  constexpr double kSmallMove = 2e-3;  // of an edge length
  constexpr double kLeastKept = 0.5;   // of the best scaled Jacobian met on the way
  double best = measure(), now = best;
  Eigen::Matrix3Xd best_points = region_.points, before;
  while (report_.iterations < iterations) {
    before = region_.points;
    if (report_.iterations > 0) problem_.targets = target_cuboids(region_, options_.target);
    weigh_bad_hexes();
    problem_.stay_valid = true;  // an energy without a barrier would let corners through
    if (!relax_once(energy, options_.relaxation_iterations).feasible) break;
    goals_ = find_goals();
    report_.on_surface = constraint_.move_to_goals(region_, goals_, options_.least_on_projection);
    ++report_.iterations;
    now = measure();
    if (now > best) {
      best = now;
      best_points = region_.points;
    }
    if (largest_relative_move(before) < kSmallMove) break;
  }
  // Later iterations are better spread and closer to the surface; go back only for validity.
  if (now < best && (now < kLeastKept * best || now <= options_.min_scaled_jacobian)) {
    region_.points = best_points;
  }
}

ParametrizationReport Parametrization::run() {
  report_.initial_min_scaled_jacobian = measure();
  if (untangle()) {
    iterate(options_.energy, options_.max_iterations);
    // An energy without a barrier may leave corners next to flat; one that has it mends them.
    constexpr int kMending = 2;
    if (!options_.energy.barrier() && measure() < options_.min_scaled_jacobian) {
      iterate(InverseScaledJacobian{}, report_.iterations + kMending);
    }
  }
  report_.min_scaled_jacobian = measure();
  const std::vector<double>& sj = scaled_jacobians_;
  if (sj.empty()) return report_;
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
  require(o.quality_goal > 0 && o.quality_goal <= 1, "quality_goal", o.quality_goal, "(0, 1]");

  require(o.quality_weight_limit >= 1, "quality_weight_limit", o.quality_weight_limit, ">= 1");
  require(o.surface.weight > 0, "surface.weight", o.surface.weight, "> 0");
  require(o.surface.feature_angle_deg > 0 && o.surface.feature_angle_deg <= 180,
          "surface.feature_angle_deg", o.surface.feature_angle_deg, "(0, 180]");
  require(o.least_on_projection >= -1 && o.least_on_projection <= 1, "least_on_projection",
          o.least_on_projection, "[-1, 1]");
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

RegionParametrization::RegionParametrization(const HexMesh& mesh,
                                             std::span<const CellHandle> region,
                                             const ReferenceSurface& reference)
    : region_(make_region(mesh, region)), constraint_(region_, reference) {}

ParametrizationReport RegionParametrization::run(HexMesh& mesh,
                                                 const ParametrizationOptions& options,
                                                 std::span<const VertexGoal> goals) {
  validate(options);
  load_points(mesh, region_);
  auto pulls = goal_pulls(region_, mesh.vertex_slots(), goals, options.goal_weight);
  ParametrizationReport report =
      Parametrization(region_, constraint_, options, std::move(pulls)).run();
  report.max_move = store_points(region_, mesh);
  return report;
}

ParametrizationReport parametrize(HexMesh& mesh, std::span<const CellHandle> region,
                                  const ReferenceSurface& reference,
                                  const ParametrizationOptions& options,
                                  std::span<const VertexGoal> goals) {
  return RegionParametrization(mesh, region, reference).run(mesh, options, goals);
}

}  // namespace hexweft
