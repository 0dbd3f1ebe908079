// Gmsh files of each version and coding, and what becomes of their tags and data.
#include "io/gmsh.h"

#include "tests/io/gmsh_samples.h"

namespace hexweft::test {
namespace {

HexMesh tower() {
  HexMesh mesh;
  for (int i = 0; i < 12; ++i) mesh.add_vertex(tower_point(i));
  for (int c = 0; c < 2; ++c) {
    CellVertices corners;
    for (int i = 0; i < 8; ++i) corners[i] = VertexHandle(4 * c + i);
    mesh.add_cell(corners);
  }
  return mesh;
}

HexMesh tower_with_tags() {
  HexMesh mesh = tower();
  auto physical = named_property<CellTag, int>(mesh, kGmshPhysical, 7);
  auto geometrical = named_property<CellTag, int>(mesh, kGmshGeometrical, 1);
  physical[CellHandle(1)] = 9;
  geometrical[CellHandle(1)] = 2;
  return mesh;
}

HexMesh tower_with_data() {
  HexMesh mesh = tower_with_tags();
  auto heat = named_property<VertexTag, double>(mesh, "heat, 100%", 0.0);
  for (VertexHandle v : mesh.vertices()) heat[v] = v.idx + 0.5;
  auto axis = named_property<CellTag, Eigen::Vector3d>(mesh, "axis", Eigen::Vector3d(0, 0, 0));
  axis[CellHandle(1)] = {1, 2, 3};
  return mesh;
}

// A cube of version 2.2 with sections after it; nodes 1 to 8, one element of tag 1.
std::string cube_with(const std::string& sections) {
  return write_hex_mesh_text(unit_cube(), {.format = "gmsh"}) + sections;
}

std::vector<std::string> notes_of(const std::string& text) {
  ReadReport report;
  read_hex_mesh_text(text, "x.msh", {}, &report);
  return report.notes;
}

TEST(Gmsh, EveryVersionAndCoding) {
  for (const char* version : kGmshVersions) {
    for (GmshCoding coding : kGmshCodings) {
      SCOPED_TRACE(std::string(version) + ", coding " + std::to_string(int(coding)));
      ReadReport report;
      const HexMesh mesh =
          read_hex_mesh_text(gmsh_tower(version, coding), "no-extension", {}, &report);
      expect_same_mesh(mesh, tower_with_data());
      EXPECT_EQ(report.format, "gmsh");
      EXPECT_THAT(
          report.notes,
          testing::ElementsAre(
              "1 elements without volume (points, lines, faces) were left out",
              std::string(version) == "2.2"
                  ? "1 hexahedra listed again for another physical group were left out; the first "
                    "group counts"
                  : "1 volumes are in several physical groups; the first counts",
              "data \"axis\": values of 1 elements that are no hexahedra were left out",
              "data \"axis\" have no value of 1 of 2 hexahedra, which is 0 now",
              "section $PhysicalNames was left out"));
    }
  }
}

TEST(Gmsh, TagsBeyond32BitsAndSectionsInAnyOrder) {
  const std::int64_t first = std::int64_t{1} << 60;
  const auto number = [&](int i) { return std::to_string(first + 7 * i) + " "; };
  std::string tags, places, corners;
  for (int i = 0; i < 8; ++i) {
    const auto& x = kCornerCoords[i];
    tags += number(7 - i);
    for (int j : x) places += std::to_string(j) + " ";
    corners += number(7 - i);
  }
  expect_same_mesh(
      read_hex_mesh_text("$Comments\nby hand\n$EndComments\n$MeshFormat 4.1 0 8 $EndMeshFormat\r\n"
                         "$Elements\n1 1 1 1\n3 0 5 1\n" +
                             number(1) + corners + "\n$EndElements\n$Nodes\n1 8 0 0\n3 0 0 8\n" +
                             tags + places + "\n$EndNodes",
                         "x"),
      unit_cube());
}

TEST(Gmsh, NodesWithParametersOfVersion2) {
  expect_same_mesh(
      read_hex_mesh_text("$MeshFormat\n2.1 0 8\n$EndMeshFormat\n$ParametricNodes\n8\n"
                         "1 0 0 0 0 1\n2 1 0 0 1 4 0.5\n3 1 1 0 2 9 0.5 0.25\n4 0 1 0 3 1\n"
                         "5 0 0 1 3 1\n6 1 0 1 3 1\n7 1 1 1 3 1\n8 0 1 1 3 1\n"
                         "$EndParametricNodes\n$Elements\n1\n1 5 0 1 2 3 4 5 6 7 8\n"
                         "$EndElements\n",
                         "x.msh"),
      unit_cube());
}

TEST(Gmsh, CellsListedTwiceInOneGroupAreTheUsersOwn) {
  std::string text = cube_with("");
  const std::string row = "1 5 2 0 0 1 2 3 4 5 6 7 8\n";
  text.replace(text.find("\n1\n" + row), 3 + row.size(), "\n2\n" + row + "2" + row.substr(1));
  EXPECT_EQ(read_hex_mesh_text(text, "x.msh").n_cells(), 2);
}

TEST(Gmsh, TagsAndDataComeBack) {
  HexMesh mesh = tower_with_data();
  auto stress = named_property<VertexTag, Eigen::VectorXd>(mesh, "stress", Eigen::VectorXd(9));
  for (VertexHandle v : mesh.vertices()) stress[v] = Eigen::VectorXd::LinSpaced(9, v.idx, 0.1);
  for (bool binary : {false, true}) {
    WriteReport report;
    const std::string text =
        write_hex_mesh_text(mesh, {.format = "gmsh", .binary = binary}, &report);
    EXPECT_THAT(report.notes, testing::IsEmpty());
    const HexMesh read = read_hex_mesh_text(text, "x.msh");
    expect_same_mesh(read, mesh);
    EXPECT_EQ(text, write_hex_mesh_text(read, {.format = "gmsh", .binary = binary}));
    EXPECT_THAT(notes_of(text), testing::IsEmpty());
  }
}

TEST(Gmsh, GroupsWithoutVolumesGetOneEach) {
  HexMesh mesh = tower();
  auto physical = named_property<CellTag, int>(mesh, kGmshPhysical, 0);
  physical[CellHandle(1)] = 4;
  WriteReport report;
  const std::string text = write_hex_mesh_text(mesh, {.format = "gmsh"}, &report);
  EXPECT_THAT(text, testing::HasSubstr("\n1 5 2 0 0 1 2 3 4 5 6 7 8\n2 5 2 4 4 5 6 7 8 9 10"));
  EXPECT_THAT(report.notes, testing::ElementsAre(testing::HasSubstr("volume of its own")));
}

TEST(Gmsh, VolumesOfSeveralGroupsAreNamed) {
  HexMesh mesh = tower_with_tags();
  named_property<CellTag, int>(mesh, kGmshGeometrical)[CellHandle(1)] = 1;
  WriteReport report;
  const std::string text = write_hex_mesh_text(mesh, {.format = "gmsh"}, &report);
  expect_same_mesh(read_hex_mesh_text(text, "x"), mesh);
  EXPECT_THAT(report.notes,
              testing::ElementsAre("volume 1 has cells of 2 physical groups: Gmsh will put all of "
                                   "it into each"));
}

TEST(Gmsh, IntegersAreWrittenAsRealsOrLeftOut) {
  HexMesh mesh = unit_cube();
  named_property<VertexTag, int>(mesh, "fixed", -3);
  named_property<VertexTag, bool>(mesh, "flag", true);
  named_property<CellTag, std::int64_t>(mesh, "id", (std::int64_t{1} << 53) + 1);
  named_property<CellTag, int>(mesh, kGmshPhysical, -1);  // no tag of Gmsh
  named_property<CellTag, Eigen::VectorXd>(mesh, "two", Eigen::VectorXd::Zero(2));
  named_property<CellTag, double>(mesh, "a \"name\"", 0.5);
  WriteReport report;
  const std::string text = write_hex_mesh_text(mesh, {.format = "gmsh"}, &report);
  EXPECT_THAT(report.notes,
              testing::ElementsAre(
                  "property \"fixed\" was written as reals: Gmsh has no other data",
                  "property \"flag\" was written as reals: Gmsh has no other data",
                  "property \"id\" was left out: data of Gmsh are reals, which cannot hold its "
                  "integers",
                  "property \"gmsh:physical\" was written as reals: Gmsh has no other data",
                  "property \"two\" was left out: it has 2 components, and data of Gmsh 1, 3 or 9",
                  "property \"a \"name\"\" was left out: Gmsh has no way to write its name"));
  HexMesh expected = unit_cube();
  named_property<VertexTag, double>(expected, "fixed", -3.0);
  named_property<VertexTag, double>(expected, "flag", 1.0);
  named_property<CellTag, double>(expected, kGmshPhysical, -1.0);
  expect_same_mesh(read_hex_mesh_text(text, "x.msh"), expected);
}

TEST(Gmsh, DataOfSomePlacesOnly) {
  const std::string tail = "1\n0\n3\n0\n1\n1\n";
  const std::string text = cube_with(
      "$NodeData\n1\nplain name\n" + tail + "8 2.5\n$EndNodeData\n$ElementData\n1\n\"of faces\"\n" +
      tail + "77 1\n$EndElementData\n$NodeData\n0\n" + tail + "1 nan\n$EndNodeData\n" +
      "$NodeData\n1\n\"plain name\"\n" + tail + "1 1\n$EndNodeData\n" +
      "$NodeData\n1\n\"plain name\"\n" + tail + "1 1\n$EndNodeData\n" +
      "$ElementData\n1\n\"six\"\n1\n0\n3\n0\n6\n1\n1 1 2 3 4 5 6\n$EndElementData\n" +
      "$ElementNodeData\nanything\n$EndElementNodeData\n$Periodic\n0\n$EndPeriodic\n" +
      "$ElementNodeData\nanything\n$EndElementNodeData\n");
  EXPECT_THAT(notes_of(text),
              testing::ElementsAre(
                  "data \"plain name\" have no value of 7 of 8 nodes, which is 0 now",
                  "data \"of faces\" were left out: they have no value of any of the hexahedra",
                  "data \"unnamed\" have no value of 7 of 8 nodes, which is 0 now",
                  "a second data array named \"plain name\" was left out",
                  "data \"six\" were left out: they have 6 components, expected 1, 3 or 9",
                  "2 sections $ElementNodeData were left out", "section $Periodic was left out"));
  const HexMesh mesh = read_hex_mesh_text(text, "x.msh");
  const auto values = named_property<VertexTag, double>(mesh, "plain name");
  EXPECT_EQ(values[VertexHandle(7)], 2.5);
  EXPECT_EQ(values[VertexHandle(0)], 0);
}

TEST(Gmsh, PrecisionRounds) {
  HexMesh mesh = unit_cube();
  mesh.set_point(VertexHandle(0), {-1.0 / 3, 0, 123456});
  const std::string text = write_hex_mesh_text(mesh, {.format = "gmsh", .precision = 3});
  EXPECT_EQ(read_hex_mesh_text(text, "x").point(VertexHandle(0)),
            Eigen::Vector3d(-0.333, 0, 123000));
}

}  // namespace
}  // namespace hexweft::test
