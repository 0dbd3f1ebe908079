// The collapses of a run.
#include <algorithm>
#include <iterator>
#include <utility>

#include "simplify/detail/round.h"
#include "simplify/detail/run.h"
#include "simplify/feature_targets.h"

namespace hexweft::detail {
namespace {

// More would go by a ranking that is too old, but where there are very many components.
constexpr int kMostInRound = 8, kComponentsPerCollapse = 1000;
// Chords take turns with sheets: one at a time, and where there are many components one for so many.
constexpr int kComponentsPerChord = 500;
// A round ends where sheets have to be split, at this share of the wanted count of cells.
constexpr double kShortOfCells = 0.85;
// Below so many times the components that are asked for they are counted after every collapse.
constexpr double kNearTarget = 2;
// A verified copy of the mesh is kept whenever the components have fallen to this share.
constexpr double kVerifyEvery = 0.25;

}  // namespace

// Tries candidates in order; sheets, and chords where no sheet can be collapsed. Where nothing can be
// in one manner the next one has its turn. A patient look leaves out what failed lately.
// \return whether the loop should go on from the start
bool Run::collapse_some(std::span<Manner* const> in_turn, bool patient) {
  know_base_complex();
  const SimplifyOptions& widest = bold_.wanted ? bold_.options : options_;
  const CandidateQueues queues =
      timed(Stage::ranking, [&] { return make_queues(mesh_, bc_, widest, options_.ranking); });
  const bool changed = any_changes_mesh(in_turn, patient, [&](Turn& turn) {
    collapse_sheets(queues, turn);
    if (turn.round.empty()) collapse_chords(queues, turn);
  });
  return changed || should_stop();
}

// For where nothing else goes on: what peels leave behind is in the way of sheets more often than
// not.
// \return whether the loop should go on
bool Run::peel_some(std::span<Manner* const> in_turn) {
  const int failed_before = std::exchange(failed_in_a_row_, 0);
  know_base_complex();
  const std::vector<Peel> peels = timed(Stage::ranking, [&] {
    const auto on_feature = base_edges_on_features(bc_, context_.feature_labels());
    return extract_peels(bc_, extract_sheets(bc_), on_feature);
  });
  const bool changed =
      any_changes_mesh(in_turn, false, [&](Turn& turn) { collapse_peels(peels, turn); });
  if (changed) {
    report_.stopped = StopReason::nothing_left;
  } else {
    failed_in_a_row_ = failed_before;
  }
  return changed;
}

void Run::know_base_complex() {
  if (!bc_of_this_mesh_) {
    bc_ = timed(Stage::base_complex, [&] { return extract_base_complex(mesh_); });
    bc_of_this_mesh_ = true;
  }
  context_.labels.reset();
}

// Gives each manner a turn until one changes the mesh.
// \return whether one has, or did for a while
template <typename Fill>
bool Run::any_changes_mesh(std::span<Manner* const> in_turn, bool patient, Fill&& fill) {
  const CandidateKeys keys = timed(Stage::ranking, [&] { return CandidateKeys(mesh_, bc_); });
  return std::any_of(in_turn.begin(), in_turn.end(), [&](Manner* manner) {
    if (!manner->wanted || should_stop()) return false;
    const Tally before = tally();
    Round round(mesh_, bc_);
    Turn turn = {keys, patient, *manner, round};
    in_round_ = true;
    fill(turn);
    if (!round.empty()) end(round, before, *manner);
    in_round_ = false;
    return !round.empty();
  });
}

int Run::most_in_round() const {
  double target = options_.target_components.value_or(0);
  if (options_.target_rate)
    target = std::max(target, (1 - *options_.target_rate) * report_.before.components);
  const bool is_near = static_cast<double>(bc_.components.size()) < kNearTarget * target;
  if (is_near || last_round_failed_) return 1;
  return std::max(kMostInRound, static_cast<int>(bc_.components.size()) / kComponentsPerCollapse);
}

// Those that the round has room for, in order.
template <typename Candidates, typename Propose>
void Run::collapse_in_order(const Candidates& candidates, int most, TrialCounts& counts, Turn& turn,
                            Propose&& propose) {
  for (const auto& c : candidates) {
    if (should_stop()) return;
    if (!attempt(propose(c), counts, turn)) continue;
    if (std::ssize(turn.round.collapses()) >= most || is_short_of_cells(kShortOfCells)) return;
  }
}

void Run::collapse_sheets(const CandidateQueues& q, Turn& turn) {
  const auto propose = [&](const Candidate& c) {
    const Sheet& sheet = q.sheets[c.index];
    return Proposal{
        parts_of(sheet),
        [&] { return plan_sheet_collapse(mesh_, bc_, sheet); },
        {.what = StepKind::sheet, .kind = name(sheet.kind), .sheet_terms = q.sheet_terms[c.index]}};
  };
  collapse_in_order(q.sheet_queue, most_in_round(), report_.sheets, turn, propose);
}

void Run::collapse_chords(const CandidateQueues& q, Turn& turn) {
  const int fair = static_cast<int>(bc_.components.size()) / kComponentsPerChord;
  const int most = std::clamp(fair, 1, most_in_round());
  const auto propose = [&](const Candidate& c) {
    const Chord& chord = q.chords[c.index];
    const ChordTerms& terms = q.chord_terms[c.index];
    const auto find_parts = [&] { return parts_of(mesh_, bc_, chord, terms.diagonal, q.sheets); };
    return Proposal{
        timed(Stage::planning, find_parts),
        [&] { return plan_chord_collapse(mesh_, bc_, chord, terms.diagonal, q.sheets); },
        {.what = StepKind::chord, .kind = chord.closed ? "closed" : "open", .chord_terms = terms}};
  };
  std::vector<Candidate> queue;
  std::copy_if(q.chord_queue.begin(), q.chord_queue.end(), std::back_inserter(queue),
               [&](const Candidate& c) {
                 return q.chord_terms[c.index].deviation <= turn.manner.options.max_chord_deviation;
               });
  collapse_in_order(queue, most, report_.chords, turn, propose);
}

void Run::collapse_peels(const std::vector<Peel>& peels, Turn& turn) {
  const auto propose = [&](const Peel& peel) {
    return Proposal{parts_of(peel),
                    [&] { return plan_peel(mesh_, bc_, peel); },
                    {.what = StepKind::peel, .kind = name(peel.kind)}};
  };
  collapse_in_order(peels, most_in_round(), report_.peels, turn, propose);
}

bool Run::attempt(const Proposal& proposal, TrialCounts& counts, Turn& turn) {
  Manner& manner = turn.manner;
  Round& round = turn.round;
  if (!round.is_clear_of(proposal.parts)) return false;
  const CandidateKey key = turn.keys.key(proposal.parts);
  if (manner.memory.should_wait(key, step_, turn.patient)) {
    ++counts.waited;
    return false;
  }
  const CollapsePlan plan = timed(Stage::planning, proposal.plan);
  if (!round.is_clear_of(plan)) return false;
  const bool has_cause = timed(
      Stage::planning, [&] { return manner.memory.has_cause(mesh_, plan, step_, turn.patient); });
  if (has_cause) {
    ++counts.waited;
    return false;
  }
  const double begun = seconds();
  const TrialResult result = timed(Stage::trial, [&] {
    return try_collapse_locally(
        context_, bc_.graph, plan, manner.options,
        [&](const Outlook& outlook) { return manner.memory.refusal_with(outlook); });
  });
  counts.seconds[static_cast<int>(result.refusal)] += seconds() - begun;
  if (!result.accepted()) {
    ++counts.refused[static_cast<int>(result.refusal)];
    const auto remember = [&](Manner& failed) {
      failed.memory.failed(key, result.refusal, step_);
      failed.memory.failed_at(mesh_, plan, result.cause, step_);
      if (result.outlook) failed.memory.failed_with(*result.outlook, result.refusal);
    };
    remember(manner);
    // Careful trials differ from ordinary ones in their floors only; bold ones take away more yet.
    const bool has_another_chance = &manner == &careful_ && result.refusal == Refusal::quality;
    if (&manner == &careful_ && !has_another_chance) remember(ordinary_);
    if (&manner != &bold_ && is_of_shape(result.refusal)) remember(bold_);
    failed_in_a_row_ += is_geometric(result.refusal) && !has_another_chance && round.empty();
    return false;
  }
  ++counts.accepted;
  round.add(key, plan);
  SimplifyProgress step = proposal.step;
  step.width = plan.width;
  accept(step);
  return true;
}

void Run::accept(const SimplifyProgress& step) {
  ++step_;
  failed_in_a_row_ = 0;
  not_refinable_.clear();
  observe(step);
  relieve();
}

void Run::relieve() {
  if (timed(Stage::relief, [&] { return relieve_farthest(context_, options_); }))
    observe({.what = StepKind::relief});
}

// Splits what has to be split, then takes the look at the whole mesh that the trials did without.
void Run::end(Round& round, const Tally& before, Manner& manner) {
  refine_while_short();
  BaseComplex after;
  const Refusal refusal = check_structure(context_, bc_.components.size(), after);
  last_round_failed_ = refusal != Refusal::none;
  if (last_round_failed_) {
    take_back(round, before, refusal, manner);
    return;
  }
  round.commit();
  bc_ = std::move(after);
  bc_of_this_mesh_ = true;
  if (static_cast<double>(bc_.components.size()) <= kVerifyEvery * verified_components_) verify();
  if (mesh_.cell_slots() > 4 * mesh_.n_cells()) compact();
  record();
}

// Of several the guilty one is not known: they are tried again one by one.
void Run::take_back(Round& round, const Tally& before, Refusal refusal, Manner& manner) {
  round.take_back();
  distance_ = SurfaceDistance(mesh_, reference_, distance_.options());
  bc_of_this_mesh_ = true;
  not_refinable_.clear();
  observed_.clear();
  count_as_refused(before, refusal);
  if (round.collapses().size() == 1)
    manner.memory.failed(round.collapses().front(), refusal, step_);
}

// What was accepted since then.
void Run::count_as_refused(const Tally& before, Refusal refusal) {
  step_ = before.step;
  report_.refined = before.refined;
  const auto refuse = [&](TrialCounts& counts, int accepted_before) {
    counts.refused[static_cast<int>(refusal)] += counts.accepted - accepted_before;
    counts.accepted = accepted_before;
  };
  refuse(report_.sheets, before.sheets);
  refuse(report_.chords, before.chords);
  refuse(report_.peels, before.peels);
}

}  // namespace hexweft::detail
