// The programs as a stranger meets them.
#include <nlohmann/json.hpp>

#include "io/hex_mesh_io.h"
#include "tests/tools/run_tool.h"

namespace hexweft::test {
namespace {

using CommandLine = ToolTest;

TEST_F(CommandLine, HelpAndVersionSucceed) {
  for (const std::string program : {"hexweft-convert", "hexweft-generate"}) {
    const ToolRun help = run(program + " --help");
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_THAT(help.out, testing::HasSubstr("--output"));
    EXPECT_EQ(help.err, "");
    const ToolRun version = run(program + " --version");
    EXPECT_EQ(version.exit_code, 0);
    EXPECT_THAT(version.out, testing::MatchesRegex(program + " [0-9]+\\.[0-9]+\\.[0-9]+\n"));
  }
}

TEST_F(CommandLine, WrongUsageIsExitCode2AndOneSentence) {
  for (const std::string arguments : {"",
                                      "grid",
                                      "grid -o",
                                      "cube -o x.vtk",
                                      "grid -o x.vtk --resolution 0",
                                      "grid -o x.vtk --resolution 3.5",
                                      "grid -o x.vtk --resolution many",
                                      "grid -o x.vtk --resolution nan",
                                      "grid -o x.vtk --resolution 99999999999999999999",
                                      "grid -o x.vtk --sheets -1",
                                      "grid -o x.vtk --seed -1",
                                      "grid -o x.vtk --precision 18",
                                      "grid -o x.vtk --no-such-option",
                                      "grid -o x.vtk extra",
                                      "grid -o x.stl",
                                      "grid -o x.mesh --binary",
                                      "grid -o x.vtk --format stl",
                                      "grid -o - --json -",
                                      "octree-like -o x.vtk --shape cow",
                                      "octree-like -o x.vtk --resolution 3",
                                      "octree-like -o x.vtk --holes -1",
                                      "octree-like -o x.vtk --cells-per-voxel 0",
                                      "torus -o x.vtk --layers 2",
                                      "grid -o x.vtk --layers 0",
                                      "grid -o x.vtk --precision 6 --binary",
                                      "grid -o x.vtk --shape torus",
                                      "grid -o x.vtk --square",
                                      "o-grid -o x.vtk --quarter-turns 1",
                                      "torus -o x.vtk --oblique",
                                      "l-shape -o x.vtk --layers 7",
                                      "l-shape -o x.vtk --cells-per-voxel 2",
                                      "octree-like -o x.vtk --layers 7",
                                      "octree-like -o x.vtk --holes 5",
                                      "octree-like -o x.vtk --shape torus --holes 5",
                                      "grid -o x.vtk --scale 0",
                                      "grid -o x.vtk --scale -1",
                                      "grid -o x.vtk --offset 1 2",
                                      "grid -o x.vtk --offset 1 2 inf",
                                      "grid -o x.vtk --copies 0"}) {
    SCOPED_TRACE(arguments);
    const ToolRun result = run("hexweft-generate " + arguments);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.out, "");
    EXPECT_THAT(result.err, IsSentenceOf("hexweft-generate"));
  }
  EXPECT_EQ(n_files(), 0);
}

TEST_F(CommandLine, ARangeIsSaidInShort) {
  for (const auto& [arguments, range] :
       {std::pair("--scale 1e-31", "[1e-30, 1e+30], found \"1e-31\""),
        {"--scale 0", "[1e-30, 1e+30], found \"0\""},
        {"--seed -1", "[0, 4294967295], found \"-1\""}}) {
    EXPECT_THAT(run(std::string("hexweft-generate grid -o x.vtk ") + arguments).err,
                testing::HasSubstr(std::string("expected a number in ") + range));
  }
}

TEST_F(CommandLine, FilesThatCannotBeUsedAreExitCode3) {
  write_file(file("broken.vtk"), "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\n");
  write_file(file("noise"), "not a mesh");
  EXPECT_EQ(run("hexweft-generate grid -o good.vtk").exit_code, 0);
  EXPECT_EQ(n_files(), 3);
  for (const std::string arguments :
       {"missing.vtk -o x.vtk", ". -o x.vtk", "broken.vtk -o x.vtk", "noise -o x.vtk", "- -o x.vtk",
        "good.vtk --input-format medit -o x.vtk", "good.vtk -o missing/x.vtk",
        "good.vtk -o /dev/full --format vtk", "good.vtk -o - >/dev/full"}) {
    SCOPED_TRACE(arguments);
    const ToolRun result = run("hexweft-convert " + arguments);
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_EQ(result.out, "");
    EXPECT_THAT(result.err, IsSentenceOf("hexweft-convert"));
  }
  EXPECT_EQ(n_files(), 3);
  EXPECT_EQ(run("hexweft-convert broken.vtk -o x.vtk").err,
            "hexweft-convert: broken.vtk:4: expected UNSTRUCTURED_GRID, found \"POLYDATA\"\n");
}

TEST_F(CommandLine, AFailureLeavesTheOutputAsItWas) {
  write_file(file("noise"), "not a mesh");
  write_file(file("out.vtk"), "precious");
  EXPECT_EQ(run("hexweft-convert noise -o out.vtk").exit_code, 3);
  EXPECT_EQ(read_file(file("out.vtk")), "precious");
  EXPECT_EQ(n_files(), 2);
}

TEST_F(CommandLine, AReportNeverTakesThePlaceOfAMesh) {
  EXPECT_EQ(run("hexweft-generate grid -o a.vtk && ln -s a.vtk link && mkdir d").exit_code, 0);
  const std::string before = read_file(file("a.vtk"));
  for (const std::string command :
       {"hexweft-info a.vtk --json a.vtk", "hexweft-info a.vtk --json ./link",
        "hexweft-info d/../a.vtk --json a.vtk", "hexweft-generate grid -o b.vtk --json ./b.vtk"}) {
    SCOPED_TRACE(command);
    const ToolRun result = run(command);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, testing::HasSubstr("expected another file than the mesh"));
  }
  EXPECT_EQ(read_file(file("a.vtk")), before);
  EXPECT_FALSE(std::filesystem::exists(file("b.vtk")));
  EXPECT_EQ(run("hexweft-info a.vtk --json /dev/null").exit_code, 0);
  EXPECT_EQ(run("hexweft-convert a.vtk -o a.vtk").exit_code, 0);
}

