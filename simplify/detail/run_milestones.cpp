// Meshes of a run that may be written: looking whether one may, going back to one, and which of two
// outcomes is the better.
#include "optimize/hausdorff.h"
#include "ovm/quality.h"
#include "ovm/topology_check.h"
#include "simplify/detail/run.h"

namespace hexweft::detail {

// The loop looks where a step has changed something, at few samples; this looks at everything.
bool Run::may_be_written() const {
  const TopologySummary t = summarize_topology(mesh_);
  return is_valid(mesh_) && min_scaled_jacobian(mesh_) > 0 && t.genus == context_.shape.genus &&
         t.n_parts == context_.shape.n_parts &&
         is_within(mesh_, reference_, context_.final_limit, {.parallel = options_.threads > 1});
}

// Keeps a copy that is within the limit at full sampling.
void Run::verify() {
  const auto verifying = timer(Stage::verification);
  if (may_be_written()) {
    take_as_verified();
  } else {
    go_back();
  }
}

void Run::take_as_verified() { verified_ = milestone(); }

Run::Milestone Run::milestone() const {
  return {mesh_,         static_cast<int>(bc_.components.size()),
          tally(),       report_.stopped,
          is_smoothed(), report_.hausdorff_ratio};
}

// To the last mesh that may be written; what comes keeps more distance from the limit.
void Run::go_back() {
  context_.distance_limit *= 0.95;
  ++times_lost_;
  return_to(verified_, Refusal::hausdorff);
}

void Run::return_to(const Milestone& milestone, Refusal refusal) {
  replace_mesh(milestone.mesh);
  count_as_refused(milestone.tally, refusal);
  smoothed_step_ = milestone.smoothed ? step_ : -1;
  report_.hausdorff_ratio = milestone.hausdorff_ratio;
  report_.stopped = milestone.stopped;
  is_cut_short();  // notes down why, if so
  observe({.what = StepKind::back});
  record();
}

bool Run::ends_well() {
  const auto verifying = timer(Stage::verification);
  return step_ == 0 || may_be_written();
}

void Run::end_with_what_may_be_written() {
  constexpr int kMore = 2;  // goes at what was lost
  bool well = ends_well();
  for (int i = 0; i < kMore && !well && !is_cut_short(); ++i) {
    go_back();
    loop_afresh();
    well = ends_well();
  }
  if (!well) go_back();
}

// Splits, layers taken out and relaxing that made room for no collapse were for nothing.
void Run::give_back_input() {
  const StopReason why = report_.stopped;
  return_to(verified_, Refusal::structure);
  report_.stopped = why;
  made_room_ = false;
}

// Has another go from the smoothed mesh. Of the two outcomes the better one is kept.
// \return whether one more may be worth its time
bool Run::improve() {
  constexpr double kWorthMore = 0.95;  // of the components are left at most
  const Milestone before = milestone();
  take_as_verified();
  may_be_given_up_ = true;
  loop_from_smoothed();
  if (report_.collapses() > before.tally.collapses()) finish();
  may_be_given_up_ = false;
  const bool changed = tally().step != before.tally.step,
             better = changed && is_better_than(before);
  if (changed && !better) return_to(before, Refusal::quality);
  keep_outcome();
  return better && static_cast<double>(bc_.components.size()) <= kWorthMore * before.components;
}

// Components for quality: a larger share of them has to be gone than of the least scaled Jacobian, but
// for those that were asked to go.
bool Run::is_better_than(const Milestone& other) const {
  if (meets_target(static_cast<int>(bc_.components.size()))) return true;
  const double left = static_cast<double>(bc_.components.size()) / other.components;
  return left < 1 && left <= min_scaled_jacobian(mesh_) / min_scaled_jacobian(other.mesh);
}

}  // namespace hexweft::detail
