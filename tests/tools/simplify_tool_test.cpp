// hexweft-simplify and hexweft-info as a stranger meets them.
#include <nlohmann/json.hpp>

#include "io/hex_mesh_io.h"
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
  // Two cells that share one edge only.
  write_file(file("edge.vtk"),
             "# vtk DataFile Version 2.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 14 double\n"
             "0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1\n"
             "2 1 0 2 2 0 1 2 0 2 1 1 2 2 1 1 2 1\n"
             "CELLS 2 18\n8 0 1 2 3 4 5 6 7\n8 2 8 9 10 6 11 12 13\nCELL_TYPES 2\n12\n12\n");
  const ToolRun result = run("hexweft-info edge.vtk --json report.json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto j = nlohmann::json::parse(read_file(file("report.json")));
  EXPECT_EQ(j["valid"], false);
  EXPECT_TRUE(j["components"].is_null());
  ASSERT_FALSE(j["problems"].empty());
  EXPECT_THAT(j["problems"][0].get<std::string>(), testing::HasSubstr("edge"));
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

TEST_F(SimplifyTool, InterruptedItWritesAValidMesh) {
  ASSERT_EQ(run("hexweft-generate octree-like --shape blob --resolution 20 -o in.vtk").exit_code,
            0);
  const ToolRun result =
      run("hexweft-simplify in.vtk -o out.vtk --json report.json & pid=$!; sleep 0.7; "
          "kill -TERM $pid; wait $pid");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(nlohmann::json::parse(read_file(file("report.json")))["stopped"], "interrupted");
  const HexMesh mesh = read_hex_mesh(file("out.vtk"));
  EXPECT_TRUE(is_valid(mesh));
  EXPECT_GT(min_scaled_jacobian(mesh), 0);
  EXPECT_EQ(n_files(), 3);
}

TEST_F(SimplifyTool, RefusesWhatItCannotUse) {
  ASSERT_EQ(run("hexweft-generate grid -o grid.vtk").exit_code, 0);
  for (const std::string arguments :
       {"grid.vtk", "grid.vtk -o out.vtk --hausdorff 2", "grid.vtk -o out.vtk --rate -1",
        "grid.vtk -o out.vtk --preset cube", "grid.vtk -o out.vtk --ranking height",
        "grid.vtk -o out.vtk --features sharp", "grid.vtk -o out.vtk --beta -1",
        "grid.vtk -o out.vtk --threads 0"}) {
    SCOPED_TRACE(arguments);
    const ToolRun result = run("hexweft-simplify " + arguments);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, IsSentenceOf("hexweft-simplify"));
  }
  EXPECT_EQ(n_files(), 1);
}

}  // namespace
}  // namespace hexweft::test