TEST_F(CommandLine, ConversionThereAndBackIsExact) {
  EXPECT_EQ(run("hexweft-generate octree-like --shape torus --resolution 10 -o a.vtk").exit_code,
            0);
  const ToolRun chain =
      run("hexweft-convert a.vtk -o b.mesh && hexweft-convert b.mesh -o c.vtk --binary && "
          "hexweft-convert - -o - <c.vtk | cmp - a.vtk");
  EXPECT_EQ(chain.exit_code, 0) << chain.err;
  EXPECT_EQ(chain.out, "");
}

TEST_F(CommandLine, DigitsThatWouldInvertHexahedraAreRefused) {
  ASSERT_EQ(run("hexweft-generate octree-like --resolution 8 -o a.vtk").exit_code, 0);
  const ToolRun few = run("hexweft-convert a.vtk -o b.vtk --precision 1");
  EXPECT_EQ(few.exit_code, 2);
  EXPECT_THAT(few.err, IsSentenceOf("hexweft-convert"));
  EXPECT_FALSE(std::filesystem::exists(file("b.vtk")));
  EXPECT_EQ(run("hexweft-convert a.vtk -o b.vtk --precision 6").exit_code, 0);
}

// Else what is said would get into the first file that is opened.
TEST_F(CommandLine, ClosedStreamsLeaveFilesAlone) {
  ASSERT_EQ(run("hexweft-generate grid --resolution 3 -o a.vtk").exit_code, 0);
  for (const std::string closed : {"<&- >&-", ">&- 2>&-", "<&- >&- 2>&-"}) {
    SCOPED_TRACE(closed);
    EXPECT_EQ(run("(hexweft-simplify a.vtk -o b.vtk --profile " + closed + ")").exit_code, 0);
    EXPECT_EQ(run("hexweft-info b.vtk").exit_code, 0);
  }
}

