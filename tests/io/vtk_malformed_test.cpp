// What is wrong with a legacy VTK file, and in which line.
#include "tests/io/sample_meshes.h"

namespace hexweft::test {
namespace {

// Lines 1 to 17; each test replaces one of them.
const std::vector<std::string> kLines{"# vtk DataFile Version 3.0",
                                      "title",
                                      "ASCII",
                                      "DATASET UNSTRUCTURED_GRID",
                                      "POINTS 8 double",
                                      "0 0 0 1 0 0",
                                      "1 1 0 0 1 0",
                                      "0 0 1 1 0 1",
                                      "1 1 1 0 1 1",
                                      "CELLS 1 9",
                                      "8 0 1 2 3 4 5 6 7",
                                      "CELL_TYPES 1",
                                      "12",
                                      "POINT_DATA 8",
                                      "SCALARS fixed int 1",
                                      "LOOKUP_TABLE default",
                                      "0 1 2 3 4 5 6 7"};

struct Broken {
  int line;  // replaced, from 1; the lines after it stay
  std::string text;
  std::string message;  // what the error starts with
};

void PrintTo(const Broken& broken, std::ostream* out) {
  *out << "line " << broken.line << " \"" << broken.text << '"';
}

std::string file_with(int line, const std::string& text) {
  std::string result;
  for (int i = 1; i <= static_cast<int>(kLines.size()); ++i) {
    result += (i == line ? text : kLines[i - 1]) + "\n";
  }
  return result;
}

class VtkBrokenLine : public testing::TestWithParam<Broken> {};

TEST_P(VtkBrokenLine, IsNamed) {
  const Broken& broken = GetParam();
  EXPECT_THAT(read_error(file_with(broken.line, broken.text)), testing::StartsWith(broken.message));
}

INSTANTIATE_TEST_SUITE_P(
    Every, VtkBrokenLine,
    testing::Values(
        Broken{1, "# vtk DataFile", "in.vtk:1: expected \"# vtk DataFile Version\" and a number"},
        Broken{1, "# vtk DataFile Version 6.0", "in.vtk:1: expected a version from 1.0 to 5.1"},
        Broken{3, "TEXT", "in.vtk:3: expected ASCII or BINARY, found \"TEXT\""},
        Broken{4, "DATASET POLYDATA", "in.vtk:4: expected UNSTRUCTURED_GRID, found \"POLYDATA\""},
        Broken{5, "POINTS eight double", "in.vtk:5: expected a number of points"},
        Broken{5, "POINTS -8 double", "in.vtk:5: expected a number of points in [0,"},
        Broken{5, "POINTS 99999999999999999999 double", "in.vtk:5: expected a number of points"},
        Broken{5, "POINTS 1000000000 double",
               "in.vtk:10: expected a number (25 of 3000000000 of POINTS)"},
        Broken{5, "POINTS 8 complex",
               "in.vtk:5: expected a type of coordinates, found \"complex\""},
        Broken{5, "POINTS 7 double", "in.vtk:9: expected a section"},
        Broken{5, "POINTS 9 double",
               "in.vtk:10: expected a number (25 of 27 of POINTS), found \"CELLS\""},
        Broken{7, "1 1 0 0 l 0", "in.vtk:7: expected a number (11 of 24 of POINTS), found \"l\""},
        Broken{7, "1 1 0 0 nan 0",
               "in.vtk:7: expected finite coordinates, found another value at point 3"},
        Broken{8, "0 0 1 1 -inf 1", "in.vtk:8: expected finite coordinates"},
        Broken{8, "0 0 1 1 1e999 1", "in.vtk:8: expected finite coordinates"},
        Broken{10, "POINTS 0 double", "in.vtk:10: POINTS appears twice"},
        Broken{10, "CELLS 1 8", "in.vtk:11: cell 0 of 1 does not fit the announced 8 numbers"},
        Broken{10, "CELLS 1 10", "in.vtk:12: expected an integer (10 of 10 of CELLS)"},
        Broken{10, "CELLS 1 1099511627776", "in.vtk:12: expected an integer (10 of"},
        Broken{10, "CELLS 2 9", "in.vtk:12: cell 1 of 2 does not fit"},
        Broken{10, "CELLS 0 9",
               "in.vtk:10: CELLS: expected 0 numbers for 0 cells, found 9 announced"},
        Broken{10, "CELLS 2000000000 9", "in.vtk:10: expected a number of cells in [0,"},
        Broken{11, "8 0 1 2 3 4 5 6 8", "in.vtk:11: cell 0 uses vertex 8, expected one of [0, 7]"},
        Broken{11, "8 0 1 2 3 4 5 6 -1",
               "in.vtk:11: cell 0 uses vertex -1, expected one of [0, 7]"},
        Broken{11, "8 0 1 2 3 4 5 6 4294967296", "in.vtk:11: cell 0 uses vertex 4294967296"},
        Broken{11, "8 0 1 2 3 4 5 6 6", "in.vtk:11: cell 0 uses vertex 6 twice"},
        Broken{11, "8 0 1 2 3 4 5 6 7.5", "in.vtk:11: expected an integer (9 of 9 of CELLS)"},
        Broken{11, "7 0 1 2 3 4 5 6 7", "in.vtk:10: CELLS: expected 8 numbers for 1 cells"},
        Broken{11, "-8 0 1 2 3 4 5 6 7", "in.vtk:11: cell 0 of 1 does not fit"},
        Broken{12, "CELL_TYPES 2", "in.vtk:12: expected types of 1 cells, found 2 announced"},
        Broken{13, "10",
               "in.vtk:13: expected hexahedra (type 12), found cell 0, a tetrahedron of type 10"},
        Broken{13, "99",
               "in.vtk:13: expected hexahedra (type 12), found cell 0, a cell of type 99"},
        Broken{13, "9", "in.vtk:12: expected hexahedra, found none"},
        Broken{13, "", "in.vtk:14: expected an integer (1 of 1 of CELL_TYPES)"},
        Broken{14, "POINT_DATA 9", "in.vtk:14: expected data of 8 points, found 9"},
        Broken{14, "CELL_DATA 2", "in.vtk:14: expected data of 1 cells, found 2"},
        Broken{14, "", "in.vtk:15: expected a section of an unstructured grid, found \"SCALARS\""},
        Broken{15, "SCALARS fixed integer 1", "in.vtk:15: expected a type of numbers"},
        Broken{15, "SCALARS fixed int 0",
               "in.vtk:15: expected a number of components, found \"0\""},
        Broken{15, "SCALARS fixed int 2", "in.vtk:17: expected an integer (9 of 16 of data array"},
        Broken{15, "FIELD f 1\nfixed 1 9 int",
               "in.vtk:16: data array \"fixed\": expected 8 rows, found 9"},
        Broken{15, "FIELD f 1\nfixed -1 8 int", "in.vtk:16: expected a number of components"},
        Broken{15, "MATRICES m int",
               "in.vtk:15: expected a section of point or cell data, found \"MATRICES\""},
        Broken{17, "0 1 2 3 4 5 6 x",
               "in.vtk:17: expected an integer (8 of 8 of data array \"fixed\")"},
        Broken{17, "0 1 2 3 4 5 6 7 8",
               "in.vtk:17: expected a section of point or cell data, found \"8\""}));

TEST(VtkMalformed, TruncatedAnywhereIsAnError) {
  const std::string whole = file_with(0, "");
  const std::size_t end_of_types = whole.find("POINT_DATA") - 1;
  int errors = 0;
  for (std::size_t n = 0; n < whole.size(); ++n) {
    const std::string error = read_error(whole.substr(0, n));
    if (n < end_of_types - 1) {
      EXPECT_THAT(error, testing::StartsWith("in.vtk:")) << "after " << n << " bytes";
    }
    errors += !error.empty();
  }
  EXPECT_GT(errors, static_cast<int>(end_of_types) - 2);
  EXPECT_EQ(read_error(whole), "");
}

TEST(VtkMalformed, EmptyAndForeignFiles) {
  EXPECT_THAT(read_error(""), testing::StartsWith("in.vtk:1: expected"));
  EXPECT_THAT(read_error("\n\n\n"), testing::StartsWith("in.vtk:1: expected"));
  EXPECT_THAT(read_error("solid part", "part"), testing::StartsWith("part:1: expected the start"));
  EXPECT_THAT(read_error(std::string(1000, '\0')), testing::StartsWith("in.vtk:1: expected"));
}

TEST(VtkMalformed, SectionsInTheWrongOrder) {
  const std::string head = "# vtk DataFile Version 3.0\nx\nASCII\n";
  EXPECT_EQ(read_error(head + "DATASET UNSTRUCTURED_GRID\nCELLS 0 0\n"),
            "in.vtk:5: expected POINTS before CELLS");
  EXPECT_EQ(read_error(head + "DATASET UNSTRUCTURED_GRID\nPOINTS 0 int\nCELL_TYPES 0\n"),
            "in.vtk:6: expected CELLS before CELL_TYPES");
  EXPECT_EQ(read_error(head + "DATASET UNSTRUCTURED_GRID\nPOINTS 0 int\nCELLS 0 0\nCELL_TYPES 0\n"),
            "in.vtk:7: expected hexahedra, found none");
  EXPECT_EQ(read_error(head + "DATASET UNSTRUCTURED_GRID\nPOINTS 0 int\n"),
            "in.vtk:5: expected CELLS, found the end of the file");
}

TEST(VtkMalformed, OffsetsThatDoNotFit) {
  const auto error_with = [](const std::string& cells) {
    return read_error(
        "# vtk DataFile Version 5.1\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 int\n"
        "0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1\n" +
        cells + "\nCELL_TYPES 1\n12\n");
  };
  const std::string corners = "CONNECTIVITY vtktypeint64\n0 1 2 3 4 5 6 7";
  EXPECT_EQ(error_with("CELLS 2 8\nOFFSETS vtktypeint64\n0 8\n" + corners), "");
  EXPECT_EQ(error_with("CELLS 2 8\nOFFSETS vtktypeint64\n1 8\n" + corners),
            "in.vtk:9: expected an offset in [0, 0], found 1");
  EXPECT_EQ(error_with("CELLS 2 8\nOFFSETS vtktypeint64\n0 9\n" + corners),
            "in.vtk:9: expected an offset in [0, 8], found 9");
  EXPECT_EQ(error_with("CELLS 2 8\nOFFSETS vtktypeint64\n0\n7\n" + corners),
            "in.vtk:8: expected the last offset to be 8, found 7");
  EXPECT_EQ(error_with("CELLS 2 8\nOFFSETS double\n0 8\n" + corners),
            "in.vtk:8: expected a type of integers, found \"double\"");
  EXPECT_EQ(error_with("CELLS 2 8\nOFFSETS vtktypeint64\n0 8\n0 1 2 3 4 5 6 7"),
            "in.vtk:10: expected CONNECTIVITY, found \"0\"");
}

TEST(VtkMalformed, BinaryBlocksNameTheirHeader) {
  const std::string whole = write_hex_mesh_text(unit_cube(), {.binary = true});
  EXPECT_EQ(
      read_error(whole.substr(0, 200)),
      "in.vtk:5: POINTS: expected 24 numbers of type double, found 13 to the end of the file");
  std::string lying = whole;
  lying.replace(lying.find("POINTS 8"), 8, "POINTS 800000000");
  EXPECT_THAT(read_error(lying),
              testing::StartsWith("in.vtk:5: POINTS: expected 2400000000 numbers"));
}

}  // namespace
}  // namespace hexweft::test
