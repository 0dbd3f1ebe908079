// The loop on small meshes.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <thread>

#include <Eigen/Geometry>
#include <gmock/gmock.h>

#include "tests/mesh_families.h"
#include "tests/random.h"
#include "tests/simplify/loop_checks.h"

namespace hexweft {
namespace {

class RandomSheet : public testing::TestWithParam<unsigned> {};
INSTANTIATE_TEST_SUITE_P(Simplify, RandomSheet, testing::Range(1u, 11u));

TEST_P(RandomSheet, IsFoundAndRemovedFromAGrid) {
  const HexMesh input = make_grid_with_random_sheets(1, GetParam());
  ASSERT_GT(extract_base_complex(input).components.size(), 1u);
  const SimplifyReport report = simplify_well(input);
  EXPECT_EQ(report.after.components, 1);
  EXPECT_EQ(report.stopped, StopReason::nothing_left);
}

TEST(Simplify, SeveralRandomSheetsAreMostlyRemoved) {
  // Sheets that cross on the edges of the box may hold each other in place.
  int back_to_one = 0;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const HexMesh input = make_grid_with_random_sheets(3, seed);
    const SimplifyReport report = simplify_well(input);
    back_to_one += report.after.components == 1;
  }
  EXPECT_GE(back_to_one, 4);
}

TEST(Simplify, PillowIsRemoved) {
  const HexMesh input = make_pillowed_grid(5);
  const SimplifyReport report = simplify_well(input);
  EXPECT_EQ(report.before.components, 33);
  EXPECT_EQ(report.after.components, 1);
  EXPECT_GE(report.collapses(), 1);
}

// Vertices thrown about, some of them along the surface.
TEST(Simplify, InvertedCellsOfTheInputAreUntangledFirst) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE(seed);
    HexMesh input = make_grid_with_random_sheets(1, seed);
    Random random(seed);
    for (const VertexHandle v : input.vertices()) {
      const Eigen::Vector3d p = input.point(v);
      if (random.below(15) > 0 || p.minCoeff() == 0 || p.head<2>().maxCoeff() == 5) continue;
      const double height = p[2];
      Eigen::Vector3d q = p + random.in_cube(1.5);
      if (height == 5) q[2] = height;
      input.set_point(v, q);
    }
    ASSERT_LT(min_scaled_jacobian(input), 0);
    const SimplifyReport report = simplify_well(input);
    EXPECT_GT(report.before.inverted, 0);
    EXPECT_LT(report.before.min_scaled_jacobian, 0);
    EXPECT_EQ(report.after.components, 1);
  }
}

TEST(Simplify, GridStaysOneComponent) {
  const HexMesh input = make_grid({4, 3, 2});
  HexMesh mesh = input;
  const SimplifyReport report = simplify(mesh);
  expect_good_output(input, mesh, report);
  EXPECT_EQ(report.after.components, 1);
  EXPECT_EQ(report.collapses(), 0);
  EXPECT_EQ(report.rate(), 0);
  EXPECT_EQ(mesh.n_cells(), 24);
}

TEST(Simplify, LShapeKeepsItsArms) {
  const HexMesh input = make_l_shape(2);
  const SimplifyReport report = simplify_well(input);
  EXPECT_EQ(report.after.components, 3);
}

TEST(Simplify, TorusKeepsItsHole) {
  const HexMesh input = make_torus({.n_around = 12});
  const SimplifyReport report = simplify_well(input);
  EXPECT_EQ(report.after.genus, 1);
  EXPECT_GE(report.after.components, 3);
}

TEST(Simplify, TwoPartsStayTwo) {
  HexMesh input = make_pillowed_grid(3);
  append(input, make_grid({2, 2, 2}), {5, 0, 0});
  const SimplifyReport report = simplify_well(input);
  EXPECT_EQ(report.after.parts, 2);
  EXPECT_EQ(report.before.components, 34);
  EXPECT_EQ(report.after.components, 2);
}

TEST(Simplify, StopRequestedBeforehandChangesNothing) {
  const HexMesh input = make_pillowed_grid(3);
  HexMesh mesh = input;
  std::stop_source source;
  source.request_stop();
  SimplifyOptions options;
  options.stop = source.get_token();
  const SimplifyReport report = simplify(mesh, options);
  expect_good_output(input, mesh, report);
  EXPECT_EQ(report.stopped, StopReason::interrupted);
  EXPECT_EQ(content(mesh), content(input));
}

