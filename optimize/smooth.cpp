#include "optimize/smooth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "optimize/hausdorff.h"
#include "optimize/partial_move.h"
#include "optimize/region.h"
#include "optimize/smoothing_passes.h"
#include "optimize/surface_distance.h"
#include "ovm/errors.h"
#include "ovm/neighborhood.h"
#include "ovm/transaction.h"

namespace hexweft {
namespace {

// What lies between the samples is looked at before a pass is kept.
SurfaceDistanceOptions samples_for(double limit) {
  constexpr double kNegligible = 0.5;
  return {.mesh_levels = 1,
          .reference_levels = 1,
          .suspect_levels = 0,
          .negligible = kNegligible * limit};
}

constexpr double kLeastGain = 5e-3, kMeanGain = 5e-4;  // of a whole-mesh pass worth its time

/// What the passes for the mean have gained so far, over all cycles: each less than the one before it,
/// in about the same ratio.
struct MeanGains {
  double last_but_one = std::numeric_limits<double>::infinity(), last = last_but_one;

  /// Whether another pass may gain enough to be kept.
  bool promise_more() const {
    constexpr double kChance = 0.5;  // the ratio is not that steady
    if (std::isinf(last_but_one)) return last > 0;
    return last * last / last_but_one >= kChance * kMeanGain;
  }
  void add(double gain) { last_but_one = std::exchange(last, gain); }
};

/// What a pass must reach to be kept.
struct Aim {
  double floor;                  // of every hexahedron that moves, unless it was lower before
  double least_gain, mean_gain;  // of the scaled Jacobian; one of them is enough
  double room = 1;               // of the distance limit
};

class Smoother {
 public:
  /// \param limit  of the distance, model units
  /// \param gains  of earlier cycles; this one's are added
  Smoother(HexMesh& mesh, const ReferenceSurface& reference, const SmoothingOptions& options,
           double limit, MeanGains& gains)
      : mesh_(mesh),
        options_(options),
        mean_gains_(gains),
        distance_(mesh, reference, samples_for(limit)),
        cells_(all_cells(mesh)),
        limit_(limit) {}

  SmoothingReport run();

 private:
  bool attempt(const std::vector<CellHandle>& cells, const ParametrizationOptions& options,
               const Aim& aim);
  bool keep_gain(const Region& before, const Aim& aim);
  std::optional<double> mean_if_gained(const Quality& before, const Quality& now,
                                       std::size_t n_cells, const Aim& aim) const;
  void relax_for_least();
  void relax_for_mean();
  void relax_worst_cells();
  bool relax_round(CellHandle worst, double least_gain);
  bool stopped() const { return options_.stop.stop_requested(); }

