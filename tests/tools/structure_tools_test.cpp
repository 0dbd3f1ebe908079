// hexweft-rank, -structure, -collapse and -refine as a stranger meets them.
#include <algorithm>
#include <filesystem>
#include <set>

#include <nlohmann/json.hpp>

#include "io/hex_mesh_io.h"
#include "ovm/dual.h"
#include "ovm/property.h"
#include "ovm/quality.h"
#include "ovm/topology_check.h"
#include "tests/simplify/test_meshes.h"
#include "tests/tools/run_tool.h"

namespace hexweft::test {
namespace {

using Json = nlohmann::json;

class StructureTools : public ToolTest {
 protected:
  void make(const std::string& arguments) const {
    const ToolRun made = run("hexweft-generate " + arguments + " -o in.vtk");
    ASSERT_EQ(made.exit_code, 0) << made.err;
  }
  Json info(const std::string& mesh) const {
    return Json::parse(run("hexweft-info " + mesh + " --json -").out);
  }
};
using RankTool = StructureTools;
using StructureTool = StructureTools;
using CollapseTool = StructureTools;
using RefineTool = StructureTools;

TEST_F(RankTool, ListsCandidatesWithTheirTerms) {
  make("octree-like --resolution 6");
  const ToolRun text = run("hexweft-rank in.vtk --list 3");
  ASSERT_EQ(text.exit_code, 0) << text.err;
  EXPECT_THAT(text.out, testing::HasSubstr("sheets, "));
  EXPECT_THAT(text.out, testing::HasSubstr("thickness"));
  const ToolRun result = run("hexweft-rank in.vtk --json -");
  const Json j = Json::parse(result.out);
  EXPECT_EQ(j["ranking"], "weighted");
  ASSERT_FALSE(j["sheets"].empty());
  ASSERT_FALSE(j["chords"].empty());
  ASSERT_TRUE(j["peels"].is_array());
  for (const char* key : {"energy", "valence_term", "width_term", "distortion_term", "thickness"}) {
    EXPECT_TRUE(j["sheets"][0][key].is_number()) << key;
  }
  std::set<std::string> refusals;
  for (const Json& c : j["chords"]) refusals.insert(c["refusal"].get<std::string>());
  EXPECT_GT(refusals.size(), 1u);
}

TEST_F(RankTool, WeightsAndOrderAreOptions) {
  make("grid --resolution 2");
  const auto first_sheet = [&](const std::string& options) {
    return Json::parse(run("hexweft-rank in.vtk --json - " + options).out)["sheets"][0];
  };
  const double octree = first_sheet("")["energy"],
               polycube = first_sheet("--preset polycube")["energy"];
  EXPECT_NE(octree, polycube);
  EXPECT_EQ(first_sheet("--k-valence 0.3 --k-width 0.7")["energy"], polycube);
  EXPECT_EQ(first_sheet("--preset polycube --k-valence 0.4 --k-width 0.6")["energy"], octree);
  EXPECT_EQ(first_sheet("--k-valence 0 --k-width 0 --k-distortion 0")["energy"], 0);
  EXPECT_NE(first_sheet("--min-width 2")["thickness"], first_sheet("")["thickness"]);
  EXPECT_EQ(Json::parse(run("hexweft-rank in.vtk --json - --ranking thickness").out)["ranking"],
            "thickness");
}

TEST_F(RankTool, RefusesWhatItCannotUse) {
  make("grid");
  for (const std::string arguments :
       {"", "in.vtk --ranking width", "in.vtk --k-width -1", "in.vtk --k-width nan",
        "in.vtk --preset cube", "in.vtk --max-chord-deviation 0"}) {
    SCOPED_TRACE(arguments);
    const ToolRun result = run("hexweft-rank " + arguments);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, IsSentenceOf("hexweft-rank"));
  }
}

TEST_F(StructureTool, WritesComponentsSheetsAndChordsAsCellData) {
  make("torus --square");
  const ToolRun result =
      run("hexweft-structure in.vtk -o out.vtk --json r.json --singular-edges s.vtk --base-edges "
          "b.vtk");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json j = Json::parse(read_file(file("r.json")));
  EXPECT_EQ(j["components"], info("in.vtk")["components"]);
  const HexMesh mesh = read_hex_mesh(file("out.vtk"));
  const auto component = named_property<CellTag, int>(mesh, "component", -1);
  const auto color = named_property<CellTag, int>(mesh, "color", -1);
  const auto sheets = named_property<CellTag, Eigen::VectorXi>(mesh, "sheets");
  const auto chords = named_property<CellTag, Eigen::VectorXi>(mesh, "chords");
  std::set<int> components;
  for (const CellHandle c : mesh.cells()) {
    components.insert(component[c]);
    ASSERT_EQ(sheets[c].size(), 3);
    ASSERT_EQ(chords[c].size(), 3);
    EXPECT_GE(sheets[c].minCoeff(), 0);
    EXPECT_LT(sheets[c].maxCoeff(), static_cast<int>(j["sheets"].size()));
    EXPECT_GE(chords[c].minCoeff(), 0);
    EXPECT_LT(chords[c].maxCoeff(), static_cast<int>(j["chords"].size()));
    for (const HalfFaceHandle hf : mesh.halffaces(c)) {
      const CellHandle n = mesh.cell(mesh.opposite(hf));
      if (n.valid() && component[n] != component[c]) {
        EXPECT_NE(color[n], color[c]);
      }
    }
  }
  EXPECT_EQ(components.size(), j["components"]);
  const std::string lines = read_file(file("s.vtk"));
  EXPECT_THAT(lines, testing::HasSubstr("DATASET POLYDATA"));
  EXPECT_THAT(lines, testing::HasSubstr("LINES 4 "));  // the four edges of the ring
  EXPECT_THAT(lines, testing::HasSubstr("SCALARS valence int 1"));
  EXPECT_THAT(read_file(file("b.vtk")), testing::HasSubstr("SCALARS sheet int 1"));
}

TEST_F(StructureTool, WritesNothingInThePlaceOfAnotherFile) {
  make("grid");
  const std::string input = read_file(file("in.vtk"));
  for (const std::string arguments :
       {"-o out.vtk --singular-edges in.vtk", "-o out.vtk --base-edges out.vtk",
        "-o - --singular-edges -", "-o out.vtk --singular-edges - --base-edges -",
        "-o out.vtk --base-edges - --json -",
        "-o out.vtk --singular-edges s.vtk --base-edges s.vtk", "-o out.vtk --json in.vtk"}) {
    SCOPED_TRACE(arguments);
    const ToolRun result = run("hexweft-structure in.vtk " + arguments);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, IsSentenceOf("hexweft-structure"));
    EXPECT_EQ(read_file(file("in.vtk")), input);
    EXPECT_FALSE(std::filesystem::exists(file("out.vtk")));
  }
}

