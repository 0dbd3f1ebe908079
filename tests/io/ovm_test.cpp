// Text files of OpenVolumeMesh: their layout, what they keep, and what is wrong with one.
#include "ovm/quality.h"
#include "tests/io/ovm_samples.h"
#include "tests/io/sample_meshes.h"

namespace hexweft::test {
namespace {

const std::string kTopology = kOvmCubeEdges + kOvmCubeFaces + kOvmCubeCell;

std::string error_of(const std::string& text) { return read_error(text, "in.ovm"); }

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  return text.replace(text.find(what), what.size(), with);
}

TEST(Ovm, CommentsEmptyLinesCaseAndTrailingWordsDoNotMatter) {
  const std::string text =
      "# by nobody\r\n\r\novm ascii\r\nVERTICES\r\n8\r\n  0 0 0\r\n# a comment\r\n1 0 0 and "
      "more\r\n"
      "\r\n1 1 0\r\n0 1 0\r\n0 0 1\r\n1 0 1\r\n1 1 1\r\n0 1 1\r\n" +
      kTopology;
  expect_same_mesh(read_hex_mesh_text(text, "x.ovm"), unit_cube());
}

TEST(Ovm, OldFilesStartWithTheVertices) {
  ReadReport report;
  expect_same_mesh(read_hex_mesh_text(kOvmCubePoints + kTopology, "x", {}, &report), unit_cube());
  EXPECT_EQ(report.format, "ovm");
}

TEST(Ovm, HalfFacesMayComeInAnyOrder) {
  std::array<int, 6> order{0, 2, 4, 6, 8, 10};
  std::sort(order.begin(), order.end());
  do {
    std::string cell = "Polyhedra\n1\n6";
    for (int half_face : order) cell += ' ' + std::to_string(half_face);
    const HexMesh mesh =
        read_hex_mesh_text(kOvmCubePoints + kOvmCubeEdges + kOvmCubeFaces + cell + "\n", "x.ovm");
    EXPECT_NEAR(summarize_quality(mesh).min_scaled_jacobian, 1, 1e-12) << cell;
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(Ovm, HalfFacesThatFaceOutwardAreTurned) {
  ReadReport report;
  const HexMesh mesh = read_hex_mesh_text(replaced(kOvmCube, "6 0 2 4 6 8 10", "6 1 3 5 7 9 11"),
                                          "x.ovm", {}, &report);
  EXPECT_NEAR(summarize_quality(mesh).min_scaled_jacobian, 1, 1e-12);
  EXPECT_THAT(report.notes, testing::ElementsAre(testing::HasSubstr("mirrored")));
}

TEST(Ovm, ValuesOfEveryType) {
  const std::string ones = "1 1\n1 1\n1 1\n1 1\n1 1\n1 1\n1 1\n1 1\n";
  ReadReport report;
  const HexMesh mesh = read_hex_mesh_text(
      kOvmCube + "VPROP vec2f \"uv\"\n" + ones +
          "VProp string \"label\"\n3:a\nb\n0:\n1:#\n7:CProp \"\n2:xy\n0:\n0:\n0:\n"
          "EProp bool \"feature\"\n0\n1\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n"
          "VProp vector_double \"list\"\n1\n0.5\n\n0\n\n0\n\n0\n\n0\n\n0\n\n0\n\n0\n\n"
          "MProp int \"n\"\n3\nCProp uchar \"raw\"\n#\n"
          "CProp ulong \"big\"\"\n9007199254740993\n"
          "CProp double \"\"\n-inf\nCProp vec4ui \"four\"\n1 2 3 4\n"
          "CProp bool \"yes\"\n1\nCProp short \"small\"\n-7",
      "x.ovm", {}, &report);
  const CellHandle c(0);
  EXPECT_EQ((named_property<VertexTag, Eigen::VectorXd>(mesh, "uv")[VertexHandle(7)]),
            Eigen::Vector2d(1, 1));
  EXPECT_EQ((named_property<CellTag, std::int64_t>(mesh, "big")[c]), 9007199254740993);
  EXPECT_EQ((named_property<CellTag, Eigen::VectorXi>(mesh, "four")[c]),
            Eigen::Vector4i(1, 2, 3, 4));
  EXPECT_TRUE((named_property<CellTag, bool>(mesh, "yes")[c]));
  EXPECT_EQ((named_property<CellTag, int>(mesh, "small")[c]), -7);
  EXPECT_THAT(report.notes,
              testing::ElementsAre("property \"label\" of vertices (string) was left out",
                                   "property \"feature\" of edges (bool) was left out",
                                   "property \"list\" of vertices (vector_double) was left out",
                                   "property \"n\" of the whole mesh (int) was left out",
                                   "property \"raw\" of cells (uchar) was left out"));
}

TEST(Ovm, FacesWithoutACellAreCounted) {
  ReadReport report;
  const std::string text =
      replaced(replaced(kOvmCube, "Faces\n6\n", "Faces\n7\n"), "Polyhedra", "4 0 2 4 6\nPolyhedra");
  expect_same_mesh(read_hex_mesh_text(text, "x.ovm", {}, &report), unit_cube());
  EXPECT_THAT(report.notes, testing::ElementsAre("1 faces that no hexahedron has were left out"));
}

TEST(Ovm, WhatHasNoPlaceIsNamed) {
  HexMesh mesh = unit_cube();
  named_property<CellTag, Eigen::VectorXd>(mesh, "stress", Eigen::VectorXd::Zero(6));
  named_property<CellTag, int>(mesh, "two\nlines", 1);
  named_property<CellTag, int>(mesh, "quoted\"", 1);
  named_property<CellTag, int>(mesh, "kept \" # %", 1);
  WriteReport report;
  const std::string text = write_hex_mesh_text(mesh, {.format = "ovm"}, &report);
  EXPECT_THAT(report.notes,
              testing::ElementsAre(testing::HasSubstr("stress"), testing::HasSubstr("two\nlines"),
                                   testing::HasSubstr("quoted")));
  const HexMesh read = read_hex_mesh_text(text, "x.ovm");
  EXPECT_EQ((named_property<CellTag, int>(read, "kept \" # %", 0)[CellHandle(0)]), 1);
}

TEST(Ovm, ErrorsNameTheLine) {
  EXPECT_EQ(error_of("OVM BINARY\n"), "in.ovm:1: expected ASCII, found \"BINARY\"");
  EXPECT_EQ(error_of("Edges\n"), "in.ovm:1: expected OVM ASCII, found \"Edges\"");
  EXPECT_EQ(error_of("OVM ASCII\nEdges\n"), "in.ovm:2: expected Vertices, found \"Edges\"");
  EXPECT_EQ(error_of("Vertices\n-1\n"),
            "in.ovm:2: expected a number of vertices in [0, 1073741823], found \"-1\"");
  EXPECT_EQ(
      error_of("Vertices\n1073741823\n0 0 0\n"),
      "in.ovm:3: expected a finite coordinate of vertex 1 of 1073741823, found the end of the "
      "file");
  EXPECT_EQ(error_of("Vertices\n0\nEdges\n0\nFaces\n0\nPolyhedra\n178956971\n"),
            "in.ovm:8: expected a number of polyhedra in [0, 178956970], found \"178956971\"");
  EXPECT_EQ(error_of("Vertices\n2\n0 0 0\n0 nan 0\n"),
            "in.ovm:4: expected a finite coordinate of vertex 1 of 2, found \"nan\"");
  EXPECT_EQ(error_of("Vertices\n2\n0 0\n0 0 0\n"),
            "in.ovm:3: expected a finite coordinate of vertex 0 of 2, found the end of the line");
  EXPECT_EQ(error_of("Vertices\n99999999\n0 0 0\n"),
            "in.ovm:3: expected a finite coordinate of vertex 1 of 99999999, found the end of the "
            "file");
  EXPECT_EQ(error_of(kOvmCubePoints), "in.ovm:10: expected Edges, found the end of the file");
  EXPECT_EQ(error_of(replaced(kOvmCube, "\n0 4\n", "\n0 8\n")),
            "in.ovm:25: edge 11 has 8 among its vertices, expected [0, 7]");
  EXPECT_EQ(error_of(replaced(kOvmCube, "4 0 2 4 6", "3 0 2 4")),
            "in.ovm:28: face 0 has 3 half-edges, expected 4: only hexahedra can be read");
  EXPECT_EQ(error_of(replaced(kOvmCube, "4 0 2 4 6", "4 0 2 4 24")),
            "in.ovm:28: face 0 has 24 among its half-edges, expected [0, 23]");
  EXPECT_EQ(error_of(replaced(kOvmCube, "6 0 2 4 6 8 10", "4 0 2 4 6")),
            "in.ovm:36: polyhedron 0 has 4 half-faces, expected 6: only hexahedra can be read");
  EXPECT_EQ(error_of(replaced(kOvmCube, "4 0 2 4 6", "4 0 4 2 6")),
            "in.ovm:36: polyhedron 0 has face 0, the half-edges of which do not follow each other");
  EXPECT_EQ(error_of(replaced(kOvmCube, "6 0 2 4 6 8 10", "6 0 2 4 6 8 8")),
            "in.ovm:36: polyhedron 0 has half-faces that do not bound a hexahedron");
  EXPECT_EQ(error_of(replaced(kOvmCube, "6 0 2 4 6 8 10", "6 0 2 4 6 8 11")),
            "in.ovm:36: polyhedron 0 has half-faces that do not bound a hexahedron");
  EXPECT_EQ(error_of(replaced(kOvmCube, "1\n6 0 2 4 6 8 10\n", "0\n")),
            "in.ovm:36: expected hexahedra, found none");
  EXPECT_EQ(error_of(kOvmCube + "VProp int name\n"),
            "in.ovm:37: expected the name of a property in quotation marks");
  EXPECT_EQ(error_of(kOvmCube + "Properties\n"),
            "in.ovm:37: expected a property, as VProp or CProp, found \"Properties\"");
  EXPECT_EQ(error_of(kOvmCube + "CProp vec2i \"x\"\n1 2.5\n"),
            "in.ovm:38: expected an integer in row 0 of a property of type vec2i, found \"2.5\"");
  EXPECT_EQ(error_of(kOvmCube + "MProp string \"x\"\n5:abc\n"),
            "in.ovm:38: expected a string with its length, as 5:hello, found \"5:abc\"");
}

}  // namespace
}  // namespace hexweft::test