  HexMesh& mesh_;
  const SmoothingOptions& options_;
  MeanGains& mean_gains_;
  SurfaceDistance distance_;
  std::vector<CellHandle> cells_;
  std::vector<CellHandle> moved_;  // of the last attempt
  double limit_;
  double mean_ = 1;  // scaled Jacobian of the mesh
  SmoothingReport report_;
};

/// \return the mean over the mesh, if the least or the mean scaled Jacobian of the cells gains enough,
/// the least does not fall, and the mean over the mesh stays above what it was at the start
std::optional<double> Smoother::mean_if_gained(const Quality& before, const Quality& now,
                                               std::size_t n_cells, const Aim& aim) const {
  const double mesh_mean = mean_ + (now.mean - before.mean) * static_cast<double>(n_cells) /
                                       static_cast<double>(cells_.size());
  const bool enough =
      now.least >= before.least + aim.least_gain || now.mean >= before.mean + aim.mean_gain;
  const bool falls = now.least < before.least ||
                     (now.mean < before.mean && mesh_mean < report_.initial_mean_scaled_jacobian);
  if (!enough || falls) return std::nullopt;
  return mesh_mean;
}

/// Keeps of the move what fits, if it gains. The distance is up to date if so, else as it was.
bool Smoother::keep_gain(const Region& before, const Aim& aim) {
  constexpr double kMargin = 0.95;  // hausdorff_distance() looks closer still at large triangles
  const MoveLimits limits = {aim.floor, aim.room * limit_, kMargin * limit_};
  const Quality old = quality_of(scaled_jacobians(before.points, before.hexes));
  std::optional<double> mesh_mean;
  const auto gains = [&](const std::vector<double>& sj) {
    mesh_mean = mean_if_gained(old, quality_of(sj), before.cells.size(), aim);
    return mesh_mean.has_value();
  };
  if (!keep_what_fits(mesh_, before, distance_, limits, gains)) return false;
  mean_ = *mesh_mean;
  return true;
}

/// Parametrizes the cells; all is undone unless it gains.
bool Smoother::attempt(const std::vector<CellHandle>& cells, const ParametrizationOptions& options,
                       const Aim& aim) {
  ++report_.trials;
  Transaction trial(mesh_);
  const Region before = make_region(mesh_, cells);
  parametrize(mesh_, cells, distance_.reference(), options);
  if (!keep_gain(before, aim)) return false;
  distance_.commit();
  trial.commit();
  return true;
}

/// Whole-mesh passes, while they gain something, which leave a part of the distance for the worst
/// cells. Where one gains nothing, the other treatment of the surface is tried, with all of the
/// distance; and after that the options as they were given.
void Smoother::relax_for_least() {
  constexpr double kRoom = 0.8;
  constexpr int kTries = 3;
  int failed = 0;
  for (int round = 0; round < options_.global_rounds && failed < kTries && !stopped(); ++round) {
    const double least = measure_quality(mesh_, cells_).least;
    ParametrizationOptions o = options_.parametrization;
    if (failed < 2) o = options_for_least(o, least);
    if (failed == 1) {
      const bool fit = o.surface.treatment == SurfaceTreatment::fit;
      o.surface.treatment = fit ? SurfaceTreatment::project : SurfaceTreatment::fit;
    }
    if (attempt(cells_, o, {least, kLeastGain, kMeanGain, failed > 0 ? 1 : kRoom})) {
      ++report_.accepted_global;
      failed = 0;
    } else {
      ++failed;
    }
  }
}

void Smoother::relax_for_mean() {
  for (int round = 0; round < options_.mean_rounds && mean_gains_.promise_more() && !stopped();
       ++round) {
    const double least = measure_quality(mesh_, cells_).least, before = mean_;
    const ParametrizationOptions o = options_for_mean(options_.parametrization, least);
    const bool gains = attempt(cells_, o, {least, kLeastGain, kMeanGain});
    mean_gains_.add(mean_ - before);
    if (!gains) break;
    ++report_.accepted_global;
  }
}

/// One cell's neighborhoods, growing, first with its surface held as
/// everywhere, then with a surface that gives way as far as the distance limit
/// allows.
bool Smoother::relax_round(CellHandle worst, double least_gain) {
  struct Rung {
    int rings;
    double surface_weight, least_on_projection;
  };
  const ParametrizationOptions& p = options_.parametrization;
  constexpr double kLeastOnProjection = 0.5;
  const double weak = options_.giving_way * p.surface.weight;
  const Rung ladder[] = {{2, p.surface.weight, p.least_on_projection},
                         {2, weak, kLeastOnProjection},
                         {4, weak, kLeastOnProjection}};
  const CellHandle seed[1] = {worst};
  for (const Rung& rung : ladder) {
    moved_ = grow_cells(mesh_, seed, rung.rings);
    const double floor = measure_quality(mesh_, moved_).least + least_gain;
    ParametrizationOptions o = p;
    o.surface.weight = rung.surface_weight;
    o.least_on_projection = rung.least_on_projection;
    o.max_iterations = 4;
    o.quality_goal = 1;
    o.quality_weight_limit = 1e3;
    o = options_for_least(o, floor);
    if (!o.energy.barrier()) o.min_scaled_jacobian = std::clamp(floor, 0.0, 0.9);
    if (attempt(moved_, o, {floor, least_gain, 1})) return true;
  }
  return false;
}

/// Worst cell first; one of which the neighborhoods all fail is left alone.
void Smoother::relax_worst_cells() {
  constexpr double kGain = 1e-3;
  std::vector<double> sj(mesh_.cell_slots(), 1);
  std::vector<char> left_alone(mesh_.cell_slots(), 0);
  const auto measure_again = [&](const std::vector<CellHandle>& cells) {
    const std::vector<double> now = scaled_jacobians(mesh_, cells);
    for (std::size_t i = 0; i < cells.size(); ++i) sj[cells[i].idx] = now[i];
  };
  measure_again(cells_);
  const int last = report_.trials + options_.local_trials;
  while (report_.trials < last && !stopped()) {
    CellHandle worst;
    for (CellHandle c : cells_) {
      if (left_alone[c.idx] || sj[c.idx] >= options_.enough_scaled_jacobian) continue;
      if (!worst.valid() || sj[c.idx] < sj[worst.idx]) worst = c;
    }
    if (!worst.valid()) break;
    if (relax_round(worst, kGain)) {
      ++report_.accepted_local;
      measure_again(moved_);
    } else {
      left_alone[worst.idx] = 1;
    }
  }
}

SmoothingReport Smoother::run() {
  const Quality before = measure_quality(mesh_, cells_);
  report_.initial_min_scaled_jacobian = before.least;
  report_.initial_mean_scaled_jacobian = mean_ = before.mean;
  relax_for_least();
  relax_worst_cells();
  relax_for_mean();
  const Quality now = measure_quality(mesh_, cells_);
  report_.min_scaled_jacobian = now.least;
  report_.mean_scaled_jacobian = now.mean;
  return report_;
}

double measured(const HexMesh& mesh, const ReferenceSurface& reference,
                const SmoothingOptions& options) {
  return hausdorff_ratio(mesh, reference, options.hausdorff_limit_rel);
}

/// One cycle. \param before  Hausdorff ratio at the start of the first, or what it is not over
/// \param gains  of the cycles before; this one's are added
/// \return nothing, with the mesh as it was, if all that it tried ended over the limit
std::optional<SmoothingReport> run_cycle(HexMesh& mesh, const ReferenceSurface& reference,
                                         const SmoothingOptions& options, double before,
                                         MeanGains& gains) {
  // The passes do not look quite as closely as the last word; where that is
  // over the limit, they start again with a little less room.
  const MeanGains earlier = gains;
  for (double room : {1.0, 0.9, 0.6}) {
    gains = earlier;
    if (room < 1 && options.initial_hausdorff_rel)
      before = std::min(before, measured(mesh, reference, options));
    Transaction attempt(mesh);
    const double limit = std::max(before, room * options.hausdorff_limit_rel);
    SmoothingReport report =
        Smoother(mesh, reference, options, limit * reference.bounding_box_diagonal(), gains).run();
    report.initial_hausdorff_rel = before;
    report.hausdorff_rel = measured(mesh, reference, options);
    if (report.hausdorff_rel > std::max(before, options.hausdorff_limit_rel)) continue;
    attempt.commit();
    return report;
  }
  return std::nullopt;
}

bool gained(const SmoothingReport& r) {
  return r.min_scaled_jacobian >= r.initial_min_scaled_jacobian + kLeastGain ||
         r.mean_scaled_jacobian >= r.initial_mean_scaled_jacobian + kMeanGain;
}

/// Of two cycles, one after the other.
SmoothingReport both(const SmoothingReport& first, const SmoothingReport& then) {
  SmoothingReport r = then;
  r.initial_min_scaled_jacobian = first.initial_min_scaled_jacobian;
  r.initial_mean_scaled_jacobian = first.initial_mean_scaled_jacobian;
  r.accepted_global += first.accepted_global;
  r.accepted_local += first.accepted_local;
  r.trials += first.trials;
  return r;
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
  if (o.initial_hausdorff_rel)
    require(*o.initial_hausdorff_rel >= 0, "initial_hausdorff_rel", *o.initial_hausdorff_rel,
            ">= 0");
  require(o.cycles > 0, "cycles", o.cycles, "> 0");
  require(o.global_rounds >= 0, "global_rounds", o.global_rounds, ">= 0");
  require(o.mean_rounds >= 0, "mean_rounds", o.mean_rounds, ">= 0");
  require(o.local_trials >= 0, "local_trials", o.local_trials, ">= 0");
  require(o.enough_scaled_jacobian >= 0 && o.enough_scaled_jacobian <= 1, "enough_scaled_jacobian",
          o.enough_scaled_jacobian, "[0, 1]");
  require(o.giving_way > 0 && o.giving_way <= 1, "giving_way", o.giving_way, "(0, 1]");
  validate(o.parametrization);
}

SmoothingReport smooth(HexMesh& mesh, const ReferenceSurface& reference,
                       const SmoothingOptions& options) {
  validate(options);
  if (mesh.n_cells() == 0) return {};
  const double before = options.initial_hausdorff_rel ? *options.initial_hausdorff_rel
                                                      : measured(mesh, reference, options);
  const Quality start = measure_quality(mesh, all_cells(mesh));
  SmoothingReport report;
  report.initial_min_scaled_jacobian = report.min_scaled_jacobian = start.least;
  report.initial_mean_scaled_jacobian = report.mean_scaled_jacobian = start.mean;
  report.initial_hausdorff_rel = report.hausdorff_rel = before;
  bool any = false;
  MeanGains gains;
  for (int cycle = 0; cycle < options.cycles && !options.stop.stop_requested(); ++cycle) {
    const auto next = run_cycle(mesh, reference, options, before, gains);
    if (!next) break;
    any = true;
    report = both(report, *next);
    if (!gained(*next)) break;
  }
  if (!any && options.initial_hausdorff_rel)
    report.hausdorff_rel = measured(mesh, reference, options);
  return report;
}

}  // namespace hexweft
