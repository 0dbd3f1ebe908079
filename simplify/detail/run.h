/// \file
/// One run of the simplification: the mesh, what belongs to it, and the state of the loop.
#pragma once

#include <chrono>
#include <functional>
#include <span>

#include "optimize/smooth.h"
#include "ovm/dual.h"
#include "simplify/candidates.h"
#include "simplify/checkpoint.h"
#include "simplify/failure_memory.h"
#include "simplify/peel.h"
#include "simplify/pillow_search.h"
#include "simplify/refine.h"
#include "simplify/trial.h"

namespace hexweft::detail {

class Round;  // round.h

class Run {
 public:
  using Clock = StageClock::Clock;
  /// \param reference  the surface of the input
  /// \param start  from when on its time counts
  /// \throws InputError if the base complex is not regular
  Run(HexMesh& mesh, const ReferenceSurface& reference, const SimplifyOptions& options,
      Clock::time_point start = Clock::now());
  /// Puts the checkpoint's mesh in the place of the input's.
  /// \throws InputError if it cannot have come from it; the mesh is then as it was
  void go_on_from(const Checkpoint& from);
  SimplifyReport run();

 private:
  /// How trials are made, and which have failed so.
  struct Manner {
    SimplifyOptions options;
    bool wanted = true;
    FailureMemory memory = {};
  };

  /// One manner's go at the candidates of the mesh as it is.
  struct Turn {
    const CandidateKeys& keys;
    bool patient;
    Manner& manner;
    Round& round;
  };
  /// One of the candidates.
  struct Proposal {
    std::vector<CandidatePart> parts;
    std::function<CollapsePlan()> plan;
    SimplifyProgress step;  ///< but for the plan's width
  };

  /// A candidate that may be tried.
  struct Ready {
    CandidateKey key;
    CollapsePlan plan;
    SimplifyProgress step;
    int components_gone = 0;  ///< if it was weighed
    double worth = 0;         ///< the same
  };

  /// What was accepted on the way to a mesh.
  struct Tally {
    int step, coarsened, refined, sheets, chords, peels, pillows;
    int collapses() const { return sheets + chords + peels + pillows; }
  };
  Tally tally() const {
    return {step_,
            report_.coarsened,
            report_.refined,
            report_.sheets.accepted,
            report_.chords.accepted,
            report_.peels.accepted,
            report_.pillows.accepted};
  }
  /// A mesh that may be written, to be gone back to.
  struct Milestone {
    HexMesh mesh;
    int components;
    Tally tally;
    StopReason stopped;  ///< the loop that led there
    bool smoothed;
    double hausdorff_ratio;  ///< if it is smoothed
  };

  // ---- The loop (run.cpp) ----
  void simplify_input();
  void coarsen_input();
  void loop();
  void loop_afresh();
  void loop_from_smoothed();
  void collapse_while_possible(std::span<Manner* const> in_turn);
  void finish();
  void go_on_from_relaxed();
  void go_on_with_all_cells();
  bool is_stuck();
  void refine_while_short();
  void put_layers_back();
  bool refine_longest();
  bool refine(RefineOptions options, double most_cells_rel = 1);
  bool refine_one(const DualSheet& sheet);
  double full_count() const;  // of cells, that the output is to have
  void aim_at(double cells);
  bool is_short_of_cells(double share) const;
  bool meets_target(int components) const;
  bool should_stop();   // for good or for lack of progress
  bool is_cut_short();  // asked to stop, or out of time

