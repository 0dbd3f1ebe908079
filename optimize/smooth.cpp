#include "optimize/smooth.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "optimize/hausdorff.h"
#include "optimize/region.h"
#include "optimize/surface_distance.h"
#include "ovm/errors.h"
#include "ovm/transaction.h"

namespace hexweft {
namespace {

std::vector<CellHandle> all_cells(const HexMesh& mesh) {
  std::vector<CellHandle> cells;
  cells.reserve(mesh.n_cells());
  for (CellHandle c : mesh.cells()) cells.push_back(c);
  return cells;
}

std::vector<double> quality(const HexMesh& mesh, const std::vector<CellHandle>& cells) {
  const Region region = make_region(mesh, cells);
  return scaled_jacobians(region.points, region.hexes);
}

class Smoother {
 public:
  /// \param limit  of the distance, model units
  Smoother(HexMesh& mesh, const ReferenceSurface& reference, const SmoothingOptions& options,
           double limit)
      : mesh_(mesh),
        options_(options),
        distance_(mesh, reference, kSamples),
        cells_(all_cells(mesh)),
        limit_(std::max(limit, distance_.distance())) {}

  SmoothingReport run();

 private:
  static constexpr SurfaceDistanceOptions kSamples{.mesh_levels = 1, .reference_levels = 1};

  bool attempt(const std::vector<CellHandle>& region, const ParametrizationOptions& options,
               double least_gain);
  void relax_globally();
  void relax_worst_cells();

  HexMesh& mesh_;
  const SmoothingOptions& options_;
  SurfaceDistance distance_;
  std::vector<CellHandle> cells_;
  double limit_;
  SmoothingReport report_;
};

/// Parametrizes the region; keeps the result if its least scaled Jacobian gains enough and the
/// surface stays in its limit.
bool Smoother::attempt(const std::vector<CellHandle>& region, const ParametrizationOptions& options,
                       double least_gain) {
  ++report_.trials;
  Transaction trial(mesh_);
  const ParametrizationReport r = parametrize(mesh_, region, distance_.reference(), options);
  const double before = r.initial_min_scaled_jacobian;
  if (!(r.min_scaled_jacobian >= before + least_gain)) return false;
  if (distance_.after_change(mesh_, region, limit_) > limit_) {
    distance_.rollback();
    return false;
  }
  distance_.commit();
  trial.commit();
  return true;
}

/// Whole-mesh passes. When one is refused, the other treatment of the surface, and then fewer
/// iterations, which move less, are tried.
void Smoother::relax_globally() {
  for (int round = 0; round < options_.global_rounds; ++round) {
    ParametrizationOptions o = options_.parametrization;
    bool accepted = attempt(cells_, o, 0);
    if (!accepted) {
      const bool fit = o.surface.treatment == SurfaceTreatment::fit;
      o.surface.treatment = fit ? SurfaceTreatment::project : SurfaceTreatment::fit;
      accepted = attempt(cells_, o, 0);
    }
    if (!accepted) {
      o = options_.parametrization;
      o.max_iterations = 1;
      accepted = attempt(cells_, o, 0);
    }
    if (!accepted) break;
    ++report_.accepted_global;
  }
}

/// Worst cell first, in growing neighborhoods; a cell whose neighborhoods all fail is left alone.
void Smoother::relax_worst_cells() {
  constexpr double kGain = 1e-3;
  std::vector<char> left_alone(mesh_.cell_slots(), 0);
  std::vector<double> sj = quality(mesh_, cells_);
  std::vector<int> position(mesh_.cell_slots(), -1);
  for (std::size_t i = 0; i < cells_.size(); ++i) position[cells_[i].idx] = static_cast<int>(i);
  ParametrizationOptions o = options_.parametrization;
  o.quality_goal = 1;
  o.quality_weight_limit = 1e3;
  const int last = report_.trials + options_.local_trials;
  while (report_.trials < last) {
    int worst = -1;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      if (left_alone[cells_[i].idx] || sj[i] >= options_.enough_scaled_jacobian) continue;
      if (worst < 0 || sj[i] < sj[worst]) worst = static_cast<int>(i);
    }
    if (worst < 0) break;
    const CellHandle seed[1] = {cells_[worst]};
    bool accepted = false;
    for (int rings : {2, 3}) {
      const std::vector<CellHandle> region = grow_cells(mesh_, seed, rings);
      accepted = attempt(region, o, kGain);
      if (!accepted) continue;
      ++report_.accepted_local;
      const std::vector<double> now = quality(mesh_, region);
      for (std::size_t i = 0; i < region.size(); ++i) sj[position[region[i].idx]] = now[i];
      break;
    }
    if (!accepted) left_alone[cells_[worst].idx] = 1;
  }
}

SmoothingReport Smoother::run() {
  const auto summarize = [&](double& least, double& mean) {
    const std::vector<double> sj = quality(mesh_, cells_);
    least = *std::min_element(sj.begin(), sj.end());
    mean = std::accumulate(sj.begin(), sj.end(), 0.0) / static_cast<double>(sj.size());
  };
  summarize(report_.initial_min_scaled_jacobian, report_.initial_mean_scaled_jacobian);
  relax_globally();
  relax_worst_cells();
  summarize(report_.min_scaled_jacobian, report_.mean_scaled_jacobian);
  return report_;
}

SmoothingOptions untouched(SmoothingOptions options) {
  options.global_rounds = options.local_trials = 0;
  return options;
}

}  // namespace

void validate(const SmoothingOptions& o) {
  const auto require = [](bool ok, const char* what, double value, const char* expected) {
    if (!ok) {
      throw InputError(std::string(what) + " = " + std::to_string(value) + ", expected " +
                       expected);
    }
  };
  require(o.hausdorff_limit_rel > 0, "hausdorff_limit_rel", o.hausdorff_limit_rel, "> 0");
  require(o.global_rounds >= 0, "global_rounds", o.global_rounds, ">= 0");
  require(o.local_trials >= 0, "local_trials", o.local_trials, ">= 0");
  require(o.enough_scaled_jacobian >= 0 && o.enough_scaled_jacobian <= 1, "enough_scaled_jacobian",
          o.enough_scaled_jacobian, "[0, 1]");
  validate(o.parametrization);
}

SmoothingReport smooth(HexMesh& mesh, const ReferenceSurface& reference,
                       const SmoothingOptions& options) {
  validate(options);
  if (mesh.n_cells() == 0) return {};
  const double before = hausdorff_distance(mesh, reference).ratio();
  // The passes look at fewer samples than the final word; where that is over the limit, they start
  // again with a little less room.
  for (double room : {1.0, 0.8, 0.6}) {
    Transaction attempt(mesh);
    const double limit = room * options.hausdorff_limit_rel * reference.bounding_box_diagonal();
    SmoothingReport report = Smoother(mesh, reference, options, limit).run();
    report.initial_hausdorff_rel = before;
    report.hausdorff_rel = hausdorff_distance(mesh, reference).ratio();
    if (report.hausdorff_rel > std::max(before, options.hausdorff_limit_rel)) continue;
    attempt.commit();
    return report;
  }
  Transaction attempt(mesh);
  SmoothingReport report = Smoother(mesh, reference, untouched(options), 0).run();
  report.initial_hausdorff_rel = report.hausdorff_rel = before;
  return report;
}

}  // namespace hexweft
