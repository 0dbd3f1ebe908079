// hexweft-simplify and hexweft-info as a stranger meets them.
#include <sstream>
#include <vector>

#include <nlohmann/json.hpp>

#include "io/hex_mesh_io.h"
#include "ovm/generators.h"
#include "ovm/quality.h"
#include "ovm/topology_check.h"
#include "tests/tools/run_tool.h"

namespace hexweft::test {
namespace {

using SimplifyTool = ToolTest;
using InfoTool = ToolTest;

TEST_F(InfoTool, TellsTheFiguresOfATorus) {
  const ToolRun result = run("hexweft-generate torus --square -o - | hexweft-info - --json -");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto j = nlohmann::json::parse(result.out);
  EXPECT_EQ(j["valid"], true);
  EXPECT_EQ(j["genus"], 1);
  EXPECT_EQ(j["parts"], 1);
  EXPECT_EQ(j["inverted"], 0);
  for (const char* key : {"vertices", "hexahedra", "components", "base_vertices", "base_edges",
                          "base_faces", "min_scaled_jacobian", "mean_scaled_jacobian"}) {
    EXPECT_TRUE(j[key].is_number()) << key;
  }
  // Three blocks round the ring, cut at three nodes of each closed singular edge.
  EXPECT_EQ(j["components"], 3);
  EXPECT_EQ(j["base_vertices"], 12);
}

TEST_F(InfoTool, SaysWhatIsWrongAndWhere) {
  // Two cells that share one edge only, and a point that is not used, before those of the edge.
  write_file(file("edge.vtk"),
             "# vtk DataFile Version 2.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 15 double\n"
             "9 9 9 0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1\n"
             "2 1 0 2 2 0 1 2 0 2 1 1 2 2 1 1 2 1\n"
             "CELLS 2 18\n8 1 2 3 4 5 6 7 8\n8 3 9 10 11 7 12 13 14\nCELL_TYPES 2\n12\n12\n");
  const ToolRun result = run("hexweft-info edge.vtk --json report.json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto j = nlohmann::json::parse(read_file(file("report.json")));
  EXPECT_EQ(j["valid"], false);
  EXPECT_TRUE(j["components"].is_null());
  EXPECT_TRUE(j["singular_edges"].is_null());
  EXPECT_TRUE(j["std_scaled_jacobian"].is_number());
  ASSERT_FALSE(j["problems"].empty());
  EXPECT_THAT(j["problems"][0].get<std::string>(),
              testing::HasSubstr(", at (1, 1, 0), has 4 boundary faces"));
}

TEST_F(InfoTool, ReportsHaveTheSameKeysWhateverTheMesh) {
  ASSERT_EQ(run("hexweft-generate grid --resolution 1 -o whole.vtk").exit_code, 0);
  HexMesh mesh = make_grid({2, 2, 1});
  mesh.delete_cell(CellHandle(0));
  mesh.delete_cell(CellHandle(3));
  write_hex_mesh(file("torn.vtk"), mesh);
  std::vector<std::string> whole, torn;
  for (auto& [name, keys] : {std::pair("whole.vtk", &whole), {"torn.vtk", &torn}}) {
    const auto j =
        nlohmann::ordered_json::parse(run(std::string("hexweft-info --json - ") + name).out);
    EXPECT_EQ(j["valid"], keys == &whole);
    for (const auto& item : j.items()) keys->push_back(item.key());
  }
  EXPECT_EQ(torn, whole);
}

TEST_F(SimplifyTool, WritesASimplerValidMeshAndAReport) {
  const ToolRun made = run("hexweft-generate octree-like --resolution 8 -o in.vtk");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const ToolRun result = run("hexweft-simplify in.vtk -o out.vtk --json report.json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(result.out, testing::HasSubstr("BC"));
  const auto j = nlohmann::json::parse(read_file(file("report.json")));
  const HexMesh mesh = read_hex_mesh(file("out.vtk"));
  EXPECT_TRUE(is_valid(mesh));
  EXPECT_GT(min_scaled_jacobian(mesh), 0);
  EXPECT_EQ(mesh.n_cells(), j["after"]["hexahedra"]);
  EXPECT_LT(j["after"]["components"], j["before"]["components"]);
  EXPECT_LE(j["hausdorff_ratio"], 0.01);
}

TEST_F(SimplifyTool, SameInputSameBytesWhateverTheThreads) {
  ASSERT_EQ(run("hexweft-generate octree-like --resolution 6 -o in.vtk").exit_code, 0);
  ASSERT_EQ(run("hexweft-simplify in.vtk -o one.vtk").exit_code, 0);
  ASSERT_EQ(run("hexweft-simplify in.vtk -o again.vtk").exit_code, 0);
  ASSERT_EQ(run("hexweft-simplify in.vtk -o two.vtk --threads 2").exit_code, 0);
  EXPECT_EQ(read_file(file("one.vtk")), read_file(file("again.vtk")));
  EXPECT_EQ(read_file(file("one.vtk")), read_file(file("two.vtk")));
}

// The filters are there to be moved.
TEST_F(SimplifyTool, AngleFilterAndBoldTrialsAreOptions) {
  ASSERT_EQ(run("hexweft-generate octree-like --resolution 7 -o in.vtk").exit_code, 0);
  const auto refused_by_angle = [&](const std::string& options) {
    const ToolRun result =
        run("hexweft-simplify in.vtk -o out.vtk --json report.json --no-bold-trials " + options);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const auto refused = nlohmann::json::parse(read_file(file("report.json")))["sheets"]["refused"];
    return refused.value("angle", 0);
  };
  EXPECT_GT(refused_by_angle("--max-boundary-angle 90"), 0);
  EXPECT_EQ(refused_by_angle("--max-boundary-angle 360"), 0);
  EXPECT_EQ(run("hexweft-simplify in.vtk -o out.vtk --max-boundary-angle 0").exit_code, 2);
}

TEST_F(SimplifyTool, TakesTheBestOfSeveralAttempts) {
  ASSERT_EQ(run("hexweft-generate octree-like --shape blob --resolution 8 -o in.vtk").exit_code, 0);
  const ToolRun r = run(
      "hexweft-simplify in.vtk -o out.vtk --attempts 3 --threads 2 --json r.json --log log.jsonl");
  ASSERT_EQ(r.exit_code, 0) << r.err;
  EXPECT_THAT(r.out, testing::HasSubstr("components by attempt: "));
  const auto j = nlohmann::json::parse(read_file(file("r.json")));
  ASSERT_EQ(j["attempts"].size(), 3u);
  for (const auto& a : j["attempts"]) EXPECT_LE(j["after"]["components"], a["components"]);
  EXPECT_EQ(j["after"]["components"], j["attempts"][j["attempt"].get<int>()]["components"]);
  EXPECT_EQ(run("hexweft-info out.vtk").exit_code, 0);
}

TEST_F(SimplifyTool, KeepsTheShareOfHexahedraThatIsAskedFor) {
  ASSERT_EQ(run("hexweft-generate octree-like --resolution 6 -o in.vtk").exit_code, 0);
  for (const double ratio : {1.0, 2.0}) {
    const ToolRun result =
        run("hexweft-simplify in.vtk -o out.vtk --json r.json --hexahedra-ratio " +
            std::to_string(ratio));
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const auto j = nlohmann::json::parse(read_file(file("r.json")));
    const double before = j["before"]["hexahedra"], after = j["after"]["hexahedra"];
    EXPECT_GE(after, 0.9 * ratio * before);
  }
}

// Line searches on this one make ceres log warnings.
TEST_F(SimplifyTool, IsQuietWhereNothingIsWrong) {
  const ToolRun r =
      run("hexweft-generate grid --sheets 6 --seed 21 -o in.vtk && "
          "hexweft-simplify in.vtk -o out.vtk");
  EXPECT_EQ(r.exit_code, 0);
  EXPECT_EQ(r.err, "");
}

TEST_F(SimplifyTool, InterruptedItWritesAValidMesh) {
  ASSERT_EQ(run("hexweft-generate octree-like --shape blob --resolution 24 -o in.vtk").exit_code,
            0);
  for (const char* signal : {"TERM", "HUP"}) {
    SCOPED_TRACE(signal);
    const ToolRun result = run_and_signal(
        "hexweft-simplify in.vtk -o out.vtk --json report.json --log run.log", signal);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(nlohmann::json::parse(read_file(file("report.json")))["stopped"], "interrupted");
    const HexMesh mesh = read_hex_mesh(file("out.vtk"));
    EXPECT_TRUE(is_valid(mesh));
    EXPECT_GT(min_scaled_jacobian(mesh), 0);
    EXPECT_EQ(n_files(), 5);
  }
}

TEST_F(SimplifyTool, AHangupThatIsIgnoredDoesNotEndIt) {  // as under nohup
  ASSERT_EQ(run("hexweft-generate octree-like --shape blob --resolution 20 -o in.vtk").exit_code,
            0);
  const ToolRun result = run_and_signal(
      "trap '' HUP; hexweft-simplify in.vtk -o out.vtk --json report.json --log run.log", "HUP");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(nlohmann::json::parse(read_file(file("report.json")))["stopped"], "nothing_left");
  EXPECT_LT(read_file(file("signal.log")).size(), read_file(file("run.log")).size());
}

std::vector<nlohmann::json> lines_of(const std::filesystem::path& log) {
  std::vector<nlohmann::json> lines;
  std::istringstream text(read_file(log));
  for (std::string line; std::getline(text, line);) lines.push_back(nlohmann::json::parse(line));
  return lines;
}

TEST_F(SimplifyTool, LogsEveryStepAndItsResultIsTheSame) {
  ASSERT_EQ(run("hexweft-generate octree-like --resolution 6 -o in.vtk").exit_code, 0);
  ASSERT_EQ(run("hexweft-simplify in.vtk -o plain.vtk").exit_code, 0);
  const ToolRun result = run(
      "hexweft-simplify in.vtk -o out.vtk --log run.log --profile --json report.json --checkpoint "
      "run.checkpoint --checkpoint-every 0");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(read_file(file("out.vtk")), read_file(file("plain.vtk")));
  const auto report = nlohmann::json::parse(read_file(file("report.json")));
  const auto lines = lines_of(file("run.log"));
  EXPECT_EQ(lines.front()["what"], "start");
  EXPECT_EQ(lines.front()["components"], report["before"]["components"]);
  EXPECT_EQ(lines.back()["what"], "end");
  EXPECT_EQ(lines.back()["stopped"], report["stopped"]);
  EXPECT_EQ(lines.back()["components"], report["after"]["components"]);
  int sheets = 0;
  for (const auto& line : lines) {
    for (const char* key : {"components", "hexahedra", "min_scaled_jacobian",
                            "mean_scaled_jacobian", "hausdorff_ratio", "seconds"}) {
      EXPECT_TRUE(line[key].is_number()) << line;
    }
    if (line["what"] != "sheet") continue;
    ++sheets;
    for (const char* key :
         {"step", "kind", "width", "energy", "valence_term", "width_term", "distortion_term"}) {
      EXPECT_TRUE(line.contains(key)) << line;
    }
  }
  EXPECT_EQ(sheets, report["sheets"]["accepted"]);
  EXPECT_TRUE(report["profile"]["trial"]["seconds"].is_number());
  EXPECT_THAT(result.err, testing::HasSubstr("smoothing"));
  EXPECT_EQ(n_files(), 6);
}

TEST_F(SimplifyTool, GoesOnFromACheckpoint) {
  ASSERT_EQ(run("hexweft-generate octree-like --resolution 8 -o in.vtk").exit_code, 0);
  ASSERT_EQ(
      run("hexweft-simplify in.vtk -o half.vtk --rate 0.3 --checkpoint c --log run.log").exit_code,
      0);
  const std::size_t n_lines = lines_of(file("run.log")).size();
  const ToolRun result =
      run("hexweft-simplify in.vtk -o out.vtk --resume c --log run.log "
          "--json report.json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto lines = lines_of(file("run.log"));
  ASSERT_GT(lines.size(), n_lines);
  EXPECT_EQ(lines[n_lines]["what"], "start");
  EXPECT_GT(lines[n_lines]["step"], 0);
  const auto report = nlohmann::json::parse(read_file(file("report.json")));
  const ToolRun distance = run("hexweft-distance out.vtk in.vtk --json -");
  EXPECT_LE(nlohmann::json::parse(distance.out)["ratio"], 0.01);
  EXPECT_GT(report["rate"], 0.3);
  EXPECT_TRUE(is_valid(read_hex_mesh(file("out.vtk"))));
  ASSERT_EQ(run("hexweft-simplify in.vtk -o again.vtk --resume c").exit_code, 0);
  EXPECT_EQ(read_file(file("out.vtk")), read_file(file("again.vtk")));
}

TEST_F(SimplifyTool, CheckpointThatDoesNotFitIsRefusedInASentence) {
  ASSERT_EQ(run("hexweft-generate octree-like --resolution 6 -o in.vtk").exit_code, 0);
  ASSERT_EQ(run("hexweft-generate grid -o grid.vtk").exit_code, 0);
  ASSERT_EQ(run("hexweft-simplify in.vtk -o out.vtk --checkpoint c").exit_code, 0);
  const auto refuses = [&](const std::string& arguments, int exit_code, const std::string& why) {
    SCOPED_TRACE(arguments);
    const ToolRun result = run("hexweft-simplify " + arguments + " -o new.vtk");
    EXPECT_EQ(result.exit_code, exit_code);
    EXPECT_THAT(result.err, IsSentenceOf("hexweft-simplify"));
    EXPECT_THAT(result.err, testing::HasSubstr(why));
  };
  refuses("in.vtk --hausdorff 2", 2, "--hausdorff = 2, expected (0, 1]");
  refuses("in.vtk --hexahedra-ratio 0", 2, "--hexahedra-ratio = 0, expected ");
  refuses("in.vtk --rate 2", 2, "--rate = 2, expected [0, 1]");
  refuses("in.vtk --features 200", 2, "--features = 200, expected auto, off or an angle");
  refuses("grid.vtk --resume c", 2, "another input");
  refuses("in.vtk --resume c --hausdorff 0.005", 2, "hausdorff_limit_rel = 0.01, not 0.005");
  refuses("in.vtk --resume c --beta 2", 2, "weights.beta");
  refuses("in.vtk --resume in.vtk", 3, "no checkpoint");
  refuses("in.vtk --resume none", 3, "none: cannot be read");
  refuses("in.vtk --resume -", 2, "expected a file");
  refuses("in.vtk --resume c --json c", 2, "expected another file than the outputs");
  refuses("in.vtk --checkpoint nowhere/c", 3, "nowhere");
  refuses("in.vtk --log nowhere/log", 3, "nowhere");
  const std::string whole = read_file(file("c"));
  for (const double share : {0.0, 0.001, 0.01, 0.5, 0.999}) {
    write_file(file("d"), whole.substr(0, static_cast<std::size_t>(share * whole.size())));
    refuses("in.vtk --resume d", 3, "d: is ");
    std::string flipped = whole;
    flipped[static_cast<std::size_t>(share * whole.size())] ^= 4;
    write_file(file("d"), flipped);
    refuses("in.vtk --resume d", 3, "d: is ");
  }
  EXPECT_FALSE(std::filesystem::exists(file("new.vtk")));
}

TEST_F(SimplifyTool, MeshAtItsSimplestComesBackAsItWas) {
  ASSERT_EQ(run("hexweft-generate torus -o in.vtk").exit_code, 0);
  ASSERT_EQ(run("hexweft-simplify in.vtk -o out.vtk").exit_code, 0);
  EXPECT_EQ(read_file(file("out.vtk")), read_file(file("in.vtk")));
}

TEST_F(SimplifyTool, RefusesWhatItCannotUse) {
  ASSERT_EQ(run("hexweft-generate grid -o grid.vtk").exit_code, 0);
  for (const std::string arguments :
       {"grid.vtk", "grid.vtk -o out.vtk --hausdorff 2", "grid.vtk -o out.vtk --rate -1",
        "grid.vtk -o out.vtk --preset cube", "grid.vtk -o out.vtk --ranking height",
        "grid.vtk -o out.vtk --features sharp", "grid.vtk -o out.vtk --beta -1",
        "grid.vtk -o out.vtk --log grid.vtk", "grid.vtk -o out.vtk --checkpoint ./out.vtk",
        "grid.vtk -o out.vtk --log a --checkpoint a", "grid.vtk -o out.vtk --threads 0",
        "grid.vtk -o out.vtk --attempts 0", "grid.vtk -o out.vtk --attempts 2 --checkpoint c"}) {
    SCOPED_TRACE(arguments);
    const ToolRun result = run("hexweft-simplify " + arguments);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, IsSentenceOf("hexweft-simplify"));
  }
  EXPECT_EQ(n_files(), 1);
}

}  // namespace
}  // namespace hexweft::test