HexMesh make_small_sphere() { return make_octree_like(Shape::sphere, 6); }

TEST(Simplify, StopFromTheObserverStopsAfterThatStep) {
  const HexMesh input = make_small_sphere();
  std::stop_source source;
  SimplifyOptions options;
  options.stop = source.get_token();
  int calls = 0;
  options.observer = [&](const SimplifyProgress& p) {
    calls += is_collapse(p.what);
    EXPECT_LE(p.components, p.input_components);
    EXPECT_LE(p.hausdorff_ratio, 0.01);
    EXPECT_GT(p.hexahedra, 0);
    if (calls == 2) source.request_stop();
  };
  const SimplifyReport report = simplify_well(input, options);
  EXPECT_EQ(report.stopped, StopReason::interrupted);
  EXPECT_EQ(calls, 2);
  EXPECT_EQ(report.collapses(), 2);
  EXPECT_LT(report.after.components, report.before.components);
}

TEST(Simplify, StopsAtTheTargetRate) {
  const HexMesh input = make_small_sphere();
  SimplifyOptions options;
  options.target_rate = 0.3;
  const SimplifyReport report = simplify_well(input, options);
  EXPECT_EQ(report.stopped, StopReason::target_reached);
  EXPECT_GE(report.rate(), 0.3);
}

TEST(Simplify, StopsAtTheTargetOfComponents) {
  const HexMesh input = make_small_sphere();
  HexMesh mesh = input;
  SimplifyOptions options;
  const int n = static_cast<int>(extract_base_complex(input).components.size());
  options.target_components = n - 1;
  const SimplifyReport report = simplify(mesh, options);
  expect_good_output(input, mesh, report);
  EXPECT_EQ(report.stopped, StopReason::target_reached);
  EXPECT_EQ(report.collapses(), 1);

  options.target_components = n;  // met by the input
  mesh = input;
  EXPECT_EQ(simplify(mesh, options).after.components, n);
}

TEST(Simplify, StopsWhenTheTimeIsOver) {
  const HexMesh input = make_small_sphere();
  SimplifyOptions options;
  options.max_seconds = 1e-9;
  const SimplifyReport report = simplify_well(input, options);
  EXPECT_EQ(report.stopped, StopReason::out_of_time);
  EXPECT_EQ(report.collapses(), 0);
}

TEST(Simplify, WithoutChordsOnlySheetsGo) {
  const HexMesh input = make_pillowed_grid(3);
  SimplifyOptions options;
  options.chords = false;
  const SimplifyReport report = simplify_well(input, options);
  EXPECT_EQ(report.chords.accepted, 0);
  for (int n : report.chords.refused) EXPECT_EQ(n, 0);
  EXPECT_EQ(report.after.components, 1);
}

// A cylinder with a sheet under its whole surface.
HexMesh make_padded_cylinder() {
  HexMesh mesh = make_padded_cube(4);
  Eigen::AlignedBox3d box;
  for (VertexHandle v : mesh.vertices()) box.extend(mesh.point(v));
  for (VertexHandle v : mesh.vertices()) {
    Eigen::Vector3d p = 2 * (mesh.point(v) - box.center()).cwiseQuotient(box.sizes());
    const double square = std::max(std::abs(p.x()), std::abs(p.y())),
                 round = std::hypot(p.x(), p.y());
    // Round outside, square in the middle.
    if (round > 0) p.head<2>() *= 1 - square * square * (1 - square / round);
    mesh.set_point(v, p);
  }
  EXPECT_GT(min_scaled_jacobian(mesh), 0.2);
  return mesh;
}

// Its mantle cannot do without the sheet: corners of the middle would be flat there. Its ends can.
TEST(Simplify, SheetsAreTakenOffTheFacesThatDoWithout) {
  const HexMesh input = make_padded_cylinder();
  SimplifyOptions without;
  without.peels = false;
  const SimplifyReport kept = simplify_well(input, without), peeled = simplify_well(input);
  EXPECT_EQ(kept.after.components, 7);
  EXPECT_EQ(kept.peels.tried(), 0);
  EXPECT_EQ(peeled.after.components, 5);
  EXPECT_EQ(peeled.peels.accepted, 2);
  EXPECT_GT(peeled.after.mean_scaled_jacobian, kept.after.mean_scaled_jacobian);
}

