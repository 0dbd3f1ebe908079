// The collapses of a run.
#include <algorithm>
#include <iterator>
#include <utility>

#include "simplify/detail/round.h"
#include "simplify/detail/run.h"
#include "simplify/feature_targets.h"
#include "simplify/pillowed_collapse.h"
#include "simplify/surface_check.h"

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

// For where not even peels go: the pillows that gain most, until one succeeds.
// \return whether the loop should go on
bool Run::pillow_one() {
  constexpr int kMostTried = 8;  // hardly any of the others succeeds
  know_base_complex();
  // It is a last resort, so any valence will do, but it has to leave good hexahedra.
  SimplifyOptions options = bold_.wanted ? bold_.options : options_;
  options.min_scaled_jacobian = careful_.options.min_scaled_jacobian;
  options.mean_scaled_jacobian = careful_.options.mean_scaled_jacobian;
  const std::vector<Sheet> sheets = timed(Stage::ranking, [&] { return extract_sheets(bc_); });
  const std::vector<PillowedSheet> candidates = timed(Stage::planning, [&] {
    return find_pillows(mesh_, bc_, sheets, options.valence, kMostTried);
  });
  for (const PillowedSheet& c : candidates) {
    if (is_cut_short()) return false;
    if (attempt(sheets[c.sheet], c.pillow, options)) return true;
  }
  return false;
}

bool Run::attempt(const Sheet& sheet, const Pillow& pillow, const SimplifyOptions& options) {
  const double begun = seconds();
  TrialResult result = timed(
      Stage::trial, [&] { return try_pillowed_collapse(context_, bc_, sheet, pillow, options); });
  report_.pillows.seconds[static_cast<int>(result.refusal)] += seconds() - begun;
  if (!result.accepted()) {
    ++report_.pillows.refused[static_cast<int>(result.refusal)];
    return false;
  }
  ++report_.pillows.accepted;
  report_.stopped = StopReason::nothing_left;
  bc_ = std::move(result.base_complex);
  accept({.what = StepKind::pillow, .kind = name(sheet.kind), .width = sheet.width});
  refine_while_short();
  record();
  return true;
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

// Those that the round has room for, in order; of those compared at a time the one worth most.
template <typename Candidates, typename Propose>
void Run::collapse_in_order(const Candidates& candidates, int most, TrialCounts& counts, Turn& turn,
                            Propose&& propose) {
  const bool compares = options_.compare > 1;
  std::vector<Ready> pool;
  auto components = static_cast<int>(bc_.components.size());
  for (auto next = candidates.begin();;) {
    while (std::ssize(pool) < options_.compare && next != candidates.end()) {
      // However many fail beside one that succeeds, that is progress.
      if (pool.empty() && should_stop()) return;
      std::optional<Ready> ready = prepare(propose(*next++), counts, turn);
      if (ready && (!compares || weigh(*ready, components, counts, turn)))
        pool.push_back(*std::move(ready));
    }
    if (pool.empty() || is_cut_short()) return;
    const auto best = std::max_element(
        pool.begin(), pool.end(), [](const Ready& a, const Ready& b) { return a.worth < b.worth; });
    const Ready candidate = std::move(*best);
    pool.erase(best);
    if (!turn.round.is_clear_of(candidate.plan) || !carry_out(candidate, counts, turn)) continue;
    components -= candidate.components_gone;
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

std::optional<Run::Ready> Run::prepare(const Proposal& proposal, TrialCounts& counts, Turn& turn) {
  FailureMemory& memory = turn.manner.memory;
  if (!turn.round.is_clear_of(proposal.parts)) return std::nullopt;
  const CandidateKey key = turn.keys.key(proposal.parts);
  if (memory.should_wait(key, step_, turn.patient)) {
    ++counts.waited;
    return std::nullopt;
  }
  Ready ready = {key, timed(Stage::planning, proposal.plan), proposal.step};
  if (!turn.round.is_clear_of(ready.plan)) return std::nullopt;
  const bool has_cause = timed(
      Stage::planning, [&] { return memory.has_cause(mesh_, ready.plan, step_, turn.patient); });
  if (has_cause) {
    ++counts.waited;
    return std::nullopt;
  }
  ready.step.width = ready.plan.width;
  return ready;
}

// Components that go for the distance and the quality spent.
bool Run::weigh(Ready& candidate, int components, TrialCounts& counts, Turn& turn) {
  constexpr double kFree = 1;  // what a collapse costs that spends nothing
  CollapseOutcome outcome;
  const auto trial = [&](const KnownFailure& known) {
    return weigh_collapse(context_, bc_, candidate.plan, turn.manner.options, outcome, known);
  };
  if (!attempt(candidate, counts, turn, trial)) return false;
  const double spent =
      kFree + std::max(0.0, outcome.distance_spent) + std::max(0.0, outcome.quality_spent);
  candidate.components_gone = components - outcome.components;
  candidate.worth = candidate.components_gone / spent;
  return true;
}

bool Run::carry_out(const Ready& candidate, TrialCounts& counts, Turn& turn) {
  const auto trial = [&](const KnownFailure& known) {
    return try_collapse_locally(context_, bc_.graph, candidate.plan, turn.manner.options, known);
  };
  if (!attempt(candidate, counts, turn, trial)) return false;
  ++counts.accepted;
  turn.round.add(candidate.key, candidate.plan);
  accept(candidate.step);
  return true;
}

template <typename Trial>
bool Run::attempt(const Ready& candidate, TrialCounts& counts, Turn& turn, Trial&& trial) {
  Manner& manner = turn.manner;
  const double begun = seconds();
  const TrialResult result = timed(Stage::trial, [&] {
    return trial([&](const Outlook& outlook) { return manner.memory.refusal_with(outlook); });
  });
  counts.seconds[static_cast<int>(result.refusal)] += seconds() - begun;
  if (result.accepted()) return true;
  ++counts.refused[static_cast<int>(result.refusal)];
  const auto remember = [&](Manner& failed) {
    failed.memory.failed(candidate.key, result.refusal, step_);
    failed.memory.failed_at(mesh_, candidate.plan, result.cause, step_);
    if (result.outlook) failed.memory.failed_with(*result.outlook, result.refusal);
  };
  remember(manner);
  // Careful trials differ from ordinary ones in their floors only; bold ones take away more yet.
  const bool has_another_chance = &manner == &careful_ && result.refusal == Refusal::quality;
  if (&manner == &careful_ && !has_another_chance) remember(ordinary_);
  if (&manner != &bold_ && is_of_shape(result.refusal)) remember(bold_);
  failed_in_a_row_ += is_geometric(result.refusal) && !has_another_chance && turn.round.empty();
  return false;
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
  tidy_up();
  record();
  if (static_cast<double>(bc_.components.size()) <= kVerifyEvery * verified_.components) verify();
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
  report_.coarsened = before.coarsened;
  report_.refinement_failed += report_.refined - before.refined;
  report_.refined = before.refined;
  const auto refuse = [&](TrialCounts& counts, int accepted_before) {
    counts.refused[static_cast<int>(refusal)] += counts.accepted - accepted_before;
    counts.accepted = accepted_before;
  };
  refuse(report_.sheets, before.sheets);
  refuse(report_.chords, before.chords);
  refuse(report_.peels, before.peels);
  refuse(report_.pillows, before.pillows);
}

}  // namespace hexweft::detail
