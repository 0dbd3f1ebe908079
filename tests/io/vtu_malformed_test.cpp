// What is wrong with a .vtu file, and in which line.
#include "tests/io/vtu_files.h"

namespace hexweft::test {
namespace {

// Lines 1 to 20; each test replaces one of them.
const std::vector<std::string> kLines{
    "<?xml version='1.0'?>",
    "<VTKFile type='UnstructuredGrid' version='1.0' header_type='UInt32'>",
    "<UnstructuredGrid>",
    "<Piece NumberOfPoints='8' NumberOfCells='1'>",
    "<Points>",
    "<DataArray type='Float64' NumberOfComponents='3'>",
    "0 0 0 1 0 0 1 1 0 0 1 0",
    "0 0 1 1 0 1 1 1 1 0 1 1",
    "</DataArray></Points><Cells>",
    "<DataArray type='Int32' Name='connectivity'>",
    "0 1 2 3 4 5 6 7",
    "</DataArray>",
    "<DataArray type='Int32' Name='offsets'> 8 </DataArray>",
    "<DataArray type='Int32' Name='types'> 12 </DataArray>",
    "</Cells><PointData>",
    "<DataArray type='Int32' Name='fixed'>",
    "0 1 2 3 4 5 6 7",
    "</DataArray></PointData>",
    "</Piece></UnstructuredGrid>",
    "</VTKFile>"};

std::string file_with(int line, const std::string& text) {
  std::string result;
  for (int i = 1; i <= static_cast<int>(kLines.size()); ++i) {
    result += (i == line ? text : kLines[i - 1]) + "\n";
  }
  return result;
}

struct Broken {
  int line;  // replaced, from 1; the lines after it stay
  std::string text;
  std::string message;  // what the error starts with
};

void PrintTo(const Broken& broken, std::ostream* out) {
  *out << "line " << broken.line << " \"" << broken.text << '"';
}

class VtuBrokenLine : public testing::TestWithParam<Broken> {};

TEST_P(VtuBrokenLine, IsNamed) {
  const Broken& broken = GetParam();
  EXPECT_EQ(read_error(file_with(0, ""), "in.vtu"), "");
  EXPECT_THAT(read_error(file_with(broken.line, broken.text), "in.vtu"),
              testing::StartsWith("in.vtu:" + broken.message));
}

const std::string kRoot = "<VTKFile type='UnstructuredGrid' ";
const std::string kFixed = "<DataArray Name='fixed' type='Int32' ";

INSTANTIATE_TEST_SUITE_P(
    Root, VtuBrokenLine,
    testing::Values(
        Broken{2, "<VTK type='UnstructuredGrid'>",
               "20: expected XML, found an error in it: start-end"},
        Broken{2, "<VTKFile type='PolyData'>",
               "2: expected a VTK file of type \"UnstructuredGrid\", found \"PolyData\""},
        Broken{2, "<VTKFile>", "2: expected a VTK file of type \"UnstructuredGrid\", found \"\""},
        Broken{2, kRoot + "version='3.0'>", "2: expected a version from 0.1 to 2.x, found \"3.0\""},
        Broken{2, kRoot + "version='12'>", "2: expected a version from 0.1 to 2.x, found \"12\""},
        Broken{2, kRoot + "byte_order='Middle'>",
               "2: expected a byte_order of LittleEndian or BigEndian, found \"Middle\""},
        Broken{2, kRoot + "header_type='Int8'>",
               "2: expected a header_type of UInt32 or UInt64, found \"Int8\""},
        Broken{4, "<Piece NumberOfPoints='8' NumberOfCells='1", "6: expected XML, found an error"},
        Broken{4, "<Piece NumberOfPoints='8'>",
               "4: expected NumberOfCells in [0, 178956970], found no such attribute"},
        Broken{4, "<Piece NumberOfPoints='-8' NumberOfCells='1'>",
               "4: expected NumberOfPoints in [0, 1073741823], found \"-8\""},
        Broken{4, "<Piece NumberOfPoints='8 9' NumberOfCells='1'>",
               "4: expected NumberOfPoints in [0, 1073741823], found \"8 9\""},
        Broken{4, "<Piece NumberOfPoints='8' NumberOfCells='99999999999999999999'>",
               "4: expected NumberOfCells in [0, 178956970], found \"99999999999999999999\""},
        Broken{4, "<Piece NumberOfPoints='8' NumberOfCells='0'>",
               "3: expected hexahedra, found none"},
        Broken{4, "<Piece NumberOfPoints='1000000000' NumberOfCells='1'>",
               "8: expected a number (25 of 3000000000 of Points), found the end of the array"},
        Broken{4, "<Piece NumberOfPoints='8' NumberOfCells='100000000'>",
               "13: expected an integer (2 of 100000000 of offsets), found the end of the array"},
        Broken{4, "<Piece NumberOfPoints='7' NumberOfCells='1'>",
               "8: expected the end of Points after 21 numbers, found \"0\""},
        Broken{20, "</VTKFil>",
               "20: expected XML, found an error in it: start-end tags mismatch"}));

INSTANTIATE_TEST_SUITE_P(
    PointsAndCells, VtuBrokenLine,
    testing::Values(
        Broken{5, "<Points/><Points>",
               "5: expected an element <DataArray> in <Points>, found none"},
        Broken{6, "<DataArray type='Float64' NumberOfComponents='2'>",
               "6: Points: expected 3 coordinates a point, found 2 of type Float64"},
        Broken{6, "<DataArray type='Bit'>",
               "6: Points: expected 3 coordinates a point, found 3 of type Bit"},
        Broken{6, "<DataArray type='double'>",
               "6: Points: expected a type of numbers, found \"double\""},
        Broken{7, "0 0 0 1 0 0 1 1 0 0 l 0",
               "7: expected a number (11 of 24 of Points), found \"l\""},
        Broken{7, "0 0 0 1 0 0 1 1 0 0 <!-- --> 1 0",
               "6: expected text without comments, found several pieces of it"},
        Broken{7, "0 0 0 1 0 0 1 1 0 0 nan 0",
               "7: expected finite coordinates, found another value at point 3"},
        Broken{8, "0 0 1 1 0 1 1 1 1 0 1 -Infinity",
               "8: expected finite coordinates, found another value at point 7"},
        Broken{9, "</DataArray></Points><Cells/><Cells>",
               "9: expected a DataArray \"offsets\" in <Cells>, found none"},
        Broken{10, "<DataArray type='Int32' Name='corners'>",
               "9: expected a DataArray \"connectivity\" in <Cells>, found none"},
        Broken{10, "<DataArray type='Float32' Name='connectivity'>",
               "10: connectivity: expected a type of integers, found \"Float32\""},
        Broken{11, "0 1 2 3\n4 5 6 8", "11: cell 0 uses vertex 8, expected one of [0, 7]"},
        Broken{11, "0 1 2 3 4 5 6 -1", "11: cell 0 uses vertex -1, expected one of [0, 7]"},
        Broken{11, "0 1 2 3 4 5 6 6", "11: cell 0 uses vertex 6 twice, expected 8 different ones"},
        Broken{11, "0 1 2 3 4 5 6",
               "11: expected an integer (8 of 8 of connectivity), found the end"},
        Broken{11, "",
               "10: expected an integer (1 of 8 of connectivity), found the end of the array"},
        Broken{13, "<DataArray type='Int32' Name='offsets'> 4 </DataArray>",
               "11: expected the end of connectivity after 4 numbers, found \"4\""},
        Broken{13, "<DataArray type='Int32' Name='offsets'> -1 </DataArray>",
               "13: expected an offset in [0, 1099511627776], found -1"},
        Broken{13, "<DataArray type='Int64' Name='offsets'>\n1099511627776</DataArray>",
               "11: expected an integer (9 of 1099511627776 of connectivity), found the end"},
        Broken{14, "<DataArray type='Int32' Name='types'>\n10 </DataArray>",
               "15: expected hexahedra (type 12), found cell 0, a tetrahedron of type 10"},
        Broken{14, "<DataArray type='Int32' Name='types'> 9 </DataArray>",
               "3: expected hexahedra, found none"}));

INSTANTIATE_TEST_SUITE_P(
    Data, VtuBrokenLine,
    testing::Values(
        Broken{16, kFixed + "NumberOfComponents='0'>",
               "16: expected NumberOfComponents in [1, 1000000], found \"0\""},
        Broken{16, kFixed + "NumberOfComponents='2'>",
               "17: expected an integer (9 of 16 of data array \"fixed\"), found the end of"},
        Broken{16, "<DataArray Name='fixed' type='complex'>",
               "16: data array \"fixed\": expected a type of numbers, found \"complex\""},
        Broken{
            16, kFixed + "format='text'>",
            "16: data array \"fixed\": expected a format of ascii, binary or appended, found \"te"},
        Broken{16, kFixed + "format='appended' offset='0'>",
               "16: data array \"fixed\": expected <AppendedData> in the file, found none"},
        Broken{16, kFixed + "format='binary'>%",
               "16: data array \"fixed\": expected 4 bytes as base64, found \"%\""},
        Broken{17, "0 1 2 3 4 5 6 7.5",
               "17: expected an integer (8 of 8 of data array \"fixed\"), found \"7.5\""}));

TEST(VtuMalformed, OtherCompressorsAreRefusedWhereThereAreBinaryData) {
  for (const std::string compressor : {"vtkLZ4DataCompressor", "vtkLZMADataCompressor"}) {
    std::string text = file_with(16, kFixed + "format='binary'>");
    text.replace(text.find("header_type"), 0, "compressor='" + compressor + "' ");
    EXPECT_EQ(read_error(text, "in.vtu"),
              "in.vtu:16: data array \"fixed\": expected data compressed by "
              "vtkZLibDataCompressor or not at all, found \"" +
                  compressor + "\"");
    text.replace(text.find("binary"), 6, "ascii");
    EXPECT_EQ(read_error(text, "in.vtu"), "");
  }
}

// The cube with its data array, which stands in line 16, as base64 of these bytes.
std::string error_with(const std::string& bytes, const std::string& compressor = "") {
  std::string base64;
  detail::append_base64(base64, bytes);
  std::string text = file_with(16, kFixed + "format='binary'>");
  text.replace(text.find("0 1 2 3 4 5 6 7\n</DataArray></PointData>"), 15, base64);
  text.replace(text.find("header_type"), 0, "compressor='" + compressor + "' ");
  return read_error(text, "in.vtu");
}

std::string words(const std::vector<std::uint32_t>& values) {
  std::string bytes;
  for (std::uint32_t value : values) {
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>(value >> 8 * i);
  }
  return bytes;
}

TEST(VtuMalformed, BinaryDataOfAnotherSize) {
  const std::string title = "in.vtu:16: data array \"fixed\": ";
  EXPECT_EQ(error_with(words({32, 0, 1, 2, 3, 4, 5, 6, 7})), "");
  EXPECT_EQ(error_with(words({28, 0, 1, 2, 3, 4, 5, 6})),
            title + "expected 32 bytes, found 28 announced");
  EXPECT_EQ(error_with(words({0xFFFFFFFF, 0})),
            title + "expected 32 bytes, found 4294967295 announced");
  EXPECT_EQ(error_with(words({32, 0, 1, 2, 3, 4, 5, 6})),
            title + "expected 32 bytes, found 28 to the end of the data");
  EXPECT_EQ(error_with("abc"), title + "expected 4 bytes, found 3 to the end of the data");
}

TEST(VtuMalformed, CompressedDataOfAnotherSize) {
  const std::string title = "in.vtu:16: data array \"fixed\": ";
  const auto error_of = [](const std::vector<std::uint32_t>& header, const std::string& blocks) {
    return error_with(words(header) + blocks, "vtkZLibDataCompressor");
  };
  const auto packed = [](std::size_t n) {  // so many zeros
    const std::string zeros(n, '\0');
    uLongf size = compressBound(n);
    std::string result(size, '\0');
    compress(reinterpret_cast<Bytef*>(result.data()), &size,
             reinterpret_cast<const Bytef*>(zeros.data()), n);
    return result.substr(0, size);
  };
  const std::string good = packed(32), bomb = packed(1'000'000);
  const auto size_of = [](const std::string& bytes) {
    return static_cast<std::uint32_t>(bytes.size());
  };
  EXPECT_EQ(error_of({1, 32, 0, size_of(good)}, good), "");
  EXPECT_EQ(error_of({1, 32, 32, size_of(good)}, good), "");
  EXPECT_EQ(error_of({1, 64, 0, size_of(good)}, good),
            title + "expected blocks of 32 bytes in all, found 1 blocks of 64, the last of 64");
  EXPECT_EQ(error_of({0, 0, 0}, ""),
            title + "expected blocks of 32 bytes in all, found 0 blocks of 0, the last of 0");
  EXPECT_EQ(error_of({0xFFFFFFFF, 0xFFFFFFFF, 1}, ""),
            title +
                "expected blocks of 32 bytes in all, found 4294967295 blocks of 4294967295, "
                "the last of 1");
  EXPECT_EQ(error_of({32, 1, 0}, ""), title + "expected 128 bytes, found 0 to the end of the data");
  EXPECT_EQ(error_of({1, 32, 0, size_of(bomb)}, bomb),
            title + "expected a block of 32 bytes compressed by zlib, found " +
                std::to_string(bomb.size()) + " bytes that are none");
  EXPECT_EQ(error_of({1, 32, 0, 5}, "abcde"),
            title + "expected a block of 32 bytes compressed by zlib, found 5 bytes that are none");
  EXPECT_EQ(error_of({1, 32, 0, 1000}, good), title + "expected 1000 bytes, found " +
                                                  std::to_string(good.size()) +
                                                  " to the end of the data");
}

TEST(VtuMalformed, BlocksThatSuchAFileCannotHoldCostNoMemory) {
  std::string text = file_with(4, "<Piece NumberOfPoints='1000000000' NumberOfCells='1'>");
  text.replace(text.find("header_type"), 0, "compressor='vtkZLibDataCompressor' ");
  text.replace(text.find("'Float64'"), 0, "'Float64' format='binary' Name=");
  std::string base64;  // one block of 24 GB
  detail::append_base64(base64, words({6, 4'000'000'000, 0, 4, 4, 4, 4, 4, 4}) + "abcdefgh");
  text.replace(text.find("0 0 0 1"), 0, base64 + "<!-- ");
  text.replace(text.find("1 1 1 1 0 1 1"), 13, "-->");
  EXPECT_EQ(read_error(text, "in.vtu"),
            "in.vtu:6: Points: expected a block of 4000000000 bytes compressed by zlib, found 4 "
            "bytes that are none");
}

TEST(VtuMalformed, AppendedData) {
  const auto error_of = [](const std::string& offset, const std::string& appended) {
    std::string text = file_with(16, kFixed + "offset='" + offset + "'>");
    text.replace(text.find("</UnstructuredGrid>"), 19, "</UnstructuredGrid>\n" + appended);
    return read_error(text, "in.vtu");
  };
  const std::string raw = "<AppendedData encoding='raw'>\n_";
  const std::string data = words({32, 0, 1, 2, 3, 4, 5, 6, 7}), end = "</AppendedData>";
  EXPECT_EQ(error_of("0", raw + data + end), "");
  EXPECT_EQ(error_of("5", raw + "<<&&\n" + data + end + end), "");  // an end tag among the bytes
  EXPECT_EQ(error_of("37", raw + data + end),
            "in.vtu:16: expected offset in [0, 36], found \"37\"");
  EXPECT_EQ(error_of("36", raw + data + end),
            "in.vtu:16: data array \"fixed\": expected 4 bytes, found 0 to the end of the data");
  EXPECT_EQ(error_of("0", raw + data),
            "in.vtu:20: expected </AppendedData>, found the end of the file");
  EXPECT_EQ(error_of("0", "<AppendedData encoding='raw'>\nabc" + end),
            "in.vtu:21: expected \"_\" at the start of the appended data, found \"a\"");
  EXPECT_EQ(error_of("0", "<AppendedData encoding='hex'>\n_abc" + end),
            "in.vtu:20: expected an encoding of raw or base64, found \"hex\"");
  EXPECT_EQ(error_of("0", "<AppendedData/>"),
            "in.vtu:16: data array \"fixed\": expected <AppendedData> in the file, found none");
  EXPECT_EQ(error_of("0", raw + "\n\n" + end + "\n</VTK>"),
            "in.vtu:24: expected XML, found an error in it: start-end tags mismatch");
}

TEST(VtuMalformed, DeepAndForeignXml) {
  std::string deep;
  for (int i = 0; i < 100'000; ++i) deep += "<a>";
  EXPECT_THAT(read_error(deep, "in.vtu"), testing::StartsWith("in.vtu:1: expected XML"));
  EXPECT_EQ(read_error("<a/>", "in.vtu"), "in.vtu:1: expected an element <VTKFile>, found none");
  EXPECT_THAT(read_error("", "in.vtu"), testing::StartsWith("in.vtu:1: expected XML"));
  EXPECT_THAT(read_error("<?xml version='1.0'?><svg/>", "no-extension"),
              testing::StartsWith("no-extension:1: expected the start of a mesh file"));
  EXPECT_EQ(
      read_error("<?xml version='1.0'?>\n<VTKFile type='ImageData'/>", "no-extension"),
      "no-extension:2: expected a VTK file of type \"UnstructuredGrid\", found \"ImageData\"");
  EXPECT_EQ(read_error("<VTKFile type='UnstructuredGrid'/>", "in.vtu"),
            "in.vtu:1: expected an element <UnstructuredGrid>, found none");
  EXPECT_EQ(read_error("<VTKFile type='UnstructuredGrid'><UnstructuredGrid/></VTKFile>", "in.vtu"),
            "in.vtu:1: expected an element <Piece>, found none");
}

}  // namespace
}  // namespace hexweft::test