// As of a mesh that nothing can be removed from.
void expect_comes_back(const HexMesh& input, const SimplifyOptions& options = {}) {
  HexMesh mesh = input;
  const SimplifyReport report = simplify(mesh, options);
  ASSERT_EQ(report.collapses(), 0);
  EXPECT_TRUE(content(mesh) == content(input));
  EXPECT_EQ(report.refined, 0);
  EXPECT_EQ(report.coarsened, 0);
  EXPECT_EQ(report.stopped, StopReason::nothing_left);
  expect_good_output(input, mesh, report);
}

class SimplestMesh : public testing::TestWithParam<HexMesh (*)()> {};
INSTANTIATE_TEST_SUITE_P(Simplify, SimplestMesh,
                         testing::Values(
                             [] {
                               return make_grid({4, 3, 2});
                             },
                             [] { return make_l_shape(2); }, [] { return make_torus(); },
                             [] { return make_o_grid({.n_layers = 4}); }));

TEST_P(SimplestMesh, ComesBackAsItWas) { expect_comes_back(GetParam()()); }

// A section of five blocks can be one block if its surface may stray by a twentieth of its radius.
TEST(Simplify, RoundSectionBecomesASingleBlockWhereTheDistanceAllowsIt) {
  const HexMesh input = make_torus({.n_core = 3, .n_around = 24});
  SimplifyOptions near;
  near.hausdorff_limit_rel = 0.003;
  expect_comes_back(input, near);
  const SimplifyReport far = simplify_well(input);
  EXPECT_EQ(far.after.components, 3);
  EXPECT_GE(far.after.min_scaled_jacobian, far.before.min_scaled_jacobian);
  EXPECT_GE(far.after.mean_scaled_jacobian, far.before.mean_scaled_jacobian);
}

// A sphere whose inner sheets do without half of their layers, as its surface is flat enough.
HexMesh make_fine_sphere() { return split_in_eight(make_small_sphere()); }

SimplifyOptions far_options() {
  SimplifyOptions options;
  options.hausdorff_limit_rel = 0.05;
  return options;
}

TEST(Simplify, FineInputIsCoarsenedFirstAndHasItsHexahedraInTheEnd) {
  const HexMesh input = make_fine_sphere();
  SimplifyOptions options = far_options();
  std::vector<SimplifyProgress> steps;
  options.observer = [&](const SimplifyProgress& p) { steps.push_back(p); };
  const SimplifyReport report = simplify_well(input, options);
  EXPECT_GT(report.coarsened, 0);
  EXPECT_GT(report.collapses(), 0);
  EXPECT_GE(report.after.hexahedra, 0.7 * input.n_cells());
  EXPECT_LE(report.after.hexahedra, 1.15 * input.n_cells());
  ASSERT_GE(steps.size(), 2u);
  EXPECT_EQ(steps[1].what, StepKind::coarsening);
  EXPECT_EQ(steps[1].step, report.coarsened);
  EXPECT_EQ(steps[1].components, report.before.components);
  EXPECT_LT(steps[1].hexahedra, input.n_cells());
}

TEST(Simplify, NoLayerIsTakenOutUnasked) {
  SimplifyOptions options = far_options();
  options.coarsen = false;
  EXPECT_EQ(simplify_well(make_fine_sphere(), options).coarsened, 0);
}

TEST(Simplify, CutShortAFineInputHasItsHexahedraAllTheSame) {
  const HexMesh input = make_fine_sphere();
  SimplifyOptions options = far_options();
  std::stop_source source;
  options.stop = source.get_token();
  options.observer = [&](const SimplifyProgress& p) {
    if (is_collapse(p.what)) source.request_stop();
  };
  const SimplifyReport report = simplify_well(input, options);
  EXPECT_EQ(report.stopped, StopReason::interrupted);
  EXPECT_GT(report.coarsened, 0);
  EXPECT_GE(report.after.hexahedra, 0.85 * input.n_cells());
}

// What is over a limit near the rounding of the coordinates shows at full sampling only.
TEST(Simplify, ALimitNearRoundingEndsTheRun) {
  HexMesh input = make_grid({4, 4, 4});
  for (const int x : {1, 2}) pillow_columns(input, x, x + 1, 1, 3);
  input.collect_garbage();
  for (VertexHandle v : input.vertices()) {
    const Eigen::Vector3d p = input.point(v);
    input.set_point(v, Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()) * p);
  }
  SimplifyOptions options;
  options.hausdorff_limit_rel = 1e-14;
  HexMesh mesh = input;
  const SimplifyReport report = simplify(mesh, options);
  EXPECT_LE(report.hausdorff_ratio, 1e-14);
  EXPECT_TRUE(is_good(mesh));
}

