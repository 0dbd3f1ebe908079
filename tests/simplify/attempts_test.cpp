// Several runs, of which the best is taken.
#include "simplify/attempts.h"

#include <chrono>
#include <set>
#include <thread>

#include <gmock/gmock.h>

#include "ovm/errors.h"
#include "tests/mesh_families.h"
#include "tests/simplify/loop_checks.h"

namespace hexweft {
namespace {

constexpr int kAttempts = 3;

HexMesh make_input() { return make_octree_like(Shape::blob, 8, 1); }

SimplifyOptions some_attempts(int threads = 1) {
  SimplifyOptions options;
  options.attempts = kAttempts;
  options.threads = threads;
  return options;
}

TEST(Attempts, WeightsOfTheFirstAreAsTheyAreAndOthersNear) {
  const RankingWeights w = polycube_weights();
  const auto list = [](const RankingWeights& x) {
    return std::vector{x.k_valence, x.k_width,    x.k_distortion,        x.beta,
                       x.min_width, x.mean_width, x.distortion_threshold};
  };
  EXPECT_EQ(list(weights_of_attempt(w, 0)), list(w));
  std::set<std::vector<double>> seen;
  for (int attempt = 0; attempt < 100; ++attempt) {
    const RankingWeights of_this = weights_of_attempt(w, attempt);
    EXPECT_NO_THROW(validate(of_this));
    EXPECT_EQ(list(of_this), list(weights_of_attempt(w, attempt)));
    seen.insert(list(of_this));
    for (std::size_t i = 0; i < list(w).size(); ++i) {
      EXPECT_GE(list(of_this)[i], list(w)[i] / 1.5 * (1 - 1e-12));
      EXPECT_LE(list(of_this)[i], list(w)[i] * 1.5 * (1 + 1e-12));
    }
  }
  EXPECT_EQ(seen.size(), 100u);
}

TEST(Attempts, TheBestIsTaken) {
  const HexMesh input = make_input();
  HexMesh mesh = input;
  const SimplifyReport report = simplify(mesh, some_attempts());
  expect_good_output(input, mesh, report);
  ASSERT_EQ(report.attempts.size(), std::size_t{kAttempts});
  for (int i = 0; i < kAttempts; ++i) {
    SCOPED_TRACE(i);
    SimplifyOptions alone;
    alone.weights = weights_of_attempt(alone.weights, i);
    HexMesh other = input;
    const SimplifyReport r = simplify(other, alone);
    EXPECT_TRUE(r.attempts.empty());
    const AttemptFigures& a = report.attempts[i];
    EXPECT_EQ(a.attempt, i);
    EXPECT_EQ(a.components, r.after.components);
    EXPECT_EQ(a.mean_scaled_jacobian, r.after.mean_scaled_jacobian);
    EXPECT_LE(report.after.components, a.components);
    EXPECT_TRUE(report.after.components < a.components ||
                report.after.mean_scaled_jacobian >= a.mean_scaled_jacobian);
    EXPECT_TRUE(i != report.attempt || content(mesh) == content(other));
  }
}

TEST(Attempts, ThreadsDoNotMatter) {
  HexMesh one = make_input(), three = one;
  const SimplifyReport a = simplify(one, some_attempts(1)), b = simplify(three, some_attempts(3));
  EXPECT_TRUE(content(one) == content(three));
  EXPECT_EQ(a.attempt, b.attempt);
  EXPECT_EQ(a.attempts.size(), b.attempts.size());
}

TEST(Attempts, NoneIsBegunAfterTheTargetIsReached) {
  for (const int threads : {1, 3}) {
    SimplifyOptions options = some_attempts(threads);
    options.target_rate = 0.3;
    HexMesh mesh = make_input();
    const SimplifyReport report = simplify(mesh, options);
    EXPECT_EQ(report.stopped, StopReason::target_reached);
    EXPECT_EQ(report.attempt, 0);
    EXPECT_GE(report.rate(), 0.3);
    EXPECT_LE(report.attempts.size(), static_cast<std::size_t>(threads));
  }
}

TEST(Attempts, OneThatReachesTheTargetIsNotCutShortByALaterOne) {
  std::stop_source stop;
  SimplifyOptions options = some_attempts(2);
  options.target_rate = 0.3;
  options.stop = stop.get_token();
  options.observer = [&](const SimplifyProgress& p) {
    if (p.attempt == 0 && p.what == StepKind::smoothing) stop.request_stop();
    if (p.attempt == 1) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  };
  HexMesh mesh = make_input();
  const SimplifyReport report = simplify(mesh, options);
  EXPECT_EQ(report.attempt, 0);
  EXPECT_EQ(report.stopped, StopReason::target_reached);
}

TEST(Attempts, TheFirstIsMadeEvenIfStopped) {
  std::stop_source stop;
  stop.request_stop();
  SimplifyOptions options = some_attempts();
  options.stop = stop.get_token();
  const HexMesh input = make_input();
  HexMesh mesh = input;
  const SimplifyReport report = simplify(mesh, options);
  EXPECT_EQ(report.stopped, StopReason::interrupted);
  EXPECT_EQ(report.attempts.size(), 1u);
  EXPECT_TRUE(content(mesh) == content(input));
}

TEST(Attempts, ShareTheTime) {
  SimplifyOptions options = some_attempts();
  options.max_seconds = 1e-6;
  HexMesh mesh = make_input();
  const SimplifyReport report = simplify(mesh, options);
  EXPECT_EQ(report.stopped, StopReason::out_of_time);
  EXPECT_EQ(report.attempts.size(), 1u);
}

TEST(Attempts, ObserverIsToldOfEach) {
  for (const int threads : {1, kAttempts}) {
    SimplifyOptions options = some_attempts(threads);
    std::vector<int> starts;
    options.observer = [&](const SimplifyProgress& p) {
      if (p.what == StepKind::start) starts.push_back(p.attempt);
    };
    HexMesh mesh = make_pillowed_grid(3);
    simplify(mesh, options);
    EXPECT_THAT(starts, testing::UnorderedElementsAre(0, 1, 2));
  }
}

TEST(Attempts, HaveNoCheckpoints) {
  HexMesh mesh = make_pillowed_grid(3);
  SimplifyOptions options;
  std::optional<Checkpoint> kept;
  options.checkpoint = [&](const HexMesh& m, const RunState& s) { kept = {m, s}; };
  HexMesh copy = mesh;
  simplify(copy, options);
  ASSERT_TRUE(kept.has_value());
  options.attempts = 2;
  EXPECT_THROW(simplify(mesh, options), InputError);
  EXPECT_THROW(resume_simplify(mesh, *kept, some_attempts()), InputError);
}

TEST(Attempts, BadOptionsAndMeshesAreRefusedInEach) {
  HexMesh mesh = make_grid({2, 2, 2});
  SimplifyOptions options;
  options.attempts = 0;
  EXPECT_THROW(simplify(mesh, options), InputError);
  HexMesh empty;
  EXPECT_THROW(simplify(empty, some_attempts(2)), InputError);
}

}  // namespace
}  // namespace hexweft