TEST_F(StructureTool, CanBeRunOnItsOwnOutputAndSaysWhatItReplaces) {
  make("o-grid");
  const ToolRun first = run("hexweft-structure in.vtk -o a.vtk");
  ASSERT_EQ(first.exit_code, 0);
  EXPECT_EQ(first.err, "");
  const ToolRun second = run("hexweft-structure - -o b.vtk <a.vtk");
  ASSERT_EQ(second.exit_code, 0);
  EXPECT_EQ(read_file(file("a.vtk")), read_file(file("b.vtk")));
  for (const std::string name : {"component", "color", "sheets", "chords"}) {
    EXPECT_THAT(second.err, testing::HasSubstr("hexweft-structure: note: the cell data " + name +
                                               " of the input is replaced\n"));
  }
}

TEST_F(StructureTool, LinesHaveStandardOutputForThemselves) {
  make("torus --square");
  for (const std::string option : {"--singular-edges", "--base-edges"}) {
    SCOPED_TRACE(option);
    const ToolRun to_file = run("hexweft-structure in.vtk -o a.vtk " + option + " lines.vtk");
    const ToolRun to_stdout = run("hexweft-structure in.vtk -o a.vtk " + option + " -");
    ASSERT_EQ(to_stdout.exit_code, 0);
    EXPECT_EQ(to_stdout.out, read_file(file("lines.vtk")));
    EXPECT_EQ(to_stdout.err, to_file.out);
  }
}

TEST_F(CollapseTool, CollapsesASheetThatRankLists) {
  make("grid --resolution 6 --sheets 2 --seed 3");
  const Json ranked = Json::parse(run("hexweft-rank in.vtk --json -").out);
  const auto closed = std::find_if(ranked["sheets"].begin(), ranked["sheets"].end(),
                                   [](const Json& s) { return s["refusal"] == "none"; });
  ASSERT_NE(closed, ranked["sheets"].end());
  const std::string id = (*closed)["id"].dump();
  const ToolRun result = run("hexweft-collapse in.vtk -o out.vtk --json - --sheet " + id);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json j = Json::parse(result.out);
  const HexMesh mesh = read_hex_mesh(file("out.vtk"));
  EXPECT_TRUE(is_valid(mesh));
  EXPECT_GT(min_scaled_jacobian(mesh), 0);
  EXPECT_EQ(mesh.n_cells(), j["after"]["hexahedra"]);
  EXPECT_EQ(j["before"]["hexahedra"].get<int>() - mesh.n_cells(), (*closed)["cells"]);
  EXPECT_LT(j["after"]["components"], j["before"]["components"]);
  EXPECT_LE(j["after"]["hausdorff_ratio"], 0.01);
}