TEST_F(CommandLine, AMeshFarFromTheOriginIsNoCrash) {
  ASSERT_EQ(run("hexweft-generate octree-like --resolution 6 --offset 1e14 0 0 -o a.vtk").exit_code,
            0);
  for (const char* tool : {"hexweft-simplify", "hexweft-optimize"}) {
    const ToolRun result = run(std::string(tool) + " a.vtk -o b.vtk");
    EXPECT_THAT(result.exit_code, testing::AnyOf(0, 1, 2)) << result.err;
  }
}

// The loop takes for nothing what shows at full sampling: it must not go back for it for ever.
TEST_F(CommandLine, ALimitNearRoundingEndsTheRun) {
  ASSERT_EQ(run("hexweft-generate grid --sheets 3 --seed 2 -o a.vtk").exit_code, 0);
  EXPECT_EQ(run("hexweft-simplify a.vtk -o b.vtk --hausdorff 1e-14").exit_code, 0);
  EXPECT_EQ(run("hexweft-info b.vtk").exit_code, 0);
}

TEST_F(CommandLine, EveryKindIsMadeTheSameTwice) {
  for (const std::string kind :
       {"grid --layers 2", "o-grid", "torus", "torus --square --rotate", "l-shape",
        "octree-like --shape blob --resolution 8",
        "octree-like --shape bored-cylinder --resolution 10 --oblique --copies 2"}) {
    SCOPED_TRACE(kind);
    const std::string arguments = kind + " --sheets 2 --seed 7 ";
    const ToolRun first = run("hexweft-generate " + arguments + "-o a.vtk");
    EXPECT_EQ(first.exit_code, 0) << first.err;
    EXPECT_THAT(first.out, testing::HasSubstr("hexahedra"));
    EXPECT_EQ(run("hexweft-generate " + arguments + "-o b.vtk").exit_code, 0);
    EXPECT_EQ(read_file(file("a.vtk")), read_file(file("b.vtk")));
    EXPECT_GT(read_hex_mesh(file("a.vtk")).n_cells(), 0);
  }
}

TEST_F(CommandLine, AMeshIsScaledThenMoved) {
  EXPECT_EQ(run("hexweft-generate grid --resolution 1 --copies 3 --scale 2 --offset 10 -20 30 "
                "-o a.vtk")
                .exit_code,
            0);
  const HexMesh mesh = read_hex_mesh(file("a.vtk"));
  EXPECT_EQ(mesh.n_cells(), 3);
  EXPECT_EQ(mesh.point(VertexHandle(0)), Eigen::Vector3d(10, -20, 30));
  EXPECT_EQ(mesh.point(VertexHandle(7)), Eigen::Vector3d(12, -18, 32));
  EXPECT_EQ(mesh.point(VertexHandle(16)), Eigen::Vector3d(15, -20, 30));
}

TEST_F(CommandLine, AnOctreeLikePlateHasAsManyHolesAsAskedFor) {
  const ToolRun chain =
      run("hexweft-generate octree-like --shape plate-with-holes --holes 3 --resolution 24 -o - "
          "2>/dev/null | hexweft-info - --json -");
  EXPECT_EQ(nlohmann::json::parse(chain.out).at("genus"), 3);
}

TEST_F(CommandLine, AResultHasStandardOutputForItself) {
  const ToolRun mesh = run("hexweft-generate grid -o -");
  EXPECT_EQ(read_hex_mesh_text(mesh.out, "stdout").n_cells(), 64);
  EXPECT_THAT(mesh.err, testing::HasSubstr("64 hexahedra"));
  const ToolRun report = run("hexweft-generate grid --resolution 2 -o a.vtk --json -");
  EXPECT_EQ(nlohmann::json::parse(report.out).at("hexahedra"), 8);
  EXPECT_EQ(run("hexweft-generate grid --resolution 2 -o a.vtk --json r.json").exit_code, 0);
  EXPECT_EQ(read_file(file("r.json")), report.out);
}

TEST_F(CommandLine, AReaderThatLeavesEndsTheProgramQuietly) {
  const ToolRun result = run("hexweft-generate grid --resolution 40 -o - | head -n 1");
  EXPECT_EQ(result.out, "# vtk DataFile Version 3.0\n");
  EXPECT_THAT(result.err, testing::Not(testing::HasSubstr("cannot")));
}

}  // namespace
}  // namespace hexweft::test
