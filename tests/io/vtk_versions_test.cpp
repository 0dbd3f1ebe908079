// Legacy VTK files as writers of its several versions leave them.
#include <bit>

#include "io/vtk_values.h"
#include "tests/io/sample_meshes.h"

namespace hexweft::test {
namespace {

template <class T>
std::string big_endian(const std::vector<T>& values) {
  std::string bytes;
  for (T value : values) {
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), &value, sizeof(T));
    if (std::endian::native == std::endian::little) std::reverse(raw.begin(), raw.end());
    bytes.append(raw.data(), raw.size());
  }
  return bytes;
}

const std::string kCubePoints = "0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1\n";

template <class T>
std::vector<T> cube_coordinates() {
  std::vector<T> result;
  for (const auto& corner : kCornerCoords) {
    for (int x : corner) result.push_back(static_cast<T>(x));
  }
  return result;
}

TEST(VtkVersions, TextOfVersion2) {
  const HexMesh mesh = read_hex_mesh_text(
      "# vtk DataFile Version 2.0\nmesh vtk data - converted from .off\nASCII\n"
      "DATASET UNSTRUCTURED_GRID\nPOINTS 8 double\n" +
          kCubePoints +
          "CELLS 1 9\n8 0 1 2 3 4 5 6 7\nCELL_TYPES 1\n12\nPOINT_DATA 8\nSCALARS fixed int\n"
          "LOOKUP_TABLE default\n0\n1\n2\n3\n4\n5\n6\n7\n",
      "x.vtk");
  HexMesh expected = unit_cube();
  auto fixed = named_property<VertexTag, int>(expected, "fixed", 0);
  for (VertexHandle v : expected.vertices()) fixed[v] = v.idx;
  expect_same_mesh(mesh, expected);
}

TEST(VtkVersions, WindowsLineEndsBlankLinesAndComments) {
  std::string text =
      "# vtk DataFile Version 3.0\n\nASCII\n\n# made by hand\nDATASET UNSTRUCTURED_GRID\n"
      "POINTS 8 float\n# corners\n" +
      kCubePoints + "\n\nCELLS 1 9\n8 0 1 2 3\n 4 5 6 7\n\nCELL_TYPES 1\n12 # a hexahedron";
  expect_same_mesh(read_hex_mesh_text(text, "x.vtk"), unit_cube());
  for (std::size_t i = 0; (i = text.find('\n', i)) != std::string::npos; i += 2) {
    text.replace(i, 1, "\r\n");
  }
  expect_same_mesh(read_hex_mesh_text(text, "x.vtk"), unit_cube());
}

TEST(VtkVersions, BinaryOfVersion3) {
  const std::string text =
      "# vtk DataFile Version 3.0\nvtk output\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 "
      "float\n" +
      big_endian(cube_coordinates<float>()) + "\nCELLS 1 9\n" +
      big_endian<std::int32_t>({8, 0, 1, 2, 3, 4, 5, 6, 7}) + "\nCELL_TYPES 1\n" +
      big_endian<std::int32_t>({12}) +
      "\nCELL_DATA 1\nSCALARS density unsigned_short 1\nLOOKUP_TABLE default\n" +
      big_endian<std::uint16_t>({65535}) + "\nSCALARS level char 1\nLOOKUP_TABLE default\n" +
      big_endian<std::int8_t>({-3}) + "\nNORMALS axis float\n" + big_endian<float>({0, 0.5f, 1}) +
      "\n";
  HexMesh expected = unit_cube();
  named_property<CellTag, int>(expected, "density", 65535);
  named_property<CellTag, int>(expected, "level", -3);
  named_property<CellTag, Eigen::Vector3d>(expected, "axis", Eigen::Vector3d(0, 0.5, 1));
  expect_same_mesh(read_hex_mesh_text(text, "x.vtk"), expected);
}

