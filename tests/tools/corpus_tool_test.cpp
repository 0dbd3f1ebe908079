// hexweft-corpus as a stranger meets it.
#include <algorithm>
#include <filesystem>
#include <sstream>

#include <nlohmann/json.hpp>

#include "tests/tools/run_tool.h"

namespace hexweft::test {
namespace {

using Json = nlohmann::json;

class CorpusTool : public ToolTest {
 protected:
  void SetUp() override {
    ToolTest::SetUp();
    const ToolRun made =
        run("mkdir -p in/octree in/polycube && "
            "hexweft-generate octree-like --resolution 6 -o in/octree/ball.vtk && "
            "hexweft-generate grid --resolution 3 -o in/polycube/cube.mesh");
    ASSERT_EQ(made.exit_code, 0) << made.err;
  }
  std::vector<std::string> lines(const std::string& name) const {
    std::istringstream in(read_file(file(name)));
    std::vector<std::string> result;
    for (std::string line; std::getline(in, line);) result.push_back(line);
    return result;
  }
};

TEST_F(CorpusTool, MakesOneTableMeasuredFromTheFiles) {
  const ToolRun result = run("hexweft-corpus in -o out --json r.json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, testing::HasSubstr("octree/ball: H "));
  const Json rows = Json::parse(read_file(file("r.json")));
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0]["mesh"], "ball");
  const Json info = Json::parse(run("hexweft-info out/octree/ball.vtk --json -").out);
  EXPECT_EQ(rows[0]["H"], info["hexahedra"]);
  EXPECT_EQ(rows[0]["BC"], info["components"]);
  EXPECT_EQ(rows[0]["MSJ"], info["min_scaled_jacobian"]);
  EXPECT_EQ(rows[0]["MVDR"], info["max_volume_deviation"]);
  EXPECT_LE(rows[0]["HR_percent"], 1);
  EXPECT_GT(rows[0]["peak_MiB"], 0);
  const auto csv = lines("out/corpus.csv");
  ASSERT_EQ(csv.size(), 5u);  // the heading, and of each folder a mesh and its mean
  EXPECT_THAT(csv[0], testing::StartsWith("corpus,mesh,H_in,BC_in,"));
  EXPECT_THAT(csv[2], testing::StartsWith("octree,mean of 1,"));
  for (const std::string& line : csv) {
    EXPECT_EQ(std::count(line.begin(), line.end(), ','),
              std::count(csv[0].begin(), csv[0].end(), ','));
  }
  EXPECT_THAT(read_file(file("out/corpus.md")), testing::HasSubstr("## polycube\n\n| mesh |"));
}

TEST_F(CorpusTool, DoesNothingTwice) {
  ASSERT_EQ(run("hexweft-corpus in -o out --jobs 1").exit_code, 0);
  const std::string table = read_file(file("out/corpus.csv"));
  const auto time = std::filesystem::last_write_time(file("out/octree/ball.vtk"));
  const ToolRun second = run("hexweft-corpus in -o out");
  EXPECT_EQ(second.exit_code, 0);
  EXPECT_THAT(second.out, testing::Not(testing::HasSubstr("octree/ball")));
  EXPECT_EQ(read_file(file("out/corpus.csv")), table);
  EXPECT_EQ(std::filesystem::last_write_time(file("out/octree/ball.vtk")), time);
  // Other options are another run.
  const ToolRun other = run("hexweft-corpus in -o out -- --no-chords");
  EXPECT_EQ(other.exit_code, 0) << other.err;
  EXPECT_THAT(other.out, testing::HasSubstr("octree/ball"));
}

TEST_F(CorpusTool, AFailedMeshIsARowThatSaysWhy) {
  write_file(file("in/octree/broken.vtk"), "# vtk DataFile Version 3.0\nx\nASCII\nDATASET X\n");
  const ToolRun result = run("hexweft-corpus in -o out");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, IsSentenceOf("hexweft-corpus"));
  EXPECT_THAT(read_file(file("out/corpus.csv")),
              testing::HasSubstr("broken.vtk:4: expected UNSTRUCTURED_GRID"));
  EXPECT_THAT(read_file(file("out/corpus.md")), testing::HasSubstr("| failed: "));
  EXPECT_THAT(read_file(file("out/corpus.csv")), testing::HasSubstr("octree,mean of 1,"));
}

TEST_F(CorpusTool, WhatFailedIsTriedAgain) {
  // A folder in the way of an output, for a while.
  ASSERT_EQ(run("mkdir -p out/octree/ball.vtk/in-the-way").exit_code, 0);
  const ToolRun failed = run("hexweft-corpus in -o out");
  EXPECT_EQ(failed.exit_code, 1);
  EXPECT_THAT(failed.err, testing::HasSubstr("1 of 2 meshes failed, first octree/ball: failed: "));
  const ToolRun again = run("rm -r out/octree/ball.vtk && hexweft-corpus in -o out");
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_THAT(again.out, testing::HasSubstr("octree/ball: H "));
  EXPECT_THAT(again.out, testing::Not(testing::HasSubstr("polycube/cube")));
}

