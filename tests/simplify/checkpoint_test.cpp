// Runs that are gone on with.
#include "simplify/checkpoint.h"

#include <functional>
#include <optional>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "ovm/errors.h"
#include "tests/mesh_families.h"
#include "tests/simplify/loop_checks.h"

namespace hexweft {
namespace {

HexMesh make_input() { return make_octree_like(Shape::sphere, 6); }

// The checkpoint after so many steps of a run that is stopped then.
Checkpoint checkpoint_after(int steps, const HexMesh& input) {
  std::optional<Checkpoint> kept;
  std::stop_source source;
  SimplifyOptions options;
  options.stop = source.get_token();
  options.checkpoint_every_s = 0;
  options.checkpoint = [&](const HexMesh& mesh, const RunState& state) {
    kept = {mesh, state};
    if (state.step >= steps) source.request_stop();
  };
  HexMesh mesh = input;
  EXPECT_EQ(simplify(mesh, options).stopped, StopReason::interrupted);
  EXPECT_GE(kept->state.step, steps);
  return *kept;
}

TEST(Checkpoint, StateReadsBack) {
  RunState s = checkpoint_after(2, make_input()).state;
  s.distance_share = 0.95;
  const nlohmann::ordered_json j = to_json(s);
  EXPECT_EQ(to_json(run_state(j)), j);
  EXPECT_EQ(run_state(j).step, s.step);
  EXPECT_EQ(run_state(j).sheets.accepted, s.sheets.accepted);
}

TEST(Checkpoint, StateThatIsNoneIsRefused) {
  const nlohmann::ordered_json good = to_json(RunState());
  EXPECT_NO_THROW(run_state(good));
  EXPECT_THROW(run_state({}), InputError);
  EXPECT_THROW(run_state(nlohmann::ordered_json::array({1, 2})), InputError);
  for (const auto& [key, value] : good.items()) {
    nlohmann::ordered_json j = good;
    j.erase(key);
    EXPECT_THROW(run_state(j), InputError) << key;
    j[key] = "many";
    EXPECT_THROW(run_state(j), InputError) << key;
  }
  nlohmann::ordered_json j = good;
  j["step"] = -1;
  EXPECT_THROW(run_state(j), InputError);
}

TEST(Checkpoint, RunGoesOnTowardsTheOriginalInput) {
  const HexMesh input = make_input();
  const Checkpoint from = checkpoint_after(3, input);
  HexMesh mesh = input;
  SimplifyOptions options;
  int first_step = -1;
  options.observer = [&](const SimplifyProgress& p) {
    if (p.what == StepKind::start) first_step = p.step;
  };
  const SimplifyReport report = resume_simplify(mesh, from, options);
  expect_good_output(input, mesh, report);  // its distance and counts are those to the input
  EXPECT_EQ(first_step, from.state.step);
  EXPECT_GE(report.sheets.accepted, from.state.sheets.accepted);
  EXPECT_GE(report.seconds, from.state.seconds);
  EXPECT_LE(report.after.components, measure_mesh(from.mesh).components);
  EXPECT_GE(report.profile[Stage::trial].entered, from.state.profile[Stage::trial].entered);
}

TEST(Checkpoint, ResumedTwiceItGivesTheSameBits) {
  const HexMesh input = make_input();
  const Checkpoint from = checkpoint_after(2, input);
  HexMesh a = input, b = input;
  resume_simplify(a, from);
  resume_simplify(b, from);
  EXPECT_TRUE(content(a) == content(b));
}

TEST(Checkpoint, KeepingThemDoesNotChangeTheRun) {
  HexMesh a = make_input(), b = make_input();
  SimplifyOptions options;
  options.checkpoint_every_s = 0;
  int kept = 0;
  options.checkpoint = [&](const HexMesh& mesh, const RunState&) {
    EXPECT_TRUE(is_good(mesh));
    ++kept;
  };
  const SimplifyReport report = simplify(a, options);
  simplify(b);
  EXPECT_TRUE(content(a) == content(b));
  EXPECT_GT(kept, 2);
  EXPECT_LE(kept, report.collapses() + report.refined + 1);
}

// What the loop does with fewer cells than the input has goes on with as many.
TEST(Checkpoint, OfACoarsenedMeshKnowsItsCount) {
  const HexMesh input = split_in_eight(make_pillowed_grid(3));
  std::optional<Checkpoint> from;  // the first after a collapse
  SimplifyOptions options;
  options.checkpoint_every_s = 0;
  options.checkpoint = [&](const HexMesh& mesh, const RunState& state) {
    if (!from && state.sheets.accepted > 0) from = {mesh, state};
  };
  HexMesh whole_run = input;
  simplify(whole_run, options);
  ASSERT_TRUE(from && from->state.coarsened > 0);
  EXPECT_LT(from->state.target_cells, input.n_cells() / 2);
  HexMesh mesh = input;
  const SimplifyReport report = resume_simplify(mesh, *from);
  expect_good_output(input, mesh, report);
  EXPECT_EQ(report.coarsened, from->state.coarsened);
  EXPECT_GE(report.after.hexahedra, 0.85 * input.n_cells());
}

TEST(Checkpoint, OfAFinishedRunEndsAtOnceWithNoMore) {
  const HexMesh input = make_pillowed_grid(3);
  std::optional<Checkpoint> kept;
  SimplifyOptions options;
  options.checkpoint = [&](const HexMesh& mesh, const RunState& state) { kept = {mesh, state}; };
  HexMesh first = input, second = input;
  simplify(first, options);
  ASSERT_TRUE(kept.has_value());
  const SimplifyReport report = resume_simplify(second, *kept);
  expect_good_output(input, second, report);
  EXPECT_EQ(report.after.components, 1);
  EXPECT_EQ(report.sheets.accepted, kept->state.sheets.accepted);
}

TEST(Checkpoint, OfAnotherShapeIsRefused) {
  const HexMesh input = make_input();
  for (const HexMesh& other : {make_torus(), make_two_boxes(), HexMesh()}) {
    HexMesh mesh = input;
    EXPECT_THROW(resume_simplify(mesh, {other, {}}), InputError);
    EXPECT_TRUE(content(mesh) == content(input));
  }
}

// Of the right shape, but beside the surface: the result is the input's, not the checkpoint's.
TEST(Checkpoint, BesideTheSurfaceIsNotReturned) {
  const HexMesh input = make_grid({4, 4, 4});
  HexMesh moved = input, mesh = input;
  for (const VertexHandle v : moved.vertices()) {
    moved.set_point(v, 1.1 * moved.point(v));
  }
  RunState state;
  state.step = 1;
  const SimplifyReport report = resume_simplify(mesh, {moved, state});
  expect_good_output(input, mesh, report);
}

TEST(Fingerprint, TellsMeshesApart) {
  const HexMesh grid = make_grid({2, 2, 2});
  EXPECT_EQ(fingerprint(grid), fingerprint(make_grid({2, 2, 2})));
  HexMesh other = grid;
  other.set_point(VertexHandle(3), other.point(VertexHandle(3)) + Eigen::Vector3d(1e-15, 0, 0));
  EXPECT_NE(fingerprint(grid), fingerprint(other));
  EXPECT_NE(fingerprint(grid), fingerprint(make_grid({2, 2, 1})));
  HexMesh gaps = grid;
  const VertexHandle extra = gaps.add_vertex({9, 9, 9});
  gaps.delete_vertex(extra);
  EXPECT_EQ(fingerprint(grid), fingerprint(gaps));
}

TEST(LastingOptions, LeaveOutWhatEndsARun) {
  SimplifyOptions a, b;
  b.max_seconds = 3;
  b.target_components = 10;
  b.threads = 2;
  EXPECT_EQ(lasting_options(a), lasting_options(b));
}

TEST(LastingOptions, TellOptionsOfEveryPartApart) {
  const std::function<void(SimplifyOptions&)> changes[] = {
      [](SimplifyOptions& o) { o.weights.beta = 2; },
      [](SimplifyOptions& o) { o.valence.min_interior = 4; },
      [](SimplifyOptions& o) { o.careful.wanted = false; },
      [](SimplifyOptions& o) { o.bold.max_interior_valence = 6; },
      [](SimplifyOptions& o) { o.features.mode = FeatureMode::off; },
      [](SimplifyOptions& o) { o.parametrization.energy = SymmetricDirichlet{}; },
      [](SimplifyOptions& o) { o.parametrization.quality_exponent = 1; },
      [](SimplifyOptions& o) { o.parametrization.least_on_projection = 0; },
      [](SimplifyOptions& o) { o.parametrization.surface.weight = 1; },
      [](SimplifyOptions& o) { o.parametrization.target.blend_passes = 0; },
      [](SimplifyOptions& o) { o.smoothing_trials = 0; }};
  for (const auto& change : changes) {
    SimplifyOptions changed;
    change(changed);
    EXPECT_NE(lasting_options(changed), lasting_options({}));
  }
}

}  // namespace
}  // namespace hexweft
