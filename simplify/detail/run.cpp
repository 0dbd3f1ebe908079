#include "simplify/detail/run.h"

#include <algorithm>

#include <fmt/format.h>

#include "ovm/errors.h"
#include "simplify/refine.h"

namespace hexweft::detail {
namespace {

// Normals are averaged across edges less sharp than this; it has no say in what is a feature line.
constexpr double kNormalAngle = 40;
// The loop samples the surface less densely than the last check: it keeps this share of the limit.
constexpr double kLoopShare = 0.95;
// Below this share of the wanted count of cells sheets that are as long across as the mean edge are
// split, a few at a time: with too few cells nothing stays on the surface, but every one costs time.
constexpr double kRefineBelow = 0.9;
constexpr double kLongAcross = 1.0;
constexpr int kSplitsAtOnce = 5;
// Up to this share sheets are split when nothing else goes on.
constexpr double kMostCells = 1.1;
// A verified copy of the mesh is kept whenever the components have fallen by this factor.
constexpr double kVerifyEvery = 0.5;

SimplifyOptions bold_options(SimplifyOptions options) {
  options.valence.max_angle_deg = options.bold.max_angle_deg;
  options.min_scaled_jacobian = options.bold.min_scaled_jacobian;
  options.mean_scaled_jacobian = options.bold.mean_scaled_jacobian;
  options.splits_per_trial = options.bold.splits_per_trial;
  return options;
}

}  // namespace

Run::Run(HexMesh& mesh, const SimplifyOptions& options)
    : mesh_(mesh),
      options_(options),
      start_(Clock::now()),
      clock_(Stage::preparation),
      reference_(make_reference_surface(mesh, kNormalAngle, options.features)),
      distance_(mesh, reference_),
      context_{mesh,
               reference_,
               distance_,
               summarize_topology(mesh),
               kLoopShare * options.hausdorff_limit_rel * reference_.bounding_box_diagonal(),
               options.hausdorff_limit_rel * reference_.bounding_box_diagonal(),
               static_cast<int>(kMostCells * options.target_hexahedra_rel * mesh.n_cells()),
               &clock_},
      bc_(extract_base_complex(mesh)),
      careful_{options, {}},
      bold_{bold_options(options), {}},
      last_checkpoint_(start_) {
  if (bc_.irregular > 0) {
    throw InputError(fmt::format("{} regions of the base complex are no cuboids", bc_.irregular));
  }
  report_.before = measure_mesh(mesh);
  verified_ = mesh;
  verified_components_ = report_.before.components;
}

SimplifyReport Run::run() {
  clock_.back_to(Stage::other);
  observe({.what = StepKind::start});
  loop();
  if (n_collapses() == 0 && step_ > 0) give_back_input();
  while (!is_cut_short() && is_short_of_cells(kRefineBelow) && refine(0)) {
  }
  end_with_what_may_be_written();
  keep_checkpoint(true);
  const bool smoothing = step_ > 0 && options_.smooth && !is_cut_short();
  if (smoothing) smooth_all();
  measure_output(smoothing);
  if (smoothing) tell_of_output({.what = StepKind::smoothing});
  return report_;
}

void Run::loop() {
  // Splitting a sheet comes before a second look at what failed lately: it gives that more room.
  const double long_enough = RefineOptions().min_length_rel;
  while (!should_stop()) {
    for (int i = 0; i < kSplitsAtOnce && is_short_of_cells(kRefineBelow); ++i) {
      if (!refine(kLongAcross)) break;
    }
    if (collapse_one(careful_, true) || collapse_one(bold_, true)) continue;
    if (!refine(long_enough, kMostCells) && !collapse_one(careful_, false) &&
        !collapse_one(bold_, false))
      break;
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

bool Run::should_stop() {
  if (is_cut_short()) return true;
  const auto components = static_cast<int>(bc_.components.size());
  const double rate = 1 - static_cast<double>(components) / report_.before.components;
  if ((options_.target_rate && rate >= *options_.target_rate) ||
      (options_.target_components && components <= *options_.target_components)) {
    report_.stopped = StopReason::target_reached;
  } else if (failed_in_a_row_ >= options_.max_failed_trials) {
    report_.stopped = StopReason::no_progress;
  } else {
    return false;
  }
  return true;
}

// Tries candidates in order until one is accepted. A patient look leaves out what failed lately.
bool Run::collapse_one(Manner& manner, bool patient) {
  if (&manner == &bold_ && !options_.bold.wanted) return false;
  if (!bc_of_this_mesh_) {
    const auto extracting = timer(Stage::base_complex);
    bc_ = extract_base_complex(mesh_);
    bc_of_this_mesh_ = true;
  }
  const CandidateQueues q = [&] {
    const auto ranking = timer(Stage::ranking);
    return make_queues(mesh_, bc_, options_, options_.ranking);
  }();
  return collapse_sheet(q, manner, patient) || collapse_chord(q, manner, patient);
}

bool Run::collapse_sheet(const CandidateQueues& q, Manner& manner, bool patient) {
  for (const Candidate& c : q.sheet_queue) {
    if (should_stop()) return true;
    const Sheet& sheet = q.sheets[c.index];
    const CollapsePlan plan = [&] {
      const auto planning = timer(Stage::planning);
      return plan_sheet_collapse(mesh_, bc_, sheet);
    }();
    const SimplifyProgress step = {.what = StepKind::sheet,
                                   .kind = name(sheet.kind),
                                   .width = plan.width,
                                   .sheet_terms = q.sheet_terms[c.index]};
    if (attempt(plan, report_.sheets, step, manner, patient)) return true;
  }
  return false;
}

bool Run::collapse_chord(const CandidateQueues& q, Manner& manner, bool patient) {
  for (const Candidate& c : q.chord_queue) {
    if (should_stop()) return true;
    const Chord& chord = q.chords[c.index];
    const ChordTerms& terms = q.chord_terms[c.index];
    const CollapsePlan plan = [&] {
      const auto planning = timer(Stage::planning);
      return plan_chord_collapse(mesh_, bc_, chord, terms.diagonal, q.sheets);
    }();
    const SimplifyProgress step = {.what = StepKind::chord,
                                   .kind = chord.closed ? "closed" : "open",
                                   .width = plan.width,
                                   .chord_terms = terms};
    if (attempt(plan, report_.chords, step, manner, patient)) return true;
  }
  return false;
}

bool Run::attempt(const CollapsePlan& plan, TrialCounts& counts, SimplifyProgress step,
                  Manner& manner, bool patient) {
  const bool waits = [&] {
    const auto planning = timer(Stage::planning);
    return manner.memory.should_wait(mesh_, plan, step_, patient);
  }();
  if (waits) {
    ++counts.waited;
    return false;
  }
  const double begun = seconds();
  TrialResult result = [&] {
    const auto trial = timer(Stage::trial);
    return try_collapse(context_, bc_, plan, manner.options);
  }();
  counts.seconds[static_cast<int>(result.refusal)] += seconds() - begun;
  if (!result.accepted()) {
    ++counts.refused[static_cast<int>(result.refusal)];
    manner.memory.failed(mesh_, plan, result.cause, step_);
    failed_in_a_row_ += is_geometric(result.refusal);
    return false;
  }
  ++counts.accepted;
  accept(std::move(result.base_complex), step);
  return true;
}

void Run::accept(BaseComplex bc, const SimplifyProgress& step) {
  bc_ = std::move(bc);
  ++step_;
  failed_in_a_row_ = 0;
  observe(step);
  relieve();
  not_refinable_.clear();
  if (static_cast<double>(bc_.components.size()) <= kVerifyEvery * verified_components_) verify();
  if (mesh_.cell_slots() > 4 * mesh_.n_cells()) compact();
  keep_checkpoint();
}

void Run::relieve() {
  const bool relieved = [&] {
    const auto relief = timer(Stage::relief);
    return relieve_farthest(context_, options_);
  }();
  if (relieved) observe({.what = StepKind::relief});
}

bool Run::is_short_of_cells(double share) const {
  return mesh_.n_cells() < share * options_.target_hexahedra_rel * report_.before.hexahedra;
}

// Splits one sheet if there is room for it.
bool Run::refine(double min_length_rel, double most_cells_rel) {
  const auto refining = timer(Stage::refinement);
  RefineOptions refine;
  refine.min_length_rel = min_length_rel;
  const double target = options_.target_hexahedra_rel * report_.before.hexahedra;
  refine.max_cells = static_cast<int>(
      std::max(1.5 * (target - mesh_.n_cells()), most_cells_rel * target - mesh_.n_cells()));
  constexpr int kTries = 4;  // what makes one split fail holds for most others
  for (int i = 0; i < kTries && !is_cut_short(); ++i) {
    const auto sheet = choose_sheet_to_refine(mesh_, distance_, refine, not_refinable_);
    if (!sheet) break;
    if (refine_one(*sheet)) return true;
    ++report_.refinement_failed;
    not_refinable_.push_back(sheet->edges.front());
  }
  return false;
}

bool Run::refine_one(const DualSheet& sheet) {
  if (!try_refine(context_, sheet, options_)) return false;
  ++report_.refined;
  not_refinable_.clear();
  bc_of_this_mesh_ = false;
  ++step_;
  observe({.what = StepKind::refinement});
  keep_checkpoint();
  return true;
}

}  // namespace hexweft::detail
