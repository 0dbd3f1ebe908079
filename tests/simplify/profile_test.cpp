// The clock of stages: exclusive, nested, complete.
#include "simplify/profile.h"

#include <thread>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace hexweft {
namespace {

void pass_time(int milliseconds) {
  std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
}

TEST(StageClock, StageWithinAnotherCountsForItselfOnly) {
  StageClock clock;
  {
    const StageTimer outer(&clock, Stage::trial);
    pass_time(5);
    {
      const StageTimer inner(&clock, Stage::base_complex);
      pass_time(20);
    }
    pass_time(5);
  }
  const Profile p = clock.profile();
  EXPECT_GE(p[Stage::base_complex].seconds, 0.020);
  EXPECT_GE(p[Stage::trial].seconds, 0.010);
  EXPECT_EQ(p[Stage::trial].entered, 1);
  EXPECT_EQ(p[Stage::base_complex].entered, 1);
  EXPECT_EQ(p[Stage::ranking].entered, 0);
  EXPECT_NEAR(p.seconds(), p[Stage::trial].seconds + p[Stage::base_complex].seconds, 1e-3);
}

TEST(StageClock, StartsInAStage) {
  StageClock clock(Stage::preparation);
  pass_time(2);
  clock.back_to(Stage::other);
  EXPECT_GE(clock.profile()[Stage::preparation].seconds, 0.002);
}

TEST(StageTimer, WithoutAClockDoesNothing) { const StageTimer timer(nullptr, Stage::trial); }

TEST(Profile, AddsUp) {
  Profile a, b;
  a[Stage::trial] = {1, 2};
  b[Stage::trial] = {3, 4};
  b[Stage::smoothing] = {4, 1};
  a += b;
  EXPECT_EQ(a[Stage::trial].seconds, 4);
  EXPECT_EQ(a[Stage::trial].entered, 6);
  EXPECT_EQ(a.seconds(), 8);
  const auto j = a.json();
  EXPECT_EQ(j.size(), 2u);
  EXPECT_EQ(j["smoothing"]["share"], 0.5);
  EXPECT_EQ(Profile().json().size(), 0u);
}

}  // namespace
}  // namespace hexweft