TEST(Simplify, StopSoonAfterTheStartLeavesAValidMesh) {
  for (const int delay_ms : {1, 20, 60, 150}) {
    SCOPED_TRACE(delay_ms);
    SimplifyOptions options = far_options();
    const HexMesh input = make_fine_sphere();
    std::stop_source source;
    options.stop = source.get_token();
    const std::jthread later([&source, delay_ms] {
      std::this_thread::sleep_for(std::chrono::milliseconds(delay_ms));
      source.request_stop();
    });
    simplify_well(input, options);
  }
}

// A layer that goes is no reason to split a sheet.
TEST(Simplify, FineInputIsCoarsenedWhereTrialsMaySplitSheets) {
  SimplifyOptions options = far_options();
  options.splits_per_trial = 6;
  EXPECT_GT(simplify_well(make_fine_sphere(), options).coarsened, 0);
}

TEST(Simplify, ARunThatIsStoppedAtOnceTellsOfItsStart) {
  SimplifyOptions options;
  std::stop_source source;
  source.request_stop();
  options.stop = source.get_token();
  std::vector<StepKind> told;
  options.observer = [&](const SimplifyProgress& p) { told.push_back(p.what); };
  EXPECT_EQ(simplify_well(make_small_sphere(), options).stopped, StopReason::interrupted);
  EXPECT_THAT(told, testing::ElementsAre(StepKind::start));
}

TEST(Simplify, MoreHexahedraComeWhenAskedForEvenIfNothingGoes) {
  const HexMesh input = make_grid({4, 3, 2});
  HexMesh mesh = input;
  SimplifyOptions options;
  options.target_hexahedra_rel = 2;
  const SimplifyReport report = simplify(mesh, options);
  expect_good_output(input, mesh, report);
  EXPECT_GT(mesh.n_cells(), 40);
  EXPECT_GT(report.refined, 0);
  EXPECT_EQ(report.after.components, 1);
}

// Not the same few sheets over and over.
TEST(Simplify, ManyMoreHexahedraAreNoFlatOnes) {
  HexMesh mesh = make_grid({4, 3, 2});
  SimplifyOptions options;
  options.target_hexahedra_rel = 30;
  simplify(mesh, options);
  EXPECT_GT(mesh.n_cells(), 0.85 * 30 * 24);
  double shortest = 1, longest = 0;
  for (EdgeHandle e : mesh.edges()) {
    shortest = std::min(shortest, edge_length(mesh, e));
    longest = std::max(longest, edge_length(mesh, e));
  }
  EXPECT_LT(longest, 4 * shortest);
}

TEST(Simplify, StopDuringRefinementEndsIt) {
  const HexMesh input = make_grid({4, 3, 2});
  std::stop_source source;
  SimplifyOptions options;
  options.target_hexahedra_rel = 50;
  options.stop = source.get_token();
  options.observer = [&](const SimplifyProgress& p) {
    if (p.what == StepKind::refinement) source.request_stop();
    EXPECT_NE(p.what, StepKind::smoothing);
  };
  const SimplifyReport report = simplify_well(input, options);
  EXPECT_EQ(report.stopped, StopReason::interrupted);
  EXPECT_LE(report.refined, 1);
}

// The checkpoint at the end of the loop comes just before the smoothing.
TEST(Simplify, StopBeforeTheSmoothingLeavesItOut) {
  const HexMesh input = make_small_sphere();
  HexMesh mesh = input;
  std::stop_source source;
  SimplifyOptions options;
  options.stop = source.get_token();
  options.checkpoint_every_s = 1e9;
  MeshContent at_the_end_of_the_loop;
  options.checkpoint = [&](const HexMesh& now, const RunState&) {
    HexMesh compact = now;
    compact.collect_garbage();
    at_the_end_of_the_loop = content(compact);
    source.request_stop();
  };
  const SimplifyReport report = simplify(mesh, options);
  expect_good_output(input, mesh, report);
  EXPECT_EQ(report.stopped, StopReason::interrupted);
  EXPECT_EQ(report.profile[Stage::smoothing].entered, 0);
  EXPECT_TRUE(content(mesh) == at_the_end_of_the_loop);
}

TEST(Simplify, StopDuringTheSmoothingLeavesAValidMesh) {
  const HexMesh input = make_small_sphere();
  std::stop_source source;
  SimplifyOptions options;
  options.stop = source.get_token();
  options.checkpoint_every_s = 1e9;
  std::jthread later;
  options.checkpoint = [&](const HexMesh&, const RunState&) {
    later = std::jthread([&source] {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      source.request_stop();
    });
  };
  simplify_well(input, options);
}

