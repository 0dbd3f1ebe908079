#include "simplify/profile.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace hexweft {
namespace {

// Those that were entered, most time first.
std::vector<Stage> in_order(const Profile& profile) {
  std::vector<Stage> stages;
  for (int i = 0; i < kStages; ++i) {
    const StageTime& t = profile.stages[i];
    if (t.entered > 0 || t.seconds > 0) stages.push_back(static_cast<Stage>(i));
  }
  std::stable_sort(stages.begin(), stages.end(),
                   [&](Stage a, Stage b) { return profile[a].seconds > profile[b].seconds; });
  return stages;
}

double share(const Profile& profile, Stage stage) {
  return profile[stage].seconds / std::max(profile.seconds(), 1e-300);
}

}  // namespace

std::string_view name(Stage stage) {
  static constexpr std::array<std::string_view, kStages> names = {
      "other",      "preparation", "base_complex",    "ranking",   "planning",      "trial",
      "plan_check", "structure",   "parametrization", "distance",  "full_distance", "relief",
      "coarsening", "refinement",  "verification",    "smoothing", "reporting"};
  return names[static_cast<std::size_t>(stage)];
}

double Profile::seconds() const {
  double sum = 0;
  for (const StageTime& t : stages) sum += t.seconds;
  return sum;
}

Profile& Profile::operator+=(const Profile& other) {
  for (int i = 0; i < kStages; ++i) {
    stages[i].seconds += other.stages[i].seconds;
    stages[i].entered += other.stages[i].entered;
  }
  return *this;
}

std::string Profile::table() const {
  std::string s = fmt::format("{:>16} {:>9} {:>7} {:>8}\n", "stage", "seconds", "share", "entered");
  for (const Stage stage : in_order(*this)) {
    const StageTime& t = (*this)[stage];
    s += fmt::format("{:>16} {:>9.3f} {:>5.1f} % {:>8}\n", name(stage), t.seconds,
                     100 * share(*this, stage), t.entered);
  }
  return s;
}

nlohmann::ordered_json Profile::json() const {
  nlohmann::ordered_json j = nlohmann::ordered_json::object();
  for (const Stage stage : in_order(*this)) {
    const StageTime& t = (*this)[stage];
    j[std::string(name(stage))] = {
        {"seconds", t.seconds}, {"share", share(*this, stage)}, {"entered", t.entered}};
  }
  return j;
}

StageClock::StageClock(Stage first, Clock::time_point since) : stage_(first), since_(since) {
  profile_[first].entered = 1;
}

void StageClock::charge() {
  const Clock::time_point now = Clock::now();
  profile_[stage_].seconds += std::chrono::duration<double>(now - since_).count();
  since_ = now;
}

Stage StageClock::enter(Stage stage) {
  const Stage before = stage_;
  back_to(stage);
  ++profile_[stage].entered;
  return before;
}

void StageClock::back_to(Stage stage) {
  charge();
  stage_ = stage;
}

const Profile& StageClock::profile() {
  charge();
  return profile_;
}

}  // namespace hexweft