TEST(VtkVersions, FieldsAndMetadataOfVersion4) {
  ReadReport report;
  const HexMesh mesh = read_hex_mesh_text(
      "# vtk DataFile Version 4.2\nvtk output\nASCII\nFIELD FieldData 2\nTIME 1 1 double\n0.5\n"
      "names 1 2 string\none\ntwo%20words\n"
      "DATASET UNSTRUCTURED_GRID\nPOINTS 8 double\n" +
          kCubePoints +
          "METADATA\nINFORMATION 1\nNAME L2_NORM_RANGE LOCATION vtkDataArray\nDATA 2 0 1.7\n\n"
          "CELLS 1 9\n8 0 1 2 3 4 5 6 7\n\nCELL_TYPES 1\n12\n\nCELL_DATA 1\nFIELD FieldData 2\n"
          "Grid%20Level 1 1 vtkIdType\n7\nMETADATA\nCOMPONENT_NAMES\nlevel\n\n"
          "stress 6 1 double\n1 2 3 4 5 6\nMETADATA\nINFORMATION 0\n\n"
          "POINT_DATA 8\nTENSORS t float\n" +
          [] {
            std::string rows;
            for (int i = 0; i < 24; ++i) rows += std::to_string(i / 3) + " 0 0\n";
            return rows;
          }(),
      "x.vtk", {}, &report);
  HexMesh expected = unit_cube();
  named_property<CellTag, int>(expected, "Grid Level", 7);
  named_property<CellTag, Eigen::VectorXd>(expected, "stress", Eigen::VectorXd::LinSpaced(6, 1, 6));
  auto tensor = named_property<VertexTag, Eigen::VectorXd>(expected, "t", Eigen::VectorXd::Zero(9));
  for (VertexHandle v : expected.vertices()) tensor[v](0) = tensor[v](3) = tensor[v](6) = v.idx;
  expect_same_mesh(mesh, expected);
  EXPECT_THAT(report.notes,
              testing::ElementsAre(testing::HasSubstr("names"), testing::HasSubstr("field data")));
}

TEST(VtkVersions, OffsetsAndConnectivityOfVersion5AsText) {
  expect_same_mesh(
      read_hex_mesh_text("# vtk DataFile Version 5.1\nvtk output\nASCII\n"
                         "DATASET UNSTRUCTURED_GRID\nPOINTS 8 float\n" +
                             kCubePoints +
                             "\nCELLS 2 8\nOFFSETS vtktypeint64\n0 8 \nCONNECTIVITY vtktypeint64\n"
                             "0 1 2 3 4 5 6 7 \n\nCELL_TYPES 1\n12\n\n",
                         "x.vtk"),
      unit_cube());
}

TEST(VtkVersions, OffsetsAndConnectivityOfVersion5AsBinary) {
  const std::string text =
      "# vtk DataFile Version 5.1\nvtk output\nBINARY\nDATASET UNSTRUCTURED_GRID\n"
      "POINTS 8 double\n" +
      big_endian(cube_coordinates<double>()) +
      "\nMETADATA\nINFORMATION 0\n\nCELLS 2 8\nOFFSETS vtktypeint64\n" +
      big_endian<std::int64_t>({0, 8}) + "\nCONNECTIVITY vtktypeint64\n" +
      big_endian<std::int64_t>({0, 1, 2, 3, 4, 5, 6, 7}) + "\nCELL_TYPES 1\n" +
      big_endian<std::int32_t>({12}) + "\nPOINT_DATA 8\nFIELD FieldData 2\nid 1 8 vtktypeint64\n" +
      big_endian<std::int64_t>({1, 2, 3, 4, 5, 6, 7, std::int64_t{1} << 40}) + "\nuv 2 8 float\n" +
      big_endian(std::vector<float>(16, 0.25f)) + "\n";
  HexMesh expected = unit_cube();
  auto id = named_property<VertexTag, std::int64_t>(expected, "id", 0);
  for (VertexHandle v : expected.vertices()) id[v] = v.idx + 1;
  id[VertexHandle(7)] = std::int64_t{1} << 40;
  named_property<VertexTag, Eigen::VectorXd>(expected, "uv", Eigen::VectorXd::Constant(2, 0.25));
  expect_same_mesh(read_hex_mesh_text(text, "x.vtk"), expected);
}

TEST(VtkVersions, CellsWithoutVolumeAreLeftOutWithTheirData) {
  const std::string head = "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\n";
  ReadReport report;
  const HexMesh mesh = read_hex_mesh_text(
      head + "POINTS 8 double\n" + kCubePoints +
          "CELLS 4 19\n4 0 1 2 3\n8 0 1 2 3 4 5 6 7\n2 0 1\n1 5\nCELL_TYPES 4\n9\n12\n3\n1\n"
          "CELL_DATA 4\nSCALARS part int 1\nLOOKUP_TABLE default\n10 11 12 13\n",
      "x.vtk", {}, &report);
  HexMesh expected = unit_cube();
  named_property<CellTag, int>(expected, "part", 11);
  expect_same_mesh(mesh, expected);
  EXPECT_THAT(report.notes, testing::ElementsAre(testing::HasSubstr("3 cells without volume")));
}

}  // namespace
}  // namespace hexweft::test
