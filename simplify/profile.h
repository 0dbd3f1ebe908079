/// \file
/// Where the time of a run goes, stage by stage.
///
///     StageClock clock;
///     {
///       const StageTimer timer(&clock, Stage::ranking);
///       ...
///     }
///     std::cout << clock.profile().table();
#pragma once

#include <array>
#include <chrono>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace hexweft {

enum class Stage {
  other,
  preparation,      ///< the reference surface, untangling and the figures of the input
  base_complex,     ///< where it is extracted anew
  ranking,          ///< sheets, chords and peels, their terms and cheap filters
  planning,         ///< which vertices a candidate would merge
  trial,            ///< the rest of the trial of a collapse: edit, roll back
  plan_check,       ///< of a trial: predicted valences and angles
  structure,        ///< of a trial: shape and base complex of the new mesh
  parametrization,  ///< of a trial
  distance,         ///< of trials and splits: to the surface, where it changed
  full_distance,    ///< of trials and splits close to the limit: at full sampling
  relief,           ///< relaxing round the place farthest from the surface
  coarsening,       ///< taking out layers; what it has in common with trials counts there
  refinement,       ///< splitting sheets
  verification,     ///< distance at full sampling, figures of the output
  smoothing,        ///< of the whole mesh at the end
  reporting         ///< observer and checkpoints
};
inline constexpr int kStages = static_cast<int>(Stage::reporting) + 1;
std::string_view name(Stage stage);

struct StageTime {
  double seconds = 0;
  int entered = 0;  ///< how often
};

/// The seconds of a run; a stage within another counts for itself only, so they add up to the run.
struct Profile {
  std::array<StageTime, kStages> stages = {};  ///< by Stage
  StageTime& operator[](Stage stage) { return stages[static_cast<int>(stage)]; }
  const StageTime& operator[](Stage stage) const { return stages[static_cast<int>(stage)]; }
  double seconds() const;
  Profile& operator+=(const Profile& other);
  std::string table() const;            ///< a line a stage that was entered, most time first
  nlohmann::ordered_json json() const;  ///< {stage: {seconds, share, entered}}, as table()
};

/// Counts the time for the stage it is in. Changing it costs one look at the clock.
class StageClock {
 public:
  using Clock = std::chrono::steady_clock;
  /// \param since  when the first stage began
  explicit StageClock(Stage first = Stage::other, Clock::time_point since = Clock::now());
  Stage enter(Stage stage);   ///< \return the stage before
  void back_to(Stage stage);  ///< as enter(), but not counted as entered again
  const Profile& profile();   ///< up to now

 private:
  void charge();

  Profile profile_;
  Stage stage_;
  Clock::time_point since_;
};

/// A stage for as long as it lives; then the stage before goes on. Without a clock it does nothing.
class StageTimer {
 public:
  StageTimer(StageClock* clock, Stage stage)
      : clock_(clock), before_(clock ? clock->enter(stage) : stage) {}
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;
  ~StageTimer() {
    if (clock_) clock_->back_to(before_);
  }

 private:
  StageClock* clock_;
  Stage before_;
};

}  // namespace hexweft
