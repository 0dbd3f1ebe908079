#include "simplify/detail/run.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "ovm/errors.h"
#include "simplify/coarsen.h"
#include "simplify/refine.h"

namespace hexweft::detail {
namespace {

// The loop samples the surface less densely than the last check: it keeps this share of the limit.
constexpr double kLoopShare = 0.95;
// Below this share of the wanted count of cells sheets that are as long across as the mean edge are
// split, a few at a time: with too few cells nothing stays on the surface, but every one costs time.
constexpr double kRefineBelow = 0.9;
constexpr double kLongAcross = 1.0;
constexpr int kSplitsAtOnce = 5;
// Layers are taken out of the input if this share of the wanted count is left then, or less.
constexpr double kCoarse = 0.5;
// Up to this share sheets are split when nothing else goes on.
constexpr double kMostCells = 1.1;
// Meshes that were lost in a check at full sampling; hardly any run has one. After so many the limit is
// too close for what the loop can tell.
constexpr int kMostLost = 10;
// From the smoothed mesh on; hardly any is for something after these.
constexpr int kMostGoes = 3;

SimplifyOptions careful_options(SimplifyOptions options) {
  options.min_scaled_jacobian =
      std::max(options.min_scaled_jacobian, options.careful.min_scaled_jacobian);
  options.mean_scaled_jacobian =
      std::max(options.mean_scaled_jacobian, options.careful.mean_scaled_jacobian);
  return options;
}

SimplifyOptions bold_options(SimplifyOptions options) {
  options.valence.max_angle_deg = options.bold.max_angle_deg;
  options.valence.max_interior =
      std::max(options.valence.max_interior, options.bold.max_interior_valence);
  options.splits_per_trial = options.bold.splits_per_trial;
  options.merged_give_up_factor = options.bold.merged_give_up_factor;
  options.max_chord_deviation =
      std::max(options.max_chord_deviation, options.bold.max_chord_deviation);
  return options;
}

void expect_mesh_can_have(double cells) {
  constexpr int kMost = std::numeric_limits<int>::max() / 12;  // as many half-edges are numbered
  if (cells > kMost)
    throw InputError(
        fmt::format("{:.3g} hexahedra are asked for, expected at most {}", cells, kMost));
}

}  // namespace

Run::Run(HexMesh& mesh, const ReferenceSurface& reference, const SimplifyOptions& options,
         Clock::time_point start)
    : mesh_(mesh),
      options_(options),
      start_(start),
      clock_(Stage::preparation, start),
      reference_(reference),
      distance_(mesh, reference_,
                {.negligible = kNegligible * options.hausdorff_limit_rel *
                               reference_.bounding_box_diagonal()}),
      context_{mesh,
               reference_,
               distance_,
               summarize_topology(mesh),
               kLoopShare * options.hausdorff_limit_rel * reference_.bounding_box_diagonal(),
               options.hausdorff_limit_rel * reference_.bounding_box_diagonal(),
               0,
               &clock_},
      bc_(extract_base_complex(mesh)),
      careful_{careful_options(options), options.careful.wanted},
      ordinary_{options},
      bold_{bold_options(options), options.bold.wanted},
      last_checkpoint_(Clock::now()) {
  if (bc_.irregular > 0) {
    throw InputError(fmt::format("{} regions of the base complex are no cuboids", bc_.irregular));
  }
  report_.before = measure_mesh(mesh);
  expect_mesh_can_have(kMostCells * full_count());
  aim_at(full_count());
  take_as_verified();
}

SimplifyReport Run::run() {
  clock_.back_to(Stage::other);
  observe({.what = StepKind::start});
  record();
  if (!is_smoothed()) simplify_input();
  for (int i = 0; i < kMostGoes && is_smoothed() && is_stuck() && improve(); ++i) {
  }
  measure_output();
  if (is_smoothed()) tell_of_output({.what = StepKind::smoothing});
  return report_;
}

void Run::simplify_input() {
  coarsen_input();
  loop();
  go_on_with_all_cells();
  if (report_.collapses() == 0) go_on_from_relaxed();
  if (report_.collapses() == 0 && made_room_) give_back_input();
  finish();
  keep_outcome();
}

// What the loop has left is given its count of cells, and smoothed.
void Run::finish() {
  while (!is_cut_short() && is_short_of_cells(kRefineBelow) && refine_longest()) {
  }
  end_with_what_may_be_written();
  keep_checkpoint(true);
  if (step_ > 0 && options_.smooth && !is_cut_short()) smooth_all(smoothing_options());
}

// With fewer cells every trial costs less, and where they are many for their surface the loop comes
// farther: what has to move round a collapse to make up for it is so many cells wide.
void Run::coarsen_input() {
  const double most = kCoarse * full_count();  // as many cells as components are left at least
  if (!options_.coarsen || step_ > 0 || static_cast<double>(bc_.components.size()) > most) return;
  const int gone = timed(Stage::coarsening, [&] {
    return coarsen(context_, bc_, careful_.options, [&] { return is_cut_short(); });
  });
  if (gone == 0) return;
  // A node on a closed curve may have moved, and what it cuts with it: fewer components will do as well.
  BaseComplex now;
  if (mesh_.n_cells() > most ||
      check_structure(context_, bc_.components.size() + 1, now) != Refusal::none) {
    replace_mesh(verified_.mesh);
    return;
  }
  compact();
  step_ += gone;
  report_.coarsened = gone;
  made_room_ = true;
  aim_at(std::min<double>(mesh_.n_cells(), full_count()));
  observe({.what = StepKind::coarsening});
  record();
}

// What the loop has left of the distance may do for more when there are cells enough to spend it well.
void Run::go_on_with_all_cells() {
  const bool was_coarse = target_cells_ < full_count() && report_.collapses() > 0;
  if (was_coarse) put_layers_back();
  aim_at(full_count());
  if (was_coarse && is_stuck()) loop_afresh();
}

// Also where the run is cut short: it takes a moment, and the count is a part of what is asked for.
void Run::put_layers_back() {
  aim_at(std::min<double>(full_count(), report_.before.hexahedra));
  while (is_short_of_cells(kRefineBelow) && refine_longest()) {
  }
}

void Run::loop() {
  Manner* const in_turn[] = {&careful_, &ordinary_, &bold_};
  const auto goes_on = [&] {
    return (options_.peels && is_stuck() && peel_some(in_turn)) ||
           (options_.pillows && is_stuck() && pillow_one());
  };
  do {
    collapse_while_possible(in_turn);
  } while (goes_on());
}

// What has failed may be tried again at once.
void Run::loop_afresh() {
  forget_failures();
  failed_in_a_row_ = 0;
  report_.stopped = StopReason::nothing_left;
  loop();
}

void Run::collapse_while_possible(std::span<Manner* const> in_turn) {
  // Splitting a sheet comes before a second look at what failed lately: it gives that more room.
  refine_while_short();
  while (!should_stop()) {
    if (collapse_some(in_turn, true)) continue;
    if (!refine({}, kMostCells) && !collapse_some(in_turn.subspan(1), false)) break;
  }
}

// Where nothing went at all, it may once the whole mesh is relaxed: that is a little of the smoothing,
// as most such inputs are at their simplest and all of it would be for nothing.
void Run::go_on_from_relaxed() {
  if (!options_.smooth || !is_stuck()) return;
  SmoothingOptions relaxing = smoothing_options();
  relaxing.cycles = relaxing.mean_rounds = 1;
  relaxing.local_trials = 0;
  smooth_all(relaxing);
  made_room_ = true;
  loop_from_smoothed();
}

void Run::loop_from_smoothed() {
  compact();
  observe({.what = StepKind::smoothing});
  record();
  loop_afresh();
}

bool Run::is_stuck() {
  return !is_cut_short() && report_.stopped != StopReason::target_reached &&
         bc_.components.size() > 1;
}

// There is nothing to be done about the distance any more. Of any length, as the mesh may have come to
// be short of cells where none is long.
bool Run::refine_longest() { return refine({.min_length_rel = 0, .by_distance = kAllSheets}); }

void Run::refine_while_short() {
  for (int i = 0; i < kSplitsAtOnce && is_short_of_cells(kRefineBelow); ++i) {
    if (is_cut_short() || !refine({.min_length_rel = kLongAcross})) break;
  }
}

bool Run::is_cut_short() {
  if (options_.stop.stop_requested()) {
    report_.stopped = StopReason::interrupted;
  } else if (options_.max_seconds && seconds() >= *options_.max_seconds) {
    report_.stopped = StopReason::out_of_time;
  } else {
    return false;
  }
  return true;
}

bool Run::meets_target(int components) const {
  const double rate = 1 - static_cast<double>(components) / report_.before.components;
  return (options_.target_rate && rate >= *options_.target_rate) ||
         (options_.target_components && components <= *options_.target_components);
}

bool Run::should_stop() {
  if (is_cut_short()) return true;
  if (meets_target(static_cast<int>(bc_.components.size()))) {
    report_.stopped = StopReason::target_reached;
  } else if (failed_in_a_row_ >= options_.max_failed_trials || times_lost_ >= kMostLost) {
    report_.stopped = StopReason::no_progress;
  } else {
    return false;
  }
  return true;
}

double Run::full_count() const { return options_.target_hexahedra_rel * report_.before.hexahedra; }

void Run::aim_at(double cells) {
  target_cells_ = cells;
  context_.most_cells = static_cast<int>(kMostCells * cells);
}

bool Run::is_short_of_cells(double share) const { return mesh_.n_cells() < share * target_cells_; }

// Splits one sheet if there is room for it. The next one is chosen anew: a split shortens what lies
// beside it, and to take several by the same measures leaves a tenth more components in the end.
bool Run::refine(RefineOptions options, double most_cells_rel) {
  const auto refining = timer(Stage::refinement);
  options.max_cells = static_cast<int>(std::max(1.5 * (target_cells_ - mesh_.n_cells()),
                                                most_cells_rel * target_cells_ - mesh_.n_cells()));
  constexpr int kTries = 4;  // what makes one split fail holds for most others
  int failed = 0;
  for (EdgeHandle e : list_sheets_to_refine(mesh_, distance_, options, not_refinable_)) {
    if (failed == kTries) break;
    if (refine_one(dual_sheet(mesh_, e))) return true;
    ++failed;
    ++report_.refinement_failed;
    not_refinable_.push_back(e);
  }
  return false;
}

bool Run::refine_one(const DualSheet& sheet) {
  if (!try_refine(context_, sheet, options_)) return false;
  ++report_.refined;
  not_refinable_.clear();
  bc_of_this_mesh_ = false;
  ++step_;
  made_room_ = true;
  observe({.what = StepKind::refinement});
  if (!in_round_) record();
  return true;
}

}  // namespace hexweft::detail