TEST_F(CorpusTool, AReportNeverTakesThePlaceOfAnotherFile) {
  write_file(file("in/published.csv"), "corpus,mesh,x\noctree,ball,1\n");
  const std::string mesh = read_file(file("in/octree/ball.vtk"));
  for (const std::string json :
       {"in/octree/ball.vtk", "in/octree/../octree/ball.vtk", "in/published.csv", "out/corpus.csv",
        "out/corpus.md", "out/octree/ball.vtk", "out/octree/ball.report.json",
        "out/octree/ball.row.json"}) {
    SCOPED_TRACE(json);
    const ToolRun result = run("mkdir -p out/octree && hexweft-corpus in -o out --json " + json);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, IsSentenceOf("hexweft-corpus"));
    EXPECT_THAT(result.err,
                testing::HasSubstr("--json = " + json + ", expected another file than"));
  }
  EXPECT_EQ(read_file(file("in/octree/ball.vtk")), mesh);
  EXPECT_FALSE(std::filesystem::exists(file("out/octree/ball.vtk")));
}

TEST_F(CorpusTool, APresetThatIsPassedOnGoesBeforeThatOfTheFolder) {
  for (const std::string preset : {"--preset polycube", "--preset=polycube"}) {
    SCOPED_TRACE(preset);
    const ToolRun result = run("hexweft-corpus in -o out -- " + preset);
    EXPECT_EQ(result.exit_code, 0) << result.err;
  }
}

TEST_F(CorpusTool, PublishedFiguresStandBesideOurs) {
  write_file(file("in/published.csv"),
             "corpus,mesh,H_in,method_BC,method_R,method_time_s\noctree,ball,7,123,0.25,4567\n");
  const ToolRun result = run("hexweft-corpus in -o out");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto csv = lines("out/corpus.csv");
  ASSERT_EQ(csv.size(), 3u);  // of the folders only the one that is published
  EXPECT_THAT(csv[0], testing::EndsWith(",status,method_BC,method_R,method_time_s"));
  EXPECT_THAT(csv[1], testing::EndsWith(",done,123,0.25,4567"));
  EXPECT_THAT(read_file(file("out/corpus.md")),
              testing::HasSubstr(" method BC | method R | method time s |"));
  EXPECT_EQ(run("hexweft-corpus in -o out --all").exit_code, 0);
  EXPECT_EQ(lines("out/corpus.csv").size(), 5u);
  write_file(file("in/published.csv"), "corpus,mesh,\"a, b\"\noctree,ball,\"say \"\"x\"\", y\"\n");
  EXPECT_EQ(run("hexweft-corpus in -o out").exit_code, 0);
  EXPECT_THAT(lines("out/corpus.csv")[1], testing::EndsWith("done,\"say \"\"x\"\", y\""));
  write_file(file("in/published.csv"), "corpus,mesh,x\nelsewhere,ball,1\n");
  const ToolRun none = run("hexweft-corpus in -o out");
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.err, testing::HasSubstr("--all"));
  write_file(file("in/published.csv"), "corpus,mesh,x\noctree,ball\n");
  const ToolRun bad = run("hexweft-corpus in -o out");
  EXPECT_EQ(bad.exit_code, 3);
  EXPECT_THAT(bad.err, testing::HasSubstr("published.csv:2: expected 3 cells, found 2"));
}

TEST_F(CorpusTool, GoesOnAfterAnInterruption) {
  ASSERT_EQ(run("hexweft-generate octree-like --shape blob --resolution 24 -o in/octree/big.vtk")
                .exit_code,
            0);
  const ToolRun stopped =
      run_and_signal("hexweft-corpus in -o out --jobs 1 -- --log run.log", "TERM");
  EXPECT_EQ(stopped.exit_code, 1);
  EXPECT_THAT(stopped.err, testing::HasSubstr("goes on from here"));
  EXPECT_FALSE(std::filesystem::exists(file("out/corpus.csv")));
  EXPECT_FALSE(std::filesystem::exists(file("out/octree/big.row.json")));
  const ToolRun rest = run("rm in/octree/big.vtk && hexweft-corpus in -o out -- --log run.log");
  EXPECT_EQ(rest.exit_code, 0) << rest.err;
  EXPECT_EQ(lines("out/corpus.csv").size(), 5u);
}

TEST_F(CorpusTool, RefusesWhatItCannotUse) {
  for (const auto& [arguments, code] : {std::pair("", 2),
                                        {"in --jobs 0", 2},
                                        {"missing", 3},
                                        {"in/octree/ball.vtk", 3},
                                        {"in --no-chords", 2},
                                        {"in -o in", 2},
                                        {"in -o in/octree/ball.vtk", 3},
                                        {"in -o in/octree/ball.vtk/out", 3}}) {
    SCOPED_TRACE(arguments);
    const ToolRun result = run(std::string("hexweft-corpus ") + arguments);
    EXPECT_EQ(result.exit_code, code);
    EXPECT_THAT(result.err, IsSentenceOf("hexweft-corpus"));
  }
  EXPECT_EQ(run("mkdir empty && hexweft-corpus empty").exit_code, 2);
}

}  // namespace
}  // namespace hexweft::test
