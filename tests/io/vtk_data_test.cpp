// The data sections of legacy VTK files beyond the common ones.
#include <limits>

#include "io/vtk_attributes.h"
#include "tests/io/sample_meshes.h"

namespace hexweft::test {
namespace {

const std::string kCube =
    "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 double\n"
    "0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1\n"
    "CELLS 1 9\n8 0 1 2 3 4 5 6 7\nCELL_TYPES 1\n12\n";

HexMesh cube_with(const std::string& sections, ReadReport* report = nullptr) {
  return read_hex_mesh_text(kCube + sections, "x.vtk", {}, report);
}

TEST(VtkData, ScalarsOfSeveralComponents) {
  HexMesh expected = unit_cube();
  named_property<CellTag, Eigen::Vector3d>(expected, "three", Eigen::Vector3d(1, 2, 3));
  named_property<CellTag, Eigen::VectorXd>(expected, "two", Eigen::VectorXd(Eigen::Vector2d(1, 2)));
  expect_same_mesh(cube_with("CELL_DATA 1\nSCALARS three double 3\nLOOKUP_TABLE default\n1 2 3\n"
                             "SCALARS two float 2\nLOOKUP_TABLE default\n1 2\n"),
                   expected);
}

TEST(VtkData, ScalarsWithoutColourTable) {
  HexMesh expected = unit_cube();
  named_property<CellTag, double>(expected, "w", 0.5);
  expect_same_mesh(cube_with("CELL_DATA 1\nSCALARS w double\n0.5\n"), expected);
}

TEST(VtkData, ColourTablesAreLeftOut) {
  ReadReport report;
  HexMesh expected = unit_cube();
  named_property<CellTag, int>(expected, "part", 1);
  expect_same_mesh(cube_with("CELL_DATA 1\nSCALARS part int 1\nLOOKUP_TABLE rainbow\n1\n"
                             "LOOKUP_TABLE rainbow 2\n0 0 0 1\n1 1 1 1\n",
                             &report),
                   expected);
  EXPECT_THAT(report.notes, testing::ElementsAre(testing::HasSubstr("rainbow")));
}

TEST(VtkData, ColoursTextureCoordinatesAndIds) {
  HexMesh expected = unit_cube();
  named_property<CellTag, Eigen::Vector3d>(expected, "rgb", Eigen::Vector3d(1, 0.5, 0));
  named_property<CellTag, Eigen::VectorXd>(expected, "uv", Eigen::VectorXd(Eigen::Vector2d(0, 1)));
  named_property<CellTag, int>(expected, "gid", 9);
  named_property<CellTag, bool>(expected, "on", true);
  expect_same_mesh(cube_with("CELL_DATA 1\nCOLOR_SCALARS rgb 3\n1 0.5 0\n"
                             "TEXTURE_COORDINATES uv 2 float\n0 1\nGLOBAL_IDS gid vtkIdType\n9\n"
                             "SCALARS on bit 1\nLOOKUP_TABLE default\n1\n"),
                   expected);
}

TEST(VtkData, SecondArrayOfANameIsLeftOut) {
  ReadReport report;
  HexMesh expected = unit_cube();
  named_property<CellTag, double>(expected, "w", 1.0);
  expect_same_mesh(cube_with("CELL_DATA 1\nSCALARS w double 1\nLOOKUP_TABLE default\n1\n"
                             "SCALARS w double 1\nLOOKUP_TABLE default\n2\n",
                             &report),
                   expected);
  EXPECT_THAT(report.notes, testing::ElementsAre(testing::HasSubstr("\"w\"")));
}

TEST(VtkData, IntegersThatNeedItBecome64Bits) {
  const HexMesh mesh =
      cube_with("CELL_DATA 1\nSCALARS n long 1\nLOOKUP_TABLE default\n-2147483649\n");
  EXPECT_EQ((named_property<CellTag, std::int64_t>(mesh, "n")[CellHandle(0)]), -2147483649);
}

TEST(VtkData, IntegersThatBecomeRoundedRealsAreNoted) {
  ReadReport report;
  const std::string field = "CELL_DATA 1\nFIELD FieldData 1\npair 2 1 vtktypeint64\n";
  cube_with(field + "9007199254740992 -9007199254740992\n", &report);
  EXPECT_THAT(report.notes, testing::IsEmpty());
  const HexMesh mesh = cube_with(field + "9007199254740993 1\n", &report);
  EXPECT_EQ((named_property<CellTag, Eigen::VectorXd>(mesh, "pair")[CellHandle(0)][0]), 0x1p53);
  EXPECT_THAT(report.notes,
              testing::ElementsAre("data array \"pair\" has several integers a place, which became "
                                   "reals: those beyond 2^53 are rounded"));
}

// As VTK writes them.
TEST(VtkData, NamesMayStartWithTheSignOfComments) {
  HexMesh expected = unit_cube();
  named_property<CellTag, int>(expected, "#neighbours", 5);
  named_property<CellTag, double>(expected, "#", 0.5);
  named_property<CellTag, Eigen::VectorXd>(expected, "#2", Eigen::Vector2d(1, 2));
  expect_same_mesh(cube_with("CELL_DATA 1\nSCALARS #neighbours int 1\nLOOKUP_TABLE default\n5\n"
                             "FIELD #all 2\n# 1 1 double\n0.5\nMETADATA\nINFORMATION 0\n\n"
                             "#2 2 1 double\n1 2\n"),
                   expected);
}

TEST(VtkData, NamesAreCodedAndDecoded) {
  for (const std::string name :
       {"plain", "two words", "100%", "a\"b#c", "tab\tnewline\n", "\xc3\xa9"}) {
    EXPECT_EQ(detail::decode_vtk_name(detail::encode_vtk_name(name)), name);
    EXPECT_EQ(detail::encode_vtk_name(name).find_first_of(" \t\n#\""), std::string::npos);
  }
  EXPECT_EQ(detail::decode_vtk_name("50%"), "50%");
  EXPECT_EQ(detail::decode_vtk_name("%zz"), "%zz");
}

}  // namespace
}  // namespace hexweft::test
