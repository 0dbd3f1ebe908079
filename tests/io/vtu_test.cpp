// VTK's XML files as writers of all kinds leave them.
#include <limits>

#include "tests/io/vtu_files.h"

namespace hexweft::test {
namespace {

class EveryVtuEncoding : public testing::TestWithParam<VtuEncoding> {};

TEST_P(EveryVtuEncoding, IsRead) {
  VtuFile file(GetParam());
  add_cube_piece(file);
  ReadReport report;
  expect_same_mesh(read_hex_mesh_text(file.text(), "no-extension", {}, &report), cube_with_data());
  EXPECT_EQ(report.format, "vtu");
  EXPECT_THAT(report.notes, testing::ElementsAre(testing::HasSubstr("1 cells without volume")));
}

TEST_P(EveryVtuEncoding, IsAnErrorWhereverTheFileIsCutOff) {
  VtuFile file(GetParam());
  add_cube_piece(file);
  const std::string whole = file.text();
  for (std::size_t n = 0; n + 2 < whole.size(); ++n) {
    EXPECT_THAT(read_error(whole.substr(0, n), "in.vtu"), testing::StartsWith("in.vtu:"))
        << "after " << n << " bytes";
  }
}

std::vector<VtuEncoding> every_vtu_encoding() {
  std::vector<VtuEncoding> result{{}};
  for (const char* format : {"binary", "base64", "raw"}) {
    for (std::endian order : {std::endian::little, std::endian::big}) {
      for (std::size_t header_bytes : {4, 8}) {
        for (std::size_t block_size : {0, 16, 24, 1 << 15}) {
          result.push_back({format, order, header_bytes, block_size});
        }
      }
    }
  }
  return result;
}
INSTANTIATE_TEST_SUITE_P(Every, EveryVtuEncoding, testing::ValuesIn(every_vtu_encoding()));

// A text file of the unit cube with more in its piece.
std::string cube_with(const std::string& more, const std::string& types = "12") {
  return "<VTKFile type='UnstructuredGrid'>\n<UnstructuredGrid>\n"
         "<Piece NumberOfCells='1' NumberOfPoints='8'>\n" +
         more +
         "\n<Points><DataArray type='Int8'>0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1"
         "</DataArray></Points>\n<Cells>"
         "<DataArray type='UInt64' Name='offsets'>8</DataArray>"
         "<DataArray type='Int8' Name='connectivity'>0 1 2 3 4 5 6 7</DataArray>"
         "<DataArray type='Int32' Name='types'>" +
         types +
         "</DataArray></Cells>\n"
         "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

TEST(Vtu, VoxelIsRenumbered) {
  const HexMesh mesh = read_hex_mesh_text(cube_with("", "11"), "x.vtu");
  EXPECT_EQ(mesh.vertices(CellHandle(0))[2], VertexHandle(3));
  EXPECT_EQ(mesh.vertices(CellHandle(0))[7], VertexHandle(6));
}

TEST(Vtu, EveryTypeOfNumbers) {
  const auto array = [](const std::string& type, const std::string& value) {
    return "<DataArray type='" + type + "' Name='" + type + "'>" + value + "</DataArray>";
  };
  HexMesh expected = unit_cube();
  named_property<CellTag, int>(expected, "Int8", -128);
  named_property<CellTag, int>(expected, "UInt8", 255);
  named_property<CellTag, int>(expected, "Int16", -32768);
  named_property<CellTag, int>(expected, "UInt16", 65535);
  named_property<CellTag, int>(expected, "Int32", std::numeric_limits<int>::min());
  named_property<CellTag, std::int64_t>(expected, "UInt32", 4294967295);
  named_property<CellTag, std::int64_t>(expected, "Int64", -4294967296);
  named_property<CellTag, std::int64_t>(expected, "UInt64",
                                        std::numeric_limits<std::int64_t>::max());
  named_property<CellTag, double>(expected, "Float32", -std::numeric_limits<double>::infinity());
  named_property<CellTag, double>(expected, "Float64", 0.1);
  named_property<CellTag, bool>(expected, "Bit", true);
  expect_same_mesh(
      read_hex_mesh_text(
          cube_with("<CellData>" + array("Int8", "-128") + array("UInt8", "255") +
                    array("Int16", "-32768") + array("UInt16", "65535") +
                    array("Int32", "-2147483648") + array("UInt32", "4294967295") +
                    array("Int64", "-4294967296") + array("UInt64", "9223372036854775807") +
                    array("Float32", "-Infinity") + array("Float64", "0.1") + array("Bit", "1") +
                    "</CellData>"),
          "x.vtu"),
      expected);
}

TEST(Vtu, BitsAreReadPackedAndByTheirAttribute) {
  // 8 packed bits behind the size of one byte: 10010010.
  const HexMesh mesh = read_hex_mesh_text(
      cube_with("<PointData><DataArray type='Bit' Name='packed' format='binary'>AQAAAJI="
                "</DataArray><DataArray type='UInt8' Name='flag' Bit='1'>1 0 0 1 0 0 1 0"
                "</DataArray><DataArray type='UInt8' Name='no-flag' Bit='1'>1 0 0 1 0 0 1 2"
                "</DataArray></PointData>"),
      "x.vtu");
  const auto packed = named_property<VertexTag, bool>(mesh, "packed");
  const auto flag = named_property<VertexTag, bool>(mesh, "flag");
  for (VertexHandle v : mesh.vertices()) {
    EXPECT_EQ(packed[v], v.idx % 3 == 0);
    EXPECT_EQ(flag[v], v.idx % 3 == 0);
  }
  EXPECT_EQ((named_property<VertexTag, int>(mesh, "no-flag")[VertexHandle(7)]), 2);
}

TEST(Vtu, BoolsAreWrittenAsBytesThatOtherReadersKnow) {
  HexMesh mesh = unit_cube();
  named_property<CellTag, bool>(mesh, "flag", true);
  EXPECT_THAT(write_hex_mesh_text(mesh, {.format = "vtu"}),
              testing::HasSubstr("<DataArray type=\"UInt8\" Name=\"flag\" Bit=\"1\" "
                                 "format=\"ascii\">\n1\n</DataArray>"));
}

TEST(Vtu, WhatTheMeshHasNoPlaceForIsNamed) {
  std::string text = cube_with(
      "<CellData><Array type='String' Name='label' format='ascii'>97 0</Array>"
      "<DataArray type='Int8' Name='part'>1</DataArray>"
      "<DataArray type='Int8' Name='part'>2</DataArray>"
      "<DataArray type='Int8'>3</DataArray></CellData>");
  text.replace(text.find("<Piece"), 0,
               "<FieldData><DataArray type='Float64' Name='TIME' NumberOfTuples='1'>0.5"
               "</DataArray></FieldData>\n");
  ReadReport report;
  HexMesh expected = unit_cube();
  named_property<CellTag, int>(expected, "part", 1);
  expect_same_mesh(read_hex_mesh_text(text, "x.vtu", {}, &report), expected);
  EXPECT_THAT(report.notes,
              testing::UnorderedElementsAre("the array of strings \"label\" was left out",
                                            "a second data array named \"part\" was left out",
                                            "a data array without a name was left out",
                                            "field data of the whole file were left out"));
}

TEST(Vtu, WhatNewerWritersAddIsIgnored) {
  std::string text = cube_with(
      "<PointData><DataArray type='Float64' Name='w' NumberOfComponents='1' ComponentName0='x'>\n"
      "0 1 2 3 4 5 6 7\n<InformationKey name='L2_NORM_RANGE' location='vtkDataArray' length='1'>"
      "<Value index='0'>\n7\n</Value></InformationKey></DataArray></PointData><!-- none -->");
  text.replace(text.find("<Cells>"), 7,
               "<Cells><DataArray type='Int64' Name='faces'>1 2</DataArray>"
               "<DataArray type='Int64' Name='faceoffsets'>-1</DataArray>");
  text.replace(text.find("type="), 5, "version='2.3' type=");
  const HexMesh mesh =
      read_hex_mesh_text("\xef\xbb\xbf<?xml version='1.0'?>\r\n" + text, "no-extension");
  EXPECT_EQ((named_property<VertexTag, double>(mesh, "w")[VertexHandle(7)]), 7);
}

TEST(Vtu, NamesMayHoldWhatXmlCanHold) {
  HexMesh mesh = unit_cube();
  for (const char* name : {"<a & \"b\">", "tab\tline\nend\r", "\xc3\xa9", " x ", "&amp;"}) {
    named_property<CellTag, int>(mesh, name, 1);
  }
  WriteReport report;
  for (bool binary : {false, true}) {
    const std::string text =
        write_hex_mesh_text(mesh, {.format = "vtu", .binary = binary}, &report);
    EXPECT_THAT(report.notes, testing::IsEmpty());
    expect_same_mesh(read_hex_mesh_text(text, "x.vtu"), mesh);
  }
}

TEST(Vtu, NamesThatNoXmlFileHoldsAreNoted) {
  for (const std::string name :
       {"bell\a", "\x80", "\xc3", "\xc0\xaf", "\xed\xa0\x80", "\xef\xbf\xbf", "\xf5\x80\x80\x80"}) {
    HexMesh mesh = unit_cube();
    named_property<CellTag, int>(mesh, name, 1);
    WriteReport report;
    const std::string text = write_hex_mesh_text(mesh, {.format = "vtu"}, &report);
    EXPECT_THAT(report.notes, testing::ElementsAre(testing::HasSubstr("no XML file holds")));
    expect_same_mesh(read_hex_mesh_text(text, "x.vtu"), unit_cube());
  }
}

TEST(Vtu, PiecesComeOneAfterTheOther) {
  for (const VtuEncoding& encoding : {VtuEncoding{}, VtuEncoding{.format = "raw"}}) {
    VtuFile file(encoding);
    add_cube_piece(file);
    file.add("<Piece NumberOfPoints=\"0\" NumberOfCells=\"0\"/>");
    add_cube_piece(file);
    ReadReport report;
    const HexMesh mesh = read_hex_mesh_text(file.text(), "x.vtu", {}, &report);
    EXPECT_EQ(mesh.n_vertices(), 16);
    EXPECT_EQ(mesh.n_cells(), 2);
    EXPECT_EQ(mesh.vertices(CellHandle(1))[0], VertexHandle(8));
    EXPECT_EQ(mesh.point(VertexHandle(15)), Eigen::Vector3d(0, 1, 1));
    EXPECT_EQ((named_property<VertexTag, double>(mesh, "weight")[VertexHandle(12)]), -2);
    EXPECT_EQ((named_property<CellTag, int>(mesh, "part")[CellHandle(1)]), 300);
    EXPECT_THAT(report.notes, testing::ElementsAre(testing::HasSubstr("2 pieces were put beside"),
                                                   testing::HasSubstr("2 cells without volume")));
  }
}

TEST(Vtu, DataThatOnlySomePiecesHaveAreLeftOut) {
  const auto piece = [](const std::string& arrays) {
    const std::string text = cube_with("<CellData>" + arrays + "</CellData>");
    const std::size_t begin = text.find("<Piece");
    return text.substr(begin, text.find("</UnstructuredGrid>") - begin);
  };
  const std::string part = "<DataArray type='Int8' Name='part'>1</DataArray>";
  ReadReport report;
  const HexMesh mesh =
      read_hex_mesh_text("<VTKFile type='UnstructuredGrid'><UnstructuredGrid>" +
                             piece(part + "<DataArray type='Int8' Name='first'>1</DataArray>"
                                          "<DataArray type='Int8' Name='other'>1</DataArray>") +
                             piece("<DataArray type='Float32' Name='other'>1</DataArray>" + part) +
                             "</UnstructuredGrid></VTKFile>",
                         "x.vtu", {}, &report);
  EXPECT_EQ(mesh.n_cells(), 2);
  std::vector<std::string> notes;
  const auto arrays = detail::property_arrays<CellTag>(mesh, notes);
  ASSERT_EQ(arrays.size(), 1u);
  EXPECT_EQ(arrays[0].name, "part");
  EXPECT_THAT(report.notes, testing::ElementsAre(testing::HasSubstr("\"first\" was left out"),
                                                 testing::HasSubstr("\"other\" was left out"),
                                                 testing::HasSubstr("2 pieces")));
}

}  // namespace
}  // namespace hexweft::test
