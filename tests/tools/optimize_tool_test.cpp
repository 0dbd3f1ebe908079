// hexweft-optimize as a stranger meets it.
#include <sstream>

#include <nlohmann/json.hpp>

#include "io/hex_mesh_io.h"
#include "ovm/generators.h"
#include "ovm/quality.h"
#include "tests/tools/run_tool.h"

namespace hexweft::test {
namespace {

using Json = nlohmann::json;
using OptimizeTool = ToolTest;

// A grid of unit cells some of whose inner vertices lie where hexahedra are inverted.
HexMesh make_tangled_grid() {
  HexMesh mesh = make_grid({5, 5, 5});
  for (const VertexHandle v : mesh.vertices()) {
    const Eigen::Vector3d p = mesh.point(v);
    if (p == Eigen::Vector3d(2, 2, 2)) mesh.set_point(v, {3.4, 2.2, 2.1});
    if (p == Eigen::Vector3d(3, 3, 2)) mesh.set_point(v, {3.1, 4.4, 2.2});
  }
  return mesh;
}

// The boundary of a mesh as OBJ; of so many triangles each first one is turned, 0: none.
std::string boundary_obj(const HexMesh& mesh, int turned) {
  std::ostringstream obj;
  obj.precision(17);
  for (const VertexHandle v : mesh.vertices()) obj << "v " << mesh.point(v).transpose() << '\n';
  int n = 0;
  const auto triangle = [&](int a, int b, int c) {
    if (turned > 0 && n++ % turned == 0) std::swap(b, c);
    obj << "f " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n';
  };
  for (const HalfFaceHandle hf : mesh.boundary_halffaces()) {
    std::vector<int> q;
    for (const VertexHandle v : mesh.vertices(hf)) q.push_back(v.idx);
    triangle(q[0], q[1], q[2]);
    triangle(q[2], q[3], q[0]);
  }
  return obj.str();
}

TEST_F(OptimizeTool, ImprovesAnOctreeLikeMeshOnItsSurface) {
  ASSERT_EQ(run("hexweft-generate octree-like --resolution 8 -o in.vtk").exit_code, 0);
  const ToolRun result = run("hexweft-optimize in.vtk -o out.vtk --json r.json --local-trials 20");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  const Json j = Json::parse(read_file(file("r.json")));
  EXPECT_EQ(j["energy"], "inverse-scaled-jacobian");
  EXPECT_GE(j["after"]["min_scaled_jacobian"], j["before"]["min_scaled_jacobian"]);
  EXPECT_GT(j["after"]["mean_scaled_jacobian"], j["before"]["mean_scaled_jacobian"]);
  EXPECT_LE(j["after"]["hausdorff_ratio"], 0.005);
  const HexMesh before = read_hex_mesh(file("in.vtk")), after = read_hex_mesh(file("out.vtk"));
  EXPECT_EQ(before.n_cells(), after.n_cells());
  EXPECT_EQ(min_scaled_jacobian(after), j["after"]["min_scaled_jacobian"]);
  // What info measures of the file is what the report says.
  const Json info = Json::parse(run("hexweft-info out.vtk --json -").out);
  EXPECT_EQ(info["mean_scaled_jacobian"], j["after"]["mean_scaled_jacobian"]);
}

TEST_F(OptimizeTool, Untangles) {
  const HexMesh tangled = make_tangled_grid();
  ASSERT_LT(min_scaled_jacobian(tangled), 0);
  write_hex_mesh(file("in.vtk"), tangled);
  const ToolRun result = run("hexweft-optimize in.vtk -o out.vtk --untangle");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_GT(min_scaled_jacobian(read_hex_mesh(file("out.vtk"))), 0);
  // A mesh without inverted hexahedra comes back as it is.
  ASSERT_EQ(run("hexweft-optimize out.vtk -o again.vtk --untangle").exit_code, 0);
  EXPECT_EQ(read_file(file("again.vtk")), read_file(file("out.vtk")));
}

TEST_F(OptimizeTool, ReportsWhatStaysInverted) {
  write_hex_mesh(file("in.vtk"), make_tangled_grid());
  const ToolRun result = run("hexweft-optimize in.vtk -o out.vtk --untangle --iterations 0");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, IsSentenceOf("hexweft-optimize"));
  EXPECT_THAT(result.err, testing::HasSubstr("still inverted"));
  EXPECT_EQ(n_files(), 1);  // a wrong mesh is worse than none
}

TEST_F(OptimizeTool, StaysOnAnotherSurface) {
  ASSERT_EQ(run("hexweft-generate octree-like --resolution 6 -o coarse.vtk").exit_code, 0);
  ASSERT_EQ(run("hexweft-generate octree-like --resolution 14 -o fine.vtk").exit_code, 0);
  const ToolRun result =
      run("hexweft-optimize coarse.vtk -o out.vtk --surface fine.vtk --hausdorff 0.05 "
          "--local-trials 5 --json -");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json j = Json::parse(result.out);
  const Json distance = Json::parse(run("hexweft-distance out.vtk fine.vtk --json -").out);
  EXPECT_EQ(j["after"]["hausdorff_ratio"], distance["ratio"]);
}

TEST_F(OptimizeTool, ItDoesNotMatterWhichWayTheTrianglesOfASurfaceFace) {
  ASSERT_EQ(run("hexweft-generate octree-like --resolution 6 -o in.vtk").exit_code, 0);
  const HexMesh mesh = read_hex_mesh(file("in.vtk"));
  std::string expected;
  for (const int turned : {0, 1, 2}) {
    SCOPED_TRACE(turned);
    write_file(file("surface.obj"), boundary_obj(mesh, turned));
    const ToolRun result =
        run("hexweft-optimize in.vtk -o out.vtk --surface surface.obj --local-trials 5");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    if (turned == 0) expected = read_file(file("out.vtk"));
    EXPECT_EQ(read_file(file("out.vtk")), expected);
    EXPECT_EQ(result.err.find("faced into the solid") != std::string::npos, turned > 0);
  }
  EXPECT_GT(min_scaled_jacobian(read_hex_mesh(file("out.vtk"))), min_scaled_jacobian(mesh));
}

TEST_F(OptimizeTool, FeaturesHoldTheEdgesOfABox) {
  // A box whose cells are askew; its edges and corners have to stay where they are.
  HexMesh mesh = make_grid({4, 4, 4});
  mesh.set_point(VertexHandle(31), mesh.point(VertexHandle(31)) + Eigen::Vector3d(0.3, 0.2, 0.1));
  write_hex_mesh(file("in.vtk"), mesh);
  for (const char* features : {"auto", "30", "off"}) {
    SCOPED_TRACE(features);
    const ToolRun result =
        run(std::string("hexweft-optimize in.vtk -o out.vtk --features ") + features);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const HexMesh out = read_hex_mesh(file("out.vtk"));
    EXPECT_GE(min_scaled_jacobian(out), min_scaled_jacobian(mesh));
    if (features == std::string("off")) continue;
    for (const int corner : {0, 4, 20, 24, 100, 104, 120, 124}) {
      EXPECT_LT((out.point(VertexHandle(corner)) - mesh.point(VertexHandle(corner))).norm(), 1e-9);
    }
  }
}

TEST_F(OptimizeTool, EveryEnergyRunsInOptimizeAndInSimplify) {
  ASSERT_EQ(run("hexweft-generate octree-like --resolution 7 -o in.vtk").exit_code, 0);
  int n_simpler = 0;
  for (const char* energy : {"symmetric-dirichlet", "exponential-symmetric-dirichlet", "arap",
                             "conformal-amips", "exponential-conformal-amips", "log-dirichlet",
                             "hencky", "mean-ratio", "inverse-scaled-jacobian", "foldover-free"}) {
    SCOPED_TRACE(energy);
    const std::string option = std::string(" --json r.json --energy ") + energy;
    const ToolRun optimized = run("hexweft-optimize in.vtk -o out.vtk --local-trials 5" + option);
    ASSERT_EQ(optimized.exit_code, 0) << optimized.err;
    const Json o = Json::parse(read_file(file("r.json")));
    EXPECT_EQ(o["energy"], energy);
    EXPECT_GE(o["after"]["min_scaled_jacobian"], o["before"]["min_scaled_jacobian"]);
    const ToolRun simplified =
        run("hexweft-simplify in.vtk -o simple.vtk --hausdorff 0.03 --components 250" + option);
    ASSERT_EQ(simplified.exit_code, 0) << simplified.err;
    const Json s = Json::parse(read_file(file("r.json")));
    n_simpler += s["after"]["components"] < s["before"]["components"];
    EXPECT_LE(s["hausdorff_ratio"], 0.03);
    EXPECT_GT(min_scaled_jacobian(read_hex_mesh(file("simple.vtk"))), 0);
    EXPECT_EQ(run("hexweft-info simple.vtk").exit_code, 0);
  }
  EXPECT_GE(n_simpler, 8);  // the exponential energies may find nothing in a mesh this coarse
}

TEST_F(OptimizeTool, RefusesWhatItCannotUse) {
  ASSERT_EQ(run("hexweft-generate grid -o in.vtk").exit_code, 0);
  for (const auto& [arguments, code] : {std::pair("in.vtk", 2),
                                        {"in.vtk -o out.vtk --energy no-such", 2},
                                        {"in.vtk -o out.vtk --hausdorff 0", 2},
                                        {"in.vtk -o out.vtk --iterations -1", 2},
                                        {"in.vtk -o out.vtk --cycles 0", 2},
                                        {"in.vtk -o out.vtk --features sharp", 2},
                                        {"in.vtk -o out.vtk --features 200", 2},
                                        {"in.vtk -o out.vtk --surface -", 2},
                                        {"in.vtk -o out.vtk --surface missing.stl", 3}}) {
    SCOPED_TRACE(arguments);
    const ToolRun result = run(std::string("hexweft-optimize ") + arguments);
    EXPECT_EQ(result.exit_code, code);
    EXPECT_THAT(result.err, IsSentenceOf("hexweft-optimize"));
  }
  EXPECT_EQ(n_files(), 1);
}

}  // namespace
}  // namespace hexweft::test
