// hexweft-distance as a stranger meets it.
#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "tests/tools/run_tool.h"

namespace hexweft::test {
namespace {

using DistanceTool = ToolTest;

// The square z = height over [0, 4]².
std::string square(const std::string& height) {
  std::string text = "OFF\n4 1 0\n";
  for (const char* corner : {"0 0 ", "4 0 ", "4 4 ", "0 4 "}) text += corner + height + "\n";
  return text + "4 0 1 2 3\n";
}

TEST_F(DistanceTool, MeasuresBothWaysAndSaysWhere) {
  ASSERT_EQ(run("hexweft-generate grid --resolution 4 -o grid.vtk").exit_code, 0);
  write_file(file("square.off"), square("4.5"));
  const ToolRun result = run("hexweft-distance square.off grid.vtk --json -");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto j = nlohmann::json::parse(result.out);
  EXPECT_NEAR(j["forward"]["distance"], 0.5, 1e-12);
  EXPECT_NEAR(j["forward"]["at"][2], 4.5, 1e-12);
  EXPECT_NEAR(j["forward"]["closest"][2], 4, 1e-12);
  EXPECT_NEAR(j["backward"]["distance"], 4.5, 1e-12);
  EXPECT_NEAR(j["backward"]["at"][2], 0, 1e-12);
  EXPECT_NEAR(j["distance"], 4.5, 1e-12);
  EXPECT_NEAR(j["diagonal"], 4 * std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(j["ratio"], 4.5 / (4 * std::sqrt(3.0)), 1e-12);
  const ToolRun text = run("hexweft-distance square.off grid.vtk");
  EXPECT_THAT(text.out, testing::HasSubstr("from A to B            0.5     7.2169 %"));
}

TEST_F(DistanceTool, IsZeroBetweenAMeshAndItselfWhateverTheThreads) {
  ASSERT_EQ(run("hexweft-generate octree-like --resolution 8 -o s.vtk").exit_code, 0);
  const ToolRun one = run("hexweft-distance - s.vtk --json - <s.vtk");
  EXPECT_LT(nlohmann::json::parse(one.out)["ratio"], 1e-12);
  EXPECT_EQ(run("hexweft-distance s.vtk s.vtk --json - --threads 2").out, one.out);
}

TEST_F(DistanceTool, TheFarthestPlaceIsAsFarAsTheDistanceSays) {
  ASSERT_EQ(run("hexweft-generate octree-like --resolution 8 -o a.vtk").exit_code, 0);
  ASSERT_EQ(run("hexweft-generate octree-like --resolution 14 -o b.vtk").exit_code, 0);
  for (const char* samples : {"", " --points-per-triangle 1"}) {  // few are made up for
    const ToolRun result = run(std::string("hexweft-distance a.vtk b.vtk --json -") + samples);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const auto j = nlohmann::json::parse(result.out);
    double farther = 0;
    for (const char* way : {"forward", "backward"}) {
      double squared = 0;
      for (int i : {0, 1, 2}) {
        const double d = j[way]["at"][i].get<double>() - j[way]["closest"][i].get<double>();
        squared += d * d;
      }
      EXPECT_GT(j[way]["distance"], 0) << way;
      EXPECT_NEAR(std::sqrt(squared), j[way]["distance"], 1e-12) << way;
      farther = std::max(farther, j[way]["distance"].get<double>());
    }
    EXPECT_EQ(j["distance"], farther);
  }
}

TEST_F(DistanceTool, RefusesWhatItCannotUse) {
  ASSERT_EQ(run("hexweft-generate grid -o grid.vtk").exit_code, 0);
  write_file(file("bad.obj"), "hello\n");
  for (const auto& [arguments, code] : {std::pair("grid.vtk", 2),
                                        {"- -", 2},
                                        {"grid.vtk grid.vtk --points-per-triangle 0", 2},
                                        {"grid.vtk grid.vtk --json grid.vtk", 2},
                                        {"grid.vtk missing.stl", 3},
                                        {"grid.vtk bad.obj", 3}}) {
    SCOPED_TRACE(arguments);
    const ToolRun result = run(std::string("hexweft-distance ") + arguments);
    EXPECT_EQ(result.exit_code, code);
    EXPECT_EQ(result.out, "");
    EXPECT_THAT(result.err, IsSentenceOf("hexweft-distance"));
  }
}

}  // namespace
}  // namespace hexweft::test
