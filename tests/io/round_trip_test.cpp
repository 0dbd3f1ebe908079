// The value read back is the value written.
#include <cmath>
#include <limits>

#include "io/formats.h"
#include "tests/io/sample_meshes.h"

namespace hexweft::test {
namespace {

HexMesh with_awkward_values() {
  HexMesh mesh = shaken_grid(2);
  using Limits = std::numeric_limits<double>;
  const double values[] = {0.1,   -0.0,          Limits::denorm_min(), Limits::min(), Limits::max(),
                           1e-17, 1.0 / 3.0,     123456789.123456789,  -5e-324,       1e22,
                           M_PI,  0x1.fffffp+100};
  int i = 0;
  for (double x : values) mesh.set_point(VertexHandle(i++), {x, -x, x});
  return mesh;
}

void add_every_kind_of_data(HexMesh& mesh) {
  auto flag = named_property<VertexTag, bool>(mesh, "flag", false);
  auto fixed = named_property<VertexTag, int>(mesh, "fixed", 0);
  auto id = named_property<VertexTag, std::int64_t>(mesh, "id", 0);
  auto weight = named_property<VertexTag, double>(mesh, "a weight, 100%", 0.0);
  auto normal = named_property<VertexTag, Eigen::Vector3d>(mesh, "normal", Eigen::Vector3d::Zero());
  for (VertexHandle v : mesh.vertices()) {
    flag[v] = v.idx % 3 == 0;
    fixed[v] = v.idx % 2 == 0 ? -v.idx : std::numeric_limits<int>::max();
    id[v] = (std::int64_t{1} << 60) + v.idx;
    weight[v] = v.idx == 0 ? std::numeric_limits<double>::infinity() : std::sqrt(v.idx);
    normal[v] = {std::sin(v.idx), 1e-300 * v.idx, -0.0};
  }
  auto stress = named_property<CellTag, Eigen::VectorXd>(mesh, "stress", Eigen::VectorXd::Zero(6));
  auto box = named_property<CellTag, Eigen::VectorXi>(mesh, "#box", Eigen::VectorXi::Zero(3));
  auto block = named_property<CellTag, int>(mesh, "block", 0);
  for (CellHandle c : mesh.cells()) {
    stress[c] = Eigen::VectorXd::LinSpaced(6, 0, c.idx + 0.1);
    box[c] << c.idx, -1, 7;
    block[c] = c.idx;
  }
}

TEST(RoundTrip, PointsAndCellsOfEveryFormat) {
  const HexMesh mesh = with_awkward_values();
  for (const Format& format : formats()) {
    for (bool binary : {false, true}) {
      if (binary && !format.has_binary) continue;
      SCOPED_TRACE(std::string(format.name) + (binary ? " binary" : " text"));
      const std::string name(format.name);
      const std::string text = write_hex_mesh_text(mesh, {.format = name, .binary = binary});
      const HexMesh read = read_hex_mesh_text(text, "no-extension");
      expect_same_mesh(mesh, read);
      EXPECT_EQ(text, write_hex_mesh_text(read, {.format = name, .binary = binary}));
    }
  }
}

// The formats that hold every kind of data, as text and binary.
std::vector<WriteOptions> formats_with_data() {
  std::vector<WriteOptions> result;
  for (const char* format : {"vtk", "vtu"}) {
    for (bool binary : {false, true}) result.push_back({.format = format, .binary = binary});
  }
  return result;
}

TEST(RoundTrip, DataOfVtkAndVtu) {
  HexMesh mesh = with_awkward_values();
  add_every_kind_of_data(mesh);
  for (const WriteOptions& options : formats_with_data()) {
    SCOPED_TRACE(options.format + (options.binary ? " binary" : " text"));
    WriteReport report;
    const std::string text = write_hex_mesh_text(mesh, options, &report);
    EXPECT_THAT(report.notes, testing::IsEmpty());
    const HexMesh read = read_hex_mesh_text(text, "no-extension");
    expect_same_mesh(mesh, read);
    EXPECT_EQ(text, write_hex_mesh_text(read, options));
  }
}

TEST(RoundTrip, DataOfOpenVolumeMesh) {
  HexMesh mesh = with_awkward_values();
  add_every_kind_of_data(mesh);
  for (const char* format : {"ovm", "ovmb"}) {
    SCOPED_TRACE(format);
    WriteReport report;
    const std::string text = write_hex_mesh_text(mesh, {.format = format}, &report);
    EXPECT_THAT(report.notes, testing::ElementsAre(testing::HasSubstr("stress")));  // six a cell
    const HexMesh read = read_hex_mesh_text(text, "x");
    HexMesh expected = mesh;
    property_registry<CellTag>(expected)->erase("stress");
    expect_same_mesh(expected, read);
    EXPECT_EQ(text, write_hex_mesh_text(read, {.format = format}));
  }
}

TEST(RoundTrip, NotANumberInDataSurvives) {
  HexMesh mesh = unit_cube();
  named_property<VertexTag, double>(mesh, "w", std::nan(""));
  for (const WriteOptions& options : formats_with_data()) {
    const HexMesh read = read_hex_mesh_text(write_hex_mesh_text(mesh, options), "no-extension");
    EXPECT_TRUE(std::isnan((named_property<VertexTag, double>(read, "w")[VertexHandle(0)])));
  }
}

TEST(RoundTrip, ReferencesOfMedit) {
  HexMesh mesh = shaken_grid(2);
  auto of_vertex = named_property<VertexTag, int>(mesh, "medit:ref", 0);
  auto of_cell = named_property<CellTag, int>(mesh, "medit:ref", 0);
  for (VertexHandle v : mesh.vertices()) of_vertex[v] = 3 - v.idx;
  for (CellHandle c : mesh.cells()) of_cell[c] = c.idx;
  expect_same_mesh(mesh, read_hex_mesh_text(write_hex_mesh_text(mesh, {.format = "medit"}), "x"));
}

TEST(RoundTrip, ReferencesOfMeditAreGroupsOfGmsh) {
  const std::pair<const char*, const char*> ways[] = {{"medit:ref", "gmsh"},
                                                      {"gmsh:physical", "medit"}};
  for (const auto& [name, format] : ways) {
    SCOPED_TRACE(name);
    HexMesh mesh = shaken_grid(2), expected = mesh;
    const std::string other_name = format == std::string("gmsh") ? "gmsh:physical" : "medit:ref";
    auto mine = named_property<CellTag, int>(mesh, name, 0);
    auto other = named_property<CellTag, int>(expected, other_name, 0);
    for (CellHandle c : mesh.cells()) mine[c] = other[c] = c.idx / 3;
    WriteReport report;
    const std::string text = write_hex_mesh_text(mesh, {.format = format}, &report);
    EXPECT_THAT(report.notes, testing::Contains(testing::HasSubstr(name)));
    HexMesh read = read_hex_mesh_text(text, "x");
    property_registry<CellTag>(read)->erase("gmsh:geometrical");
    expect_same_mesh(read, expected);
    // Where both are there, each format has its own.
    auto both = named_property<CellTag, int>(mesh, other_name, 7);
    const HexMesh again = read_hex_mesh_text(write_hex_mesh_text(mesh, {.format = format}), "x");
    EXPECT_EQ((named_property<CellTag, int>(again, other_name)[CellHandle(7)]), 7);
  }
}

TEST(RoundTrip, ReferencesOfMeditBeyond32Bits) {
  HexMesh mesh = unit_cube();
  auto of_cell = named_property<CellTag, std::int64_t>(mesh, "medit:ref", 2147483647);
  WriteReport report;
  std::string text = write_hex_mesh_text(mesh, {.format = "medit"}, &report);
  EXPECT_TRUE(text.starts_with("MeshVersionFormatted 2\n"));
  EXPECT_THAT(report.notes, testing::IsEmpty());
  of_cell[CellHandle(0)] = 2147483648;
  text = write_hex_mesh_text(mesh, {.format = "medit"}, &report);
  EXPECT_TRUE(text.starts_with("MeshVersionFormatted 4\n"));
  EXPECT_THAT(report.notes, testing::ElementsAre(testing::HasSubstr("32 bits")));
  expect_same_mesh(read_hex_mesh_text(text, "x"), mesh);
}

TEST(RoundTrip, MeditSaysWhatItLeavesOut) {
  HexMesh mesh = unit_cube();
  named_property<CellTag, double>(mesh, "quality", 1.0);
  WriteReport report;
  write_hex_mesh_text(mesh, {.format = "medit"}, &report);
  EXPECT_THAT(report.notes, testing::ElementsAre(testing::HasSubstr("quality")));
}

TEST(RoundTrip, PropertiesOfOtherTypesAreNamed) {
  HexMesh mesh = unit_cube();
  named_property<CellTag, std::string>(mesh, "label", "");
  WriteReport report;
  write_hex_mesh_text(mesh, {}, &report);
  EXPECT_THAT(report.notes, testing::ElementsAre(testing::HasSubstr("label")));
}

TEST(RoundTrip, DeletedElementsAreNotWritten) {
  HexMesh mesh = shaken_grid(2);
  add_every_kind_of_data(mesh);
  mesh.delete_cell(CellHandle(0));
  mesh.delete_vertex(VertexHandle(0));
  const HexMesh read = read_hex_mesh_text(write_hex_mesh_text(mesh), "x.vtk");
  mesh.collect_garbage();
  expect_same_mesh(mesh, read);
  EXPECT_EQ(read.n_cells(), 7);
  EXPECT_EQ(read.n_vertices(), 26);
}

TEST(RoundTrip, IsolatedVerticesAreKeptOnDemand) {
  HexMesh mesh = unit_cube();
  mesh.add_vertex({5, 5, 5});
  auto fixed = named_property<VertexTag, int>(mesh, "fixed", 0);
  for (VertexHandle v : mesh.vertices()) fixed[v] = v.idx;
  const std::string text = write_hex_mesh_text(mesh);
  expect_same_mesh(mesh, read_hex_mesh_text(text, "x.vtk", {.keep_isolated_vertices = true}));
  ReadReport report;
  EXPECT_EQ(read_hex_mesh_text(text, "x.vtk", {}, &report).n_vertices(), 8);
  EXPECT_THAT(report.notes, testing::ElementsAre(testing::HasSubstr("1 points")));
}

TEST(RoundTrip, PrecisionRounds) {
  HexMesh mesh = unit_cube();
  mesh.set_point(VertexHandle(0), {-1.0 / 3, 0, 123456});
  const HexMesh read = read_hex_mesh_text(write_hex_mesh_text(mesh, {.precision = 3}), "x.vtk");
  EXPECT_EQ(read.point(VertexHandle(0)), Eigen::Vector3d(-0.333, 0, 123000));
  EXPECT_THROW(write_hex_mesh_text(mesh, {.precision = 0}), InputError);
  EXPECT_THROW(write_hex_mesh_text(mesh, {.precision = 18}), InputError);
}

}  // namespace
}  // namespace hexweft::test