std::ptrdiff_t count(const std::vector<SimplifyProgress>& steps, StepKind what) {
  return std::count_if(steps.begin(), steps.end(), [&](const auto& p) { return p.what == what; });
}

// As many of every kind as the report says.
void expect_steps_of(const SimplifyReport& report, const std::vector<SimplifyProgress>& steps) {
  EXPECT_EQ(count(steps, StepKind::sheet), report.sheets.accepted);
  EXPECT_EQ(count(steps, StepKind::chord), report.chords.accepted);
  EXPECT_EQ(count(steps, StepKind::peel), report.peels.accepted);
  EXPECT_EQ(count(steps, StepKind::pillow), report.pillows.accepted);
  EXPECT_EQ(count(steps, StepKind::refinement), report.refined);
}

TEST(Simplify, ObserverIsToldOfEveryKindOfStep) {
  const HexMesh input = make_small_sphere();
  HexMesh mesh = input;
  SimplifyOptions options;
  std::vector<SimplifyProgress> steps;
  options.observer = [&](const SimplifyProgress& p) { steps.push_back(p); };
  const SimplifyReport report = simplify(mesh, options);
  expect_steps_of(report, steps);
  ASSERT_GT(report.sheets.accepted, 0);
  EXPECT_EQ(steps.front().what, StepKind::start);
  EXPECT_EQ(steps.front().components, report.before.components);
  EXPECT_EQ(steps.front().min_scaled_jacobian, report.before.min_scaled_jacobian);
  EXPECT_EQ(steps.back().what, StepKind::smoothing);
  EXPECT_EQ(steps.back().components, report.after.components);
  EXPECT_EQ(steps.back().mean_scaled_jacobian, report.after.mean_scaled_jacobian);
  for (const SimplifyProgress& p : steps) {
    EXPECT_EQ(p.sheet_terms.has_value(), p.what == StepKind::sheet);
    EXPECT_EQ(p.chord_terms.has_value(), p.what == StepKind::chord);
    EXPECT_EQ(p.width > 0 && !p.kind.empty(), is_collapse(p.what));
  }
}

// Of a shape whose smoothed mesh leads to nothing better.
TEST(Simplify, ObserverIsToldOfGoingBack) {
  HexMesh mesh = make_octree_like(Shape::double_torus, 10);
  SimplifyOptions options;
  std::vector<SimplifyProgress> told;
  options.observer = [&](const SimplifyProgress& p) { told.push_back(p); };
  const SimplifyReport report = simplify(mesh, options);
  const std::vector<SimplifyProgress> steps = without_taken_back(told);
  EXPECT_GT(count(steps, StepKind::back), 0);
  EXPECT_LT(steps.size(), told.size());
  expect_steps_of(report, steps);
  EXPECT_EQ(steps.back().what, StepKind::smoothing);
  EXPECT_EQ(steps.back().components, report.after.components);
}

TEST(Simplify, ComparesCandidatesIfAsked) {
  const HexMesh input = make_small_sphere();
  SimplifyOptions options;
  options.compare = 3;
  const SimplifyReport one = simplify_well(input), compared = simplify_well(input, options);
  EXPECT_GT(compared.collapses(), 0);
  EXPECT_LT(compared.after.components, compared.before.components / 2);
  EXPECT_EQ(one.before.components, compared.before.components);
}

TEST(Simplify, WhatWasFoundToSucceedIsNotLeftForWhatFailsBesideIt) {
  const HexMesh input = make_small_sphere();
  SimplifyOptions options;
  options.peels = options.pillows = options.smooth = options.coarsen = false;
  SimplifyReport one;
  for (int most = 1; one.collapses() == 0; most *= 2) {
    options.max_failed_trials = most;
    one = simplify_well(input, options);
  }
  options.compare = 8;
  EXPECT_GE(simplify_well(input, options).collapses(), one.collapses());
}