  // ---- A round of it (run_round.cpp) ----
  bool collapse_some(std::span<Manner* const> in_turn, bool patient);
  bool peel_some(std::span<Manner* const> in_turn);
  bool pillow_one();
  bool attempt(const Sheet& sheet, const Pillow& pillow, const SimplifyOptions& options);
  void know_base_complex();
  template <typename Fill>
  bool any_changes_mesh(std::span<Manner* const> in_turn, bool patient, Fill&& fill);
  int most_in_round() const;
  template <typename Candidates, typename Propose>
  void collapse_in_order(const Candidates& candidates, int most, TrialCounts& counts, Turn& turn,
                         Propose&& propose);
  void collapse_sheets(const CandidateQueues& queues, Turn& turn);
  void collapse_chords(const CandidateQueues& queues, Turn& turn);
  void collapse_peels(const std::vector<Peel>& peels, Turn& turn);
  std::optional<Ready> prepare(const Proposal& proposal, TrialCounts& counts, Turn& turn);
  bool weigh(Ready& candidate, int components, TrialCounts& counts, Turn& turn);
  bool carry_out(const Ready& candidate, TrialCounts& counts, Turn& turn);
  template <typename Trial>
  bool attempt(const Ready& candidate, TrialCounts& counts, Turn& turn, Trial&& trial);
  void accept(const SimplifyProgress& step);
  void relieve();
  void end(Round& round, const Tally& before, Manner& manner);
  void take_back(Round& round, const Tally& before, Refusal refusal, Manner& manner);
  void count_as_refused(const Tally& before, Refusal refusal);

  // ---- Meshes that may be written (run_milestones.cpp) ----
  Milestone milestone() const;
  bool may_be_written() const;
  void verify();
  void take_as_verified();
  void go_back();
  void return_to(const Milestone& milestone, Refusal refusal);
  bool ends_well();
  void end_with_what_may_be_written();
  void give_back_input();
  bool improve();
  bool is_better_than(const Milestone& other) const;

  // ---- What goes on beside it (run_record.cpp) ----
  double seconds() const;  // since the start of this run
  RunState state();
  void observe(SimplifyProgress p);
  void record();
  void tell_of_output(SimplifyProgress p);
  void tell(SimplifyProgress p);
  void keep_checkpoint(bool now = false);
  void keep_outcome();
  void replace_mesh(const HexMesh& mesh);
  void forget_failures();
  void compact();
  void close_gaps();
  void tidy_up();
  SmoothingOptions smoothing_options() const;
  void smooth_all(SmoothingOptions options);
  bool is_smoothed() const { return smoothed_step_ == step_; }
  double measured_ratio() const;
  void measure_output();
  StageTimer timer(Stage stage) { return {&clock_, stage}; }
  template <typename Work>
  auto timed(Stage stage, Work&& work) {
    const StageTimer t = timer(stage);
    return work();
  }

  HexMesh& mesh_;
  const SimplifyOptions& options_;
  Clock::time_point start_;
  StageClock clock_;
  ReferenceSurface reference_;
  SurfaceDistance distance_;
  TrialContext context_;
  BaseComplex bc_;
  bool bc_of_this_mesh_ =
      true;  // else of the mesh before splits, which leave the components as they are
  Manner careful_, ordinary_, bold_;
  std::vector<EdgeHandle> not_refinable_;  // lowest edges of sheets whose split failed on this mesh
  SimplifyReport report_;
  Milestone verified_;       // the last; at first the input
  double target_cells_ = 0;  // what the loop keeps the count near
  int step_ = 0;             // collapses, splits and layers that the mesh is away from the input
  int smoothed_step_ = -1;   // after which the mesh was smoothed the last time
  bool made_room_ = false;   // by what is for nothing without a collapse: layers, splits, relaxing
  std::vector<SimplifyProgress> observed_;  // not told yet: the components are still to be counted
  bool in_round_ = false, last_round_failed_ = false;
  int slots_gone_ = 0;  // of cells, in gaps that were closed since failures were forgotten
  int times_lost_ = 0;  // meshes that were not within the limit at full sampling
  bool may_be_given_up_ = false;  // what is done now, for a mesh that is better
  int failed_in_a_row_ = 0;  // trials that came as far as the geometry, since the last accepted one
  Clock::time_point last_checkpoint_;
  double earlier_seconds_ = 0;  // of runs before this one
  Profile earlier_profile_;
};

}  // namespace hexweft::detail
