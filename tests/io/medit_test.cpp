// Medit files: their free layout, and what is wrong with one.
#include "tests/io/sample_meshes.h"

namespace hexweft::test {
namespace {

const std::string kVertices =
    "Vertices 8\n0 0 0 1\n1 0 0 1\n1 1 0 1\n0 1 0 1\n0 0 1 1\n1 0 1 1\n1 1 1 1\n0 1 1 1\n";

std::string medit(const std::string& sections) {
  return "MeshVersionFormatted 2\nDimension 3\n" + sections;
}

std::string error_of(const std::string& text) { return read_error(text, "in.mesh"); }

TEST(Medit, SectionsInAnyOrderCaseAndLayout) {
  HexMesh expected = unit_cube();
  named_property<VertexTag, int>(expected, "medit:ref", 1);
  named_property<CellTag, int>(expected, "medit:ref", -4);
  ReadReport report;
  const HexMesh mesh = read_hex_mesh_text(
      "# a comment\r\nMESHVERSIONFORMATTED\r\n1 # single precision\r\nhexahedra\r\n1\r\n"
      "1 2 3 4\r\n5 6 7 8 -4\r\nDimension\r\n3\r\nQuadrilaterals 2 1 2 3 4 0 5 6 7 8 0 "
      "Corners 2 1 8 Edges 0 RequiredVertices 1\n5 Normals 1 0 0 1 " +
          kVertices + "END and what follows it",
      "x.mesh", {}, &report);
  expect_same_mesh(mesh, expected);
  EXPECT_THAT(report.notes, testing::UnorderedElementsAre(
                                "2 Quadrilaterals were left out", "2 Corners were left out",
                                "1 RequiredVertices were left out", "1 Normals were left out"));
}

TEST(Medit, SectionsOfEveryLayoutAreLeftOut) {
  ReadReport report;
  const HexMesh mesh = read_hex_mesh_text(
      medit("AngleOfCornerBound\n45.5\nTime 0\nBoundingBox\n0 0 0\n1 1 1\nTetrahedra 0\n"
            "NormalAtQuadrilateralVertices\n1\n1 2 3 4\nTangentAtEdgeVertices\n2\n1 1 2\n2 1 2\n" +
            kVertices +
            "VertexOnGeometricVertex 1 1 7\nISolutionAtVertices 1 1 1 0.5\nRidges 0\n"
            "Hexahedra 1\n1 2 3 4 5 6 7 8 0\nEdges 2\n1 2 0\n2 3\nEnd\n"),
      "x.mesh", {}, &report);
  EXPECT_EQ(mesh.n_cells(), 1);
  EXPECT_THAT(report.notes, testing::ElementsAre("section AngleOfCornerBound was left out",
                                                 "section BoundingBox was left out",
                                                 "1 NormalAtQuadrilateralVertices were left out",
                                                 "2 TangentAtEdgeVertices were left out",
                                                 "1 VertexOnGeometricVertex were left out",
                                                 "1 ISolutionAtVertices were left out",
                                                 "section Edges was left out"));
}

TEST(Medit, EndMayBeMissing) {
  EXPECT_EQ(error_of(medit(kVertices + "Hexahedra 1\n1 2 3 4 5 6 7 8 0")), "");
}

TEST(Medit, ErrorsNameTheLine) {
  const std::string cell = "Hexahedra\n1\n1 2 3 4 5 6 7 8 0\n";
  EXPECT_EQ(error_of("Mesh"), "in.mesh:1: expected MeshVersionFormatted, found \"Mesh\"");
  EXPECT_EQ(error_of("MeshVersionFormatted 9"),
            "in.mesh:1: expected a version from 1 to 4, found \"9\"");
  EXPECT_EQ(error_of("MeshVersionFormatted 1\nDimension 2\n"),
            "in.mesh:2: expected dimension 3, found \"2\"");
  EXPECT_EQ(error_of(medit("Voxels many\n")),
            "in.mesh:3: expected a number of section Voxels, found \"many\"");
  EXPECT_EQ(error_of(medit("<Voxels> 3\n")),
            "in.mesh:3: expected a section of a Medit file, found \"<Voxels>\"");
  EXPECT_EQ(error_of(medit("Vertizes 1\n0 0 0 1\n" + cell)),
            "in.mesh:7: expected Vertices, found the end of the file");
  EXPECT_EQ(error_of(medit("Vertices many\n")),
            "in.mesh:3: expected the number of Vertices, found \"many\"");
  EXPECT_EQ(error_of(medit("Vertices 1\n0 0 0 1\n0 0 1 1\n")),
            "in.mesh:5: expected a section of a Medit file, found \"0\"");
  EXPECT_EQ(error_of(medit(cell)), "in.mesh:5: expected Vertices, found the end of the file");
  EXPECT_EQ(error_of(medit(kVertices)),
            "in.mesh:11: expected Hexahedra, found the end of the file");
  EXPECT_EQ(error_of(medit(kVertices + "Hexahedra 0\nEnd\n")),
            "in.mesh:13: expected Hexahedra, found \"End\"");
  EXPECT_EQ(error_of(medit(kVertices + kVertices)), "in.mesh:12: Vertices appears twice");
  EXPECT_EQ(error_of(medit(kVertices + "Hexahedra 2\n1 2 3 4 5 6 7 8 0\n")),
            "in.mesh:13: expected a vertex number, 1 or more, of hexahedron 2 of 2, found the end "
            "of the file");
  EXPECT_EQ(error_of(medit(kVertices + "Hexahedra\n1\n0 2 3 4 5 6 7 8 0\n")),
            "in.mesh:14: expected a vertex number, 1 or more, of hexahedron 1 of 1, found \"0\"");
  EXPECT_EQ(error_of(medit(kVertices + "Hexahedra\n1\n1 2 3 4 5 6 7 9 0\n")),
            "in.mesh:14: hexahedron 1 uses vertex 9, expected one of [1, 8]");
  EXPECT_EQ(error_of(medit(kVertices + "Hexahedra\n2\n1 2 3 4 5 6 7 8 0\n1 2 3 4 5 6 7 7 0\n")),
            "in.mesh:15: hexahedron 2 uses vertex 7 twice, expected 8 different ones");
  EXPECT_EQ(error_of(medit(kVertices + "Hexahedra\n1\n1 2 3 4 5 6 7 8 x\n")),
            "in.mesh:14: expected the reference (an integer) of hexahedron 1, found \"x\"");
  EXPECT_EQ(error_of(medit("Vertices\n2\n0 0 0 0\n0 nan 0 0\n")),
            "in.mesh:6: expected a finite coordinate of vertex 2 of 2, found \"nan\"");
  EXPECT_EQ(error_of(medit("Vertices\n2\n0 0 0 0\n0 1e400 0 0\n")),
            "in.mesh:6: expected a finite coordinate of vertex 2 of 2, found \"1e400\"");
  EXPECT_EQ(error_of(medit("Vertices 1000000000\n0 0 0 0\n")),
            "in.mesh:4: expected a finite coordinate of vertex 2 of 1000000000, found the end of "
            "the file");
  EXPECT_EQ(error_of(medit("Vertices -1\n")),
            "in.mesh:3: Vertices: expected a number in [0, 1073741823], found -1");
  EXPECT_EQ(error_of(medit(kVertices + cell + "Tetrahedra 1\n1 2 3 4 0\n")),
            "in.mesh:15: expected Hexahedra alone, found 1 Tetrahedra");
  EXPECT_EQ(error_of(medit(kVertices + cell + "HexahedraQ2 1\n1 2 3 4 0\n")),
            "in.mesh:15: expected Hexahedra alone, found 1 HexahedraQ2");
  EXPECT_EQ(error_of(medit(kVertices + cell + "Tetrahedra x\n")),
            "in.mesh:15: expected the number of Tetrahedra, found \"x\"");
}

}  // namespace
}  // namespace hexweft::test
