// What goes on beside the loop: telling, keeping, measuring, ending.
#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <thread>

#include <fmt/format.h>

#include "optimize/hausdorff.h"
#include "optimize/smoothing_passes.h"
#include "ovm/errors.h"
#include "ovm/neighborhood.h"
#include "ovm/quality.h"
#include "ovm/topology_check.h"
#include "simplify/detail/run.h"

namespace hexweft::detail {
namespace {

// Asks for a stop when the time is over, unless this thread is ended before.
std::jthread stop_after(double seconds, const std::stop_source& source) {
  return std::jthread([seconds, source](const std::stop_token& end) {
    std::mutex mutex;
    std::condition_variable_any wait;
    std::unique_lock lock(mutex);
    wait.wait_for(lock, end, std::chrono::duration<double>(seconds), [] { return false; });
    if (!end.stop_requested()) source.request_stop();
  });
}

}  // namespace

double Run::seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

void Run::go_on_from(const Checkpoint& from) {
  const TopologySummary t = summarize_topology(from.mesh), &input = context_.shape;
  if (t.genus != input.genus || t.n_parts != input.n_parts ||
      t.n_boundary_components != input.n_boundary_components) {
    throw InputError(
        fmt::format("the checkpoint's mesh has genus {}, {} parts and {} boundary surfaces, the "
                    "input {}, {} and {}",
                    t.genus, t.n_parts, t.n_boundary_components, input.genus, input.n_parts,
                    input.n_boundary_components));
  }
  if (const int n = extract_base_complex(from.mesh).irregular; n > 0) {
    throw InputError(fmt::format("{} regions of the checkpoint's base complex are no cuboids", n));
  }
  const RunState& s = from.state;
  replace_mesh(from.mesh);
  step_ = s.step;
  made_room_ = true;
  context_.distance_limit = s.distance_share * context_.final_limit;
  aim_at(s.target_cells);
  report_.sheets = s.sheets;
  report_.chords = s.chords;
  report_.peels = s.peels;
  report_.pillows = s.pillows;
  report_.coarsened = s.coarsened;
  report_.refined = s.refined;
  report_.refinement_failed = s.refinement_failed;
  earlier_seconds_ = s.seconds;
  earlier_profile_ = s.profile;
  if (report_.collapses() == 0 || !may_be_written()) return;
  if (s.smoothed) {
    smoothed_step_ = step_;
    report_.hausdorff_ratio = measured_ratio();
  }
  take_as_verified();
}

RunState Run::state() {
  RunState s;
  s.step = step_;
  s.smoothed = is_smoothed();
  s.distance_share = context_.distance_limit / context_.final_limit;
  s.target_cells = target_cells_;
  s.sheets = report_.sheets;
  s.chords = report_.chords;
  s.peels = report_.peels;
  s.pillows = report_.pillows;
  s.coarsened = report_.coarsened;
  s.refined = report_.refined;
  s.refinement_failed = report_.refinement_failed;
  s.seconds = earlier_seconds_ + seconds();
  s.profile = earlier_profile_;
  s.profile += clock_.profile();
  return s;
}

void Run::observe(SimplifyProgress p) {
  if (!options_.observer) return;
  const auto reporting = timer(Stage::reporting);
  const Quality now = measure_quality(mesh_, all_cells(mesh_));
  p.step = step_;
  p.hexahedra = mesh_.n_cells();
  p.components = static_cast<int>(bc_.components.size());
  p.hausdorff_ratio = distance_.ratio();
  p.min_scaled_jacobian = now.least;
  p.mean_scaled_jacobian = now.mean;
  p.seconds = earlier_seconds_ + seconds();
  observed_.push_back(p);
}

// Once the components have been counted, which holds from the last collapse on.
void Run::record() {
  const auto last = std::find_if(observed_.rbegin(), observed_.rend(),
                                 [](const SimplifyProgress& p) { return is_collapse(p.what); });
  if (last != observed_.rend()) {
    for (auto p = last.base() - 1; p != observed_.end(); ++p)
      p->components = static_cast<int>(bc_.components.size());
  }
  for (const SimplifyProgress& p : observed_) tell(p);
  observed_.clear();
  keep_checkpoint();
}

void Run::tell_of_output(SimplifyProgress p) {
  if (!options_.observer) return;
  p.hexahedra = report_.after.hexahedra;
  p.components = report_.after.components;
  p.hausdorff_ratio = report_.hausdorff_ratio;
  p.min_scaled_jacobian = report_.after.min_scaled_jacobian;
  p.mean_scaled_jacobian = report_.after.mean_scaled_jacobian;
  p.step = step_;
  p.seconds = earlier_seconds_ + seconds();
  tell(p);
}

void Run::tell(SimplifyProgress p) {
  p.input_components = report_.before.components;
  options_.observer(p);
}

void Run::keep_checkpoint(bool now) {
  if (!options_.checkpoint || may_be_given_up_) return;
  const std::chrono::duration<double> since = Clock::now() - last_checkpoint_;
  if (!now && since.count() < options_.checkpoint_every_s) return;
  const auto reporting = timer(Stage::reporting);
  options_.checkpoint(mesh_, state());
  last_checkpoint_ = Clock::now();
}

// Unless more of the loop would follow, had the run not been told to end.
void Run::keep_outcome() {
  const bool is_done = !is_cut_short() && report_.stopped != StopReason::target_reached;
  if (is_smoothed() && is_done) keep_checkpoint(true);
}

// Handles change: what is known by handle is made anew.
void Run::replace_mesh(const HexMesh& mesh) {
  const auto extracting = timer(Stage::base_complex);
  if (&mesh != &mesh_) mesh_ = mesh;
  mesh_.collect_garbage();
  bc_ = extract_base_complex(mesh_);
  bc_of_this_mesh_ = true;
  distance_ = SurfaceDistance(mesh_, reference_, distance_.options());
  slots_gone_ = 0;
  forget_failures();
}

void Run::forget_failures() {
  for (Manner* m : {&careful_, &ordinary_, &bold_}) m->memory.forget_all();
  not_refinable_.clear();
}

void Run::compact() { replace_mesh(mesh_); }

// What is scattered takes longer to visit. What failed when most of the cells were others may succeed.
void Run::tidy_up() {
  constexpr double kMostSlots = 1.5, kMostMade = 4;  // for each cell that is there
  const int made = mesh_.cell_slots() + slots_gone_;
  if (made > kMostMade * mesh_.n_cells()) {
    compact();
  } else if (mesh_.cell_slots() > kMostSlots * mesh_.n_cells()) {
    close_gaps();
  }
}

// Handles change, and what is known goes on with the new ones.
void Run::close_gaps() {
  const auto extracting = timer(Stage::base_complex);
  slots_gone_ += mesh_.cell_slots() - mesh_.n_cells();
  const Renumbering now = mesh_.collect_garbage();
  bc_ = extract_base_complex(mesh_);
  context_.labels.reset();
  distance_.renumber(now);
  for (Manner* m : {&careful_, &ordinary_, &bold_}) m->memory.renumber(now);
  for (EdgeHandle& e : not_refinable_) e = now[e];
  std::erase_if(not_refinable_, [](EdgeHandle e) { return !e.valid(); });
}

// What collapses leave is poor in few places: passes over the whole mesh for its worst cells gain less
// than they cost. A sharpened energy gains as much where the surface gives way less, and a nearer mesh
// leaves the loop more room; others need it weaker.
SmoothingOptions Run::smoothing_options() const {
  constexpr double kGivingWay = 0.2;
  const bool is_sharp = may_be_sharpened(options_.parametrization.energy);
  return {.hausdorff_limit_rel = options_.hausdorff_limit_rel,
          .global_rounds = 0,
          .local_trials = options_.smoothing_trials,
          .giving_way = is_sharp ? kGivingWay : SmoothingOptions().giving_way,
          .parametrization = options_.parametrization,
          .initial_hausdorff_rel = options_.hausdorff_limit_rel};
}

void Run::smooth_all(SmoothingOptions options) {
  const auto smoothing = timer(Stage::smoothing);
  std::stop_source cut;
  const std::stop_callback when_asked(options_.stop, [&cut] { cut.request_stop(); });
  const std::jthread when_late =
      options_.max_seconds ? stop_after(*options_.max_seconds - seconds(), cut) : std::jthread();
  options.stop = cut.get_token();
  report_.hausdorff_ratio = smooth(mesh_, reference_, options).hausdorff_rel;
  smoothed_step_ = step_;
  if (cut.stop_requested()) is_cut_short();  // notes down why
}

double Run::measured_ratio() const {
  return hausdorff_ratio(mesh_, reference_, options_.hausdorff_limit_rel,
                         {.parallel = options_.threads > 1});
}

void Run::measure_output() {
  const auto measuring = timer(Stage::verification);
  if (!is_smoothed()) report_.hausdorff_ratio = measured_ratio();
  mesh_.collect_garbage();
  report_.after = measure_mesh(mesh_);
  report_.seconds = earlier_seconds_ + seconds();
  report_.profile = state().profile;
}

}  // namespace hexweft::detail