TEST_F(CollapseTool, TakesASheetOffAFaceThatRankLists) {
  make("octree-like --shape block-with-hole --resolution 12");
  const Json ranked = Json::parse(run("hexweft-rank in.vtk --json -").out);
  const auto& peels = ranked["peels"];
  const auto passes = std::find_if(peels.begin(), peels.end(),
                                   [](const Json& p) { return p["refusal"] == "none"; });
  ASSERT_NE(passes, peels.end());
  const std::string id = (*passes)["id"].dump();
  const ToolRun result = run("hexweft-collapse in.vtk -o out.vtk --json - --peel " + id);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json j = Json::parse(result.out);
  EXPECT_EQ(j["before"]["hexahedra"].get<int>() - j["after"]["hexahedra"].get<int>(),
            (*passes)["cells"]);
  EXPECT_LT(j["after"]["components"], j["before"]["components"]);
}

TEST_F(CollapseTool, TakesASheetOutWithThePillowThatRankLists) {
  write_hex_mesh(file("in.vtk"), make_blocked_sheet());
  const Json ranked = Json::parse(run("hexweft-rank in.vtk --json -").out);
  ASSERT_FALSE(ranked["pillows"].empty());
  const Json& best = ranked["pillows"][0];
  EXPECT_EQ(run("hexweft-collapse in.vtk -o out.vtk --sheet " + best["sheet"].dump()).exit_code, 1);
  const ToolRun result =
      run("hexweft-collapse in.vtk -o out.vtk --json - --pillow " + best["id"].dump());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json j = Json::parse(result.out);
  EXPECT_GE(j["before"]["components"].get<int>() - j["after"]["components"].get<int>(),
            best["gain"].get<int>());
  EXPECT_EQ(run("hexweft-collapse in.vtk -o out.vtk --pillow 1000").exit_code, 2);
}

// Without its padding a cube has edges of single hexahedra, which fill 90 degrees there.
TEST_F(CollapseTool, TakesTheFiltersOfRank) {
  write_hex_mesh(file("in.vtk"), make_padded_cube(3));
  const auto sheet_with = [&](const std::string& refusal, const std::string& options) {
    const Json ranked = Json::parse(run("hexweft-rank in.vtk --json - " + options).out);
    for (const Json& s : ranked["sheets"]) {
      if (s["refusal"] == refusal) return s["id"].get<int>();
    }
    return -1;
  };
  const std::string narrow = " --max-boundary-angle 80";
  const int padding = sheet_with("angle", narrow);
  ASSERT_GE(padding, 0);
  EXPECT_EQ(sheet_with("angle", ""), -1);
  const std::string collapse =
      "hexweft-collapse in.vtk -o out.vtk --sheet " + std::to_string(padding);
  const ToolRun refused = run(collapse + narrow);
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.err, testing::HasSubstr("wide angle"));
  ASSERT_EQ(run(collapse).exit_code, 0);
  EXPECT_EQ(info("out.vtk")["components"], 1);
}

TEST_F(CollapseTool, SaysWhyNotAndWritesNothing) {
  make("grid --resolution 1");
  const ToolRun result = run("hexweft-collapse in.vtk -o out.vtk --sheet 0");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, testing::HasSubstr("sheet 0 cannot be collapsed: "));
  EXPECT_THAT(result.err, IsSentenceOf("hexweft-collapse"));
  EXPECT_EQ(n_files(), 1);
  for (const std::string arguments :
       {"in.vtk -o out.vtk", "in.vtk -o out.vtk --sheet 0 --chord 0",
        "in.vtk -o out.vtk --sheet 0 --peel 0", "in.vtk -o out.vtk --peel 0",
        "in.vtk -o out.vtk --sheet 3", "in.vtk -o out.vtk --chord -1",
        "in.vtk -o out.vtk --chord 0 --diagonal third",
        "in.vtk -o out.vtk --sheet 0 --diagonal first"}) {
    SCOPED_TRACE(arguments);
    const ToolRun wrong = run("hexweft-collapse " + arguments);
    EXPECT_EQ(wrong.exit_code, 2);
    EXPECT_THAT(wrong.err, IsSentenceOf("hexweft-collapse"));
  }
}