// What is told of the smoothed meshes that it goes on from, and in the end.
TEST(Simplify, GoesOnFromTheSmoothedMeshToABetterOutcomeOnly) {
  struct Input {
    Shape shape;
    int resolution;
  };
  int gained = 0, taken_back = 0;
  for (const auto& [shape, resolution] :
       {Input{Shape::sphere, 8}, Input{Shape::blob, 8}, Input{Shape::double_torus, 10}}) {
    SCOPED_TRACE(name(shape));
    SimplifyOptions options;
    std::vector<SimplifyProgress> smoothed;
    int after_first = 0;
    options.observer = [&](const SimplifyProgress& p) {
      if (p.what == StepKind::smoothing) smoothed.push_back(p);
      after_first += p.what != StepKind::smoothing && !smoothed.empty();
    };
    const SimplifyReport report = simplify_well(make_octree_like(shape, resolution), options);
    if (smoothed.size() < 2) continue;
    const SimplifyProgress &first = smoothed.front(), &last = smoothed.back();
    EXPECT_EQ(last.components, report.after.components);
    if (last.components == first.components) {
      EXPECT_EQ(last.hexahedra, first.hexahedra);
      EXPECT_NEAR(last.min_scaled_jacobian, first.min_scaled_jacobian, 1e-12);
      EXPECT_EQ(last.step, first.step);
      taken_back += after_first > 0;
    } else {
      EXPECT_LE(last.components * first.min_scaled_jacobian,
                first.components * last.min_scaled_jacobian * (1 + 1e-12));
      ++gained;
    }
  }
  EXPECT_GT(gained + taken_back, 0);
}

TEST(Simplify, ProfileAddsUpToTheRun) {
  HexMesh mesh = make_small_sphere();
  const SimplifyReport report = simplify(mesh);
  EXPECT_NEAR(report.profile.seconds(), report.seconds, 0.01 * report.seconds);
  const Profile& p = report.profile;
  EXPECT_EQ(report.profile[Stage::trial].entered, report.sheets.tried() + report.chords.tried() +
                                                      report.peels.tried() +
                                                      report.pillows.tried());
  double trials = 0;
  for (const TrialCounts* c : {&report.sheets, &report.chords, &report.peels, &report.pillows}) {
    trials = std::accumulate(c->seconds.begin(), c->seconds.end(), trials);
  }
  const double own = p[Stage::trial].seconds + p[Stage::plan_check].seconds +
                     p[Stage::structure].seconds + p[Stage::parametrization].seconds;
  const double shared =
      p[Stage::distance].seconds + p[Stage::full_distance].seconds;  // with splits
  EXPECT_GT(trials, own - 0.01 * report.seconds);
  EXPECT_LT(trials, own + shared + 0.01 * report.seconds);
}

TEST(Simplify, ThinnestFirstIsAnotherOrder) {
  const HexMesh input = make_octree_like(Shape::blob, 8, 2);
  SimplifyOptions options;
  options.ranking = Ranking::thickness;
  HexMesh mesh = input, weighted = input;
  const SimplifyReport report = simplify(mesh, options);
  expect_good_output(input, mesh, report);
  EXPECT_LT(report.after.components, report.before.components);
  simplify(weighted);
  EXPECT_FALSE(content(mesh) == content(weighted));
}

TEST(Simplify, SameInputTwiceGivesTheSameBits) {
  std::array<MeshContent, 2> results;
  for (MeshContent& result : results) {
    HexMesh mesh = make_grid_with_random_sheets(3, 2);
    simplify(mesh);
    result = content(mesh);
  }
  EXPECT_TRUE(results[0] == results[1]);
}

TEST(Simplify, DeletedSlotsOfTheInputDoNotMatter) {
  HexMesh with_gaps = make_pillowed_grid(3);
  const CellHandle extra = with_gaps.add_cell([&] {
    CellVertices c;
    for (VertexHandle& v : c) v = with_gaps.add_vertex({0, 0, 0});
    return c;
  }());
  const CellVertices corners = with_gaps.vertices(extra);
  with_gaps.delete_cell(extra);
  for (VertexHandle v : corners) with_gaps.delete_vertex(v);
  HexMesh plain = make_pillowed_grid(3);
  simplify(with_gaps);
  simplify(plain);
  EXPECT_TRUE(content(with_gaps) == content(plain));
}

TEST(Simplify, MovedAndScaledInputGivesTheSameStructure) {
  const HexMesh input = make_grid_with_random_sheets(3, 2);
  HexMesh mesh = input, moved = input;
  for (VertexHandle v : moved.vertices()) {
    moved.set_point(v, 1e-3 * input.point(v) + Eigen::Vector3d(2, -1, 0.5));
  }
  const int components = simplify(mesh).after.components;
  EXPECT_EQ(simplify(moved).after.components, components);
}

}  // namespace
}  // namespace hexweft
