// Figures of meshes and runs.
#include "simplify/report.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/mesh_families.h"
#include "tests/simplify/test_meshes.h"

namespace hexweft {
namespace {

TEST(MeasureMesh, CountsAGrid) {
  const MeshFigures f = measure_mesh(make_grid({4, 3, 2}));
  EXPECT_EQ(f.vertices, 60);
  EXPECT_EQ(f.hexahedra, 24);
  EXPECT_EQ(f.base_vertices, 8);
  EXPECT_EQ(f.base_edges, 12);
  EXPECT_EQ(f.base_faces, 6);
  EXPECT_EQ(f.components, 1);
  EXPECT_NEAR(f.min_scaled_jacobian, 1, 1e-12);
  EXPECT_NEAR(f.mean_scaled_jacobian, 1, 1e-12);
  EXPECT_NEAR(f.std_scaled_jacobian, 0, 1e-6);
  EXPECT_NEAR(f.max_volume_deviation, 0, 1e-12);
  EXPECT_EQ(f.inverted, 0);
  EXPECT_EQ(f.genus, 0);
  EXPECT_EQ(f.parts, 1);
}

TEST(MeasureMesh, CountsHolesAndParts) {
  EXPECT_EQ(measure_mesh(make_torus()).genus, 1);
  EXPECT_EQ(measure_mesh(make_octree_like(Shape::double_torus, 16)).genus, 2);
  EXPECT_EQ(measure_mesh(make_two_boxes()).parts, 2);
}

TEST(Report, RateAndJson) {
  SimplifyReport r;
  EXPECT_EQ(r.rate(), 0);
  r.before.components = 200;
  r.after.components = 50;
  r.sheets.accepted = 7;
  r.sheets.refused[static_cast<int>(Refusal::hausdorff)] = 3;
  r.stopped = StopReason::target_reached;
  EXPECT_NEAR(r.rate(), 0.75, 1e-15);
  const nlohmann::json j = r.json();
  EXPECT_EQ(j["before"]["components"], 200);
  EXPECT_EQ(j["after"]["components"], 50);
  EXPECT_EQ(j["stopped"], "target_reached");
  EXPECT_EQ(j["sheets"]["accepted"], 7);
  EXPECT_EQ(j["sheets"]["refused"]["hausdorff"], 3);
  EXPECT_THAT(r.brief(), testing::AllOf(testing::HasSubstr("200"), testing::HasSubstr("0.7500"),
                                        testing::HasSubstr("asked for is reached")));
}

TEST(Report, CountsOfTrialsReadBack) {
  TrialCounts c;
  c.accepted = 3;
  c.waited = 9;
  c.refused[static_cast<int>(Refusal::valence)] = 5;
  c.seconds[0] = 0.25;
  c.seconds[static_cast<int>(Refusal::valence)] = 0.5;
  const TrialCounts read = trial_counts(to_json(c));
  EXPECT_EQ(read.accepted, 3);
  EXPECT_EQ(read.waited, 9);
  EXPECT_EQ(read.refused, c.refused);
  EXPECT_EQ(read.seconds, c.seconds);
  EXPECT_EQ(read.tried(), 8);
  EXPECT_EQ(to_json(TrialCounts())["tried"], 0);
}

TEST(Report, ProfileTableNamesStagesAndFates) {
  SimplifyReport r;
  r.profile[Stage::ranking] = {1, 4};
  r.profile[Stage::trial] = {3, 2};
  r.sheets.accepted = 1;
  r.chords.refused[static_cast<int>(Refusal::hausdorff)] = 1;
  const std::string table = r.profile_table();
  EXPECT_LT(table.find("trial"), table.find("ranking"));  // most time first
  EXPECT_THAT(table, testing::AllOf(testing::HasSubstr("75.0 %"), testing::HasSubstr("hausdorff"),
                                    testing::Not(testing::HasSubstr("smoothing"))));
  EXPECT_EQ(r.json()["profile"]["trial"]["share"], 0.75);
}

}  // namespace
}  // namespace hexweft