TEST_F(RefineTool, SplitsEveryHexahedronOfASheet) {
  make("o-grid");
  const Json before = info("in.vtk");
  const Json sheet =
      Json::parse(run("hexweft-rank in.vtk --json - --list 0").out)["sheets"].front();
  const ToolRun result =
      run("hexweft-refine in.vtk -o out.vtk --json - --sheet " + sheet["id"].dump());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(Json::parse(result.out)["split"], sheet["width"]);
  const Json after = info("out.vtk");
  EXPECT_EQ(after["valid"], true);
  EXPECT_EQ(after["components"], before["components"]);
  EXPECT_EQ(after["hexahedra"], before["hexahedra"].get<int>() + sheet["cells"].get<int>());
}

TEST_F(RefineTool, SplitsUpToACount) {
  make("octree-like --resolution 6");
  const Json before = info("in.vtk");
  const int wanted = before["hexahedra"].get<int>() * 3 / 2;
  const ToolRun result =
      run("hexweft-refine in.vtk -o out.vtk --hexahedra " + std::to_string(wanted));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json after = info("out.vtk");
  EXPECT_EQ(after["valid"], true);
  EXPECT_EQ(after["inverted"], 0);
  EXPECT_EQ(after["components"], before["components"]);
  EXPECT_GE(after["hexahedra"], wanted);
  EXPECT_LE(after["hexahedra"], wanted * 3 / 2);
}

TEST_F(RefineTool, SaysThatThereAreMoreThanItIsAskedFor) {
  make("grid --resolution 3");
  const ToolRun result = run("hexweft-refine in.vtk -o out.vtk --hexahedra 26");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "hexweft-refine: note: nothing is split: there are 27 hexahedra already\n");
  EXPECT_EQ(run("hexweft-refine in.vtk -o out.vtk --hexahedra 27").err, "");
}

// A layer that is far from the surface stays so, but is not split for it over and over.
TEST_F(RefineTool, MakesNoThinLayersWhereTheSurfaceIsFar) {
  make("octree-like --shape blob --resolution 8");
  ASSERT_EQ(run("hexweft-simplify in.vtk -o far.vtk --hausdorff 0.03").exit_code, 0);
  const ToolRun result =
      run("hexweft-refine far.vtk -o out.vtk --surface in.vtk --hausdorff 0.04 --hexahedra 20000");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const HexMesh mesh = read_hex_mesh(file("out.vtk"));
  const double mean = mean_edge_length(mesh);
  double thinnest = mean;
  for (const DualSheet& layer : list_dual_sheets(mesh)) {
    double length = 0;
    for (EdgeHandle e : layer.edges) length += edge_length(mesh, e);
    thinnest = std::min(thinnest, length / static_cast<double>(layer.edges.size()));
  }
  EXPECT_GT(thinnest, mean / 5);
}

TEST_F(RefineTool, WhatItWritesKeepsTheDistance) {
  make("octree-like --shape thin-cap --resolution 7 --seed 56184");
  int written = 0;
  for (const int count : {300, 600, 1200, 2000}) {
    const ToolRun result =
        run("hexweft-refine in.vtk -o out.vtk --hausdorff 0.005 --json - "
            "--hexahedra " +
            std::to_string(count));
    if (result.exit_code != 0) {
      EXPECT_EQ(result.exit_code, 1);
      EXPECT_THAT(result.err, IsSentenceOf("hexweft-refine"));
      continue;
    }
    ++written;
    EXPECT_LE(Json::parse(result.out)["after"]["hausdorff_ratio"], 0.005) << count;
  }
  EXPECT_GT(written, 0);
}

TEST_F(RefineTool, RefusesWhatItCannotUse) {
  make("grid --resolution 2");
  for (const std::string arguments :
       {"in.vtk -o out.vtk", "in.vtk -o out.vtk --sheet 0 --hexahedra 100",
        "in.vtk -o out.vtk --sheet 3", "in.vtk -o out.vtk --sheet 0 --min-length 2",
        "in.vtk -o out.vtk --hexahedra 0", "in.vtk -o out.vtk --hexahedra 100 --hausdorff 0"}) {
    SCOPED_TRACE(arguments);
    const ToolRun result = run("hexweft-refine " + arguments);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, IsSentenceOf("hexweft-refine"));
  }
  EXPECT_EQ(n_files(), 1);
}

}  // namespace
}  // namespace hexweft::test
