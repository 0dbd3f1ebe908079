// What is wrong with a Gmsh file, and in which line.
#include "tests/io/gmsh_samples.h"

namespace hexweft::test {
namespace {

// Version 2.2; each test replaces one of its lines.
const std::vector<std::string> kLines2{"$MeshFormat",  // 1
                                       "2.2 0 8",
                                       "$EndMeshFormat",
                                       "$Nodes",  // 4
                                       "8",
                                       "1 0 0 0",
                                       "2 1 0 0",
                                       "3 1 1 0",
                                       "4 0 1 0",
                                       "5 0 0 1",
                                       "6 1 0 1",
                                       "7 1 1 1",
                                       "80 0 1 1",
                                       "$EndNodes",
                                       "$Elements",  // 15
                                       "2",
                                       "4 3 2 6 1 1 2 3 4",
                                       "9 5 2 7 1 1 2 3 4 5 6 7 80",
                                       "$EndElements",
                                       "$NodeData",  // 20
                                       "1",
                                       "\"heat\"",
                                       "1 0",
                                       "3 0 1 1",
                                       "80 0.5",
                                       "$EndNodeData"};

// Version 4.1; each test replaces one of its lines.
const std::vector<std::string> kLines4{"$MeshFormat",  // 1
                                       "4.1 0 8",
                                       "$EndMeshFormat",
                                       "$Entities",  // 4
                                       "1 0 0 1",
                                       "2 0 0 0 0",
                                       "1 0 0 0 1 1 1 1 7 0",
                                       "$EndEntities",
                                       "$Nodes",  // 9
                                       "2 8 1 80",
                                       "0 2 0 1",
                                       "1",
                                       "0 0 0",
                                       "3 1 0 7",
                                       "2 3 4 5 6 7 80",
                                       "1 0 0 1 1 0 0 1 0 0 0 1",
                                       "1 0 1 1 1 1 0 1 1",
                                       "$EndNodes",
                                       "$Elements",  // 19
                                       "1 1 1 1",
                                       "3 1 5 1",
                                       "9 1 2 3 4 5 6 7 80",
                                       "$EndElements"};

struct Broken {
  int line;  // replaced, from 1; the lines after it stay
  std::string text;
  std::string message;
};

void PrintTo(const Broken& broken, std::ostream* out) {
  *out << "line " << broken.line << " \"" << broken.text << '"';
}

std::string file_with(const std::vector<std::string>& lines, int line, const std::string& text) {
  std::string result;
  for (int i = 1; i <= static_cast<int>(lines.size()); ++i) {
    result += (i == line ? text : lines[i - 1]) + "\n";
  }
  return result;
}

std::string error_of(const std::string& text) { return read_error(text, "in.msh"); }

class GmshBrokenLine2 : public testing::TestWithParam<Broken> {};
class GmshBrokenLine4 : public testing::TestWithParam<Broken> {};

TEST_P(GmshBrokenLine2, IsNamed) {
  const Broken& broken = GetParam();
  EXPECT_EQ(error_of(file_with(kLines2, broken.line, broken.text)), "in.msh:" + broken.message);
}

TEST_P(GmshBrokenLine4, IsNamed) {
  const Broken& broken = GetParam();
  EXPECT_EQ(error_of(file_with(kLines4, broken.line, broken.text)), "in.msh:" + broken.message);
}

TEST(GmshMalformed, TheWholeFilesAreGood) {
  EXPECT_EQ(error_of(file_with(kLines2, 0, "")), "");
  EXPECT_EQ(error_of(file_with(kLines4, 0, "")), "");
}

INSTANTIATE_TEST_SUITE_P(
    Every, GmshBrokenLine2,
    testing::Values(
        Broken{1, "$NOD", "1: expected $MeshFormat, found \"$NOD\""},
        Broken{1, "solid", "1: expected $MeshFormat, found \"solid\""},
        Broken{2, "1.0 0 8", "2: expected a version from 2.0 to 2.2, 4.0 or 4.1, found \"1.0\""},
        Broken{2, "3 0 8", "2: expected a version from 2.0 to 2.2, 4.0 or 4.1, found \"3\""},
        Broken{2, "x 0 8", "2: expected a version from 2.0 to 2.2, 4.0 or 4.1, found \"x\""},
        Broken{2, "2.2 2 8", "2: expected 0 for text or 1 for binary, found \"2\""},
        Broken{2, "2.2 1 4", "2: expected a data size of 8 bytes, found \"4\""},
        Broken{2, "2.2 0", "3: expected a data size, found \"$EndMeshFormat\""},
        Broken{2, "2.2 0 8 1", "2: expected $EndMeshFormat, found \"1\""},
        Broken{3, "", "4: expected $EndMeshFormat, found \"$Nodes\""},
        Broken{4, "$Points", "4: expected $EndPoints after $Points, found the end of the file"},
        Broken{4, "Nodes", "4: expected the start of a section, found \"Nodes\""},
        Broken{5, "-1", "5: expected the number of nodes in [0, 1073741823], found \"-1\""},
        Broken{5, "9",
               "14: expected the tag, 1 or more, of node 9 in the file, found \"$EndNodes\""},
        Broken{5, "7", "13: expected $EndNodes, found \"80\""},
        Broken{5, "1000000000",
               "14: expected the tag, 1 or more, of node 9 in the file, found \"$EndNodes\""},
        Broken{6, "0 0 0 0", "6: expected the tag, 1 or more, of node 1 in the file, found \"0\""},
        Broken{7, "2 1 0 x", "7: expected a finite coordinate of node 2, found \"x\""},
        Broken{7, "2 1 0 nan", "7: expected a finite coordinate of node 2, found \"nan\""},
        Broken{13, "80 0 1 1e400", "13: expected a finite coordinate of node 80, found \"1e400\""},
        Broken{13, "3 0 1 1", "13: node 3 appears twice"},
        Broken{14, "", "15: expected $EndNodes, found \"$Elements\""},
        Broken{15, "$Nodes", "15: $Nodes appears twice"},
        Broken{16, "1", "18: expected $EndElements, found \"9\""},
        Broken{16, "3",
               "19: expected the tag, 1 or more, of element 3 of 3, found \"$EndElements\""},
        Broken{16, "500000000",
               "16: expected the number of elements in [0, 178956970], found \"500000000\""},
        Broken{17, "x 3 2 6 1 1 2 3 4",
               "17: expected the tag, 1 or more, of element 1 of 2, found \"x\""},
        Broken{17, "4 4 2 6 1 1 2 3 4",
               "17: expected hexahedra of 8 nodes (type 5), found element 4, a tetrahedron of type "
               "4"},
        Broken{17, "4 12 2 6 1 1 2 3 4",
               "17: expected hexahedra of 8 nodes (type 5), found element 4, a hexahedron of 27 "
               "nodes of type 12"},
        Broken{17, "4 99 2 6 1 1 2 3 4",
               "17: expected hexahedra of 8 nodes (type 5), found element 4, one of type 99"},
        Broken{17, "4 x 2 6 1", "17: expected the type of element 4, found \"x\""},
        Broken{17, "4 3 -2 6 1", "17: expected the number of tags of element 4, found \"-2\""},
        Broken{17, "4 3 2 6 1.5", "17: expected a tag (an integer) of element 4, found \"1.5\""},
        Broken{17, "4 3 2 6 1 1 2 3 x", "17: expected the tag of a node of element 4, found \"x\""},
        Broken{18, "9 5 2 7 1 1 2 3 4 5 6 7",
               "19: expected the tag of a node of element 9, found \"$EndElements\""},
        Broken{18, "9 5 2 7 1 1 2 3 4 5 6 7 8",
               "18: element 9 uses node 8, which $Nodes does not have"},
        Broken{18, "9 5 2 7 1 1 2 3 4 5 6 80 80",
               "18: element 9 uses node 80 twice, expected 8 different ones"},
        Broken{18, "9 3 2 7 1 1 2 3 4", "15: expected hexahedra (type 5) in $Elements, found none"},
        Broken{19, "", "20: expected $EndElements, found \"$NodeData\""},
        Broken{21, "-1", "21: expected the number of text tags in [0, 1000], found \"-1\""},
        Broken{23, "x 0", "23: expected the number of real tags in [0, 1000], found \"x\""},
        Broken{23, "1 x", "23: expected a real tag, found \"x\""},
        Broken{24, "2 0 1", "24: expected the number of integer tags in [3, 1000], found \"2\""},
        Broken{24, "3 x 1 1", "24: expected the time step, found \"x\""},
        Broken{24, "3 0 -1 1", "24: expected the number of components, found \"-1\""},
        Broken{24, "3 0 1 -1", "24: expected the number of rows, found \"-1\""},
        Broken{24, "3 0 1 2",
               "26: expected the tag of row 2 of 2 of data \"heat\", found \"$EndNodeData\""},
        Broken{24, "4 0 1 1", "25: expected the tag of row 1 of 1 of data \"heat\", found \"0.5\""},
        Broken{25, "8 0.5", "25: data \"heat\" have a value of node 8, which $Nodes does not have"},
        Broken{25, "80 x", "25: expected the value of node 80 of data \"heat\", found \"x\""},
        Broken{25, "80 1 2", "25: expected $EndNodeData, found \"2\""},
        Broken{26, "", "25: expected $EndNodeData, found the end of the file"}));

INSTANTIATE_TEST_SUITE_P(
    Every, GmshBrokenLine4,
    testing::Values(
        Broken{5, "1 0 0 -1", "5: expected the number of volumes, found \"-1\""},
        Broken{5, "1 0 0 2", "8: expected the tag of a volume, found \"$EndEntities\""},
        Broken{7, "1 0 0 0 1 1 1 1 7",
               "8: expected the number of bounds of volume 1, found \"$EndEntities\""},
        Broken{7, "1 0 0 0 1 1 x 1 7 0", "7: expected the bounding box of volume 1, found \"x\""},
        Broken{7, "1 0 0 0 1 1 1 1 y 0", "7: expected a physical group of volume 1, found \"y\""},
        Broken{7, "1 0 0 0 1 1 1 1 7 0 5", "7: expected $EndEntities, found \"5\""},
        Broken{8, "", "9: expected $EndEntities, found \"$Nodes\""},
        Broken{10, "3 8 1 80",
               "18: expected the dimension of a block in [0, 3], found \"$EndNodes\""},
        Broken{10, "2 9 1 80", "9: $Nodes: expected 9 nodes, found 8 in its blocks"},
        Broken{10, "2 7 1 80", "14: expected at most 6 nodes in a block, found \"7\""},
        Broken{10, "2 8 1", "13: expected the tag, 1 or more, of node 1 in the file, found \"0\""},
        Broken{11, "4 2 0 1", "11: expected the dimension of a block in [0, 3], found \"4\""},
        Broken{11, "0 2 2 1", "11: expected 0 or 1 for nodes with parameters, found \"2\""},
        Broken{13, "0 0 inf", "13: expected a finite coordinate of node 1, found \"inf\""},
        Broken{15, "2 3 4 5 6 7 7", "15: node 7 appears twice"},
        Broken{20, "2 1 1 1",
               "23: expected the dimension of a block in [0, 3], found \"$EndElements\""},
        Broken{20, "1 2 1 1", "19: $Elements: expected 2 elements, found 1 in its blocks"},
        Broken{20, "1 0 1 1", "21: expected at most 0 elements in a block, found \"1\""},
        Broken{21, "3 1 6 1",
               "22: expected hexahedra of 8 nodes (type 5), found element 9, a prism of type 6"},
        Broken{22, "9 1 2 3 4 5 6 7 8", "22: element 9 uses node 8, which $Nodes does not have"},
        Broken{22, "0 1 2 3 4 5 6 7 80",
               "22: expected the tag, 1 or more, of an element, found \"0\""}));

TEST(GmshMalformed, MissingSections) {
  const std::string format = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
  EXPECT_EQ(error_of(""), "in.msh:1: expected $MeshFormat, found the end of the file");
  EXPECT_EQ(error_of("$Comments\n$EndComments\n"),
            "in.msh:2: expected $MeshFormat, found the end of the file");
  EXPECT_EQ(error_of(format), "in.msh:3: expected $Nodes, found the end of the file");
  EXPECT_EQ(error_of("$Nodes\n$EndNodes\n" + format),
            "in.msh:1: expected $MeshFormat, found \"$Nodes\"");
  EXPECT_EQ(error_of(format + "$Nodes\n0 0 0 0\n$EndNodes\n"),
            "in.msh:6: expected $Elements, found the end of the file");
  EXPECT_EQ(error_of(format + "$Nodes\n0 0 0 0\n$EndNodes\n$Elements\n0 0 0 0\n$EndElements\n"),
            "in.msh:7: expected hexahedra (type 5) in $Elements, found none");
}

TEST(GmshMalformed, BinaryNamesTheHeaderOfTheSection) {
  const std::string whole = write_hex_mesh_text(unit_cube(), {.format = "gmsh", .binary = true});
  EXPECT_EQ(error_of(whole), "");
  const auto with = [&](std::size_t at, const std::string& bytes) {
    return std::string(whole).replace(at, bytes.size(), bytes);
  };
  const std::size_t marker = whole.find("8\n") + 2, node = whole.find("8\n", marker) + 2;
  const std::size_t block = whole.find("$Elements\n1\n") + 12;
  const std::string none(4, '\0'), infinite("\0\0\0\0\0\0\xf0\x7f", 8);
  EXPECT_EQ(error_of(with(marker, "\2")),
            "in.msh:1: $MeshFormat: expected the number 1 that tells the byte order, found 2");
  EXPECT_EQ(error_of(with(node, none)),
            "in.msh:5: $Nodes: expected the tag, 1 or more, of node 1 in the file, found 0");
  EXPECT_EQ(error_of(with(node + 4, infinite)),
            "in.msh:5: $Nodes: expected a finite coordinate of node 1, found inf");
  EXPECT_EQ(
      error_of(with(node - 2, "9")),
      "in.msh:5: $Nodes: expected the tag, 1 or more, of node 9 in the file, found the end of "
      "the section");
  EXPECT_EQ(error_of(with(node - 2, "7")),
            "in.msh:5: $Nodes: expected $EndNodes, found 29 bytes before it");
  EXPECT_EQ(error_of(with(block, "\4")),
            "in.msh:9: expected hexahedra of 8 nodes (type 5), found element 1, a tetrahedron of "
            "type 4");
  EXPECT_EQ(error_of(with(block + 4, "\2")),
            "in.msh:9: $Elements: expected at most 1 elements in a block, found 2");
}

TEST(GmshMalformed, TruncatedAnywhereIsAnError) {
  for (const char* version : kGmshVersions) {
    for (GmshCoding coding : kGmshCodings) {
      const std::string whole = gmsh_tower(version, coding);
      for (std::size_t n = 0; n + 1 < whole.size(); ++n) {
        // Between two sections of data nothing is missing that a reader could know of.
        const bool ends_a_section = whole.substr(0, n).ends_with("$EndElements") ||
                                    whole.substr(0, n).ends_with("$EndElements\n") ||
                                    whole.substr(0, n).ends_with("$EndNodeData") ||
                                    whole.substr(0, n).ends_with("$EndNodeData\n");
        if (ends_a_section) continue;
        EXPECT_THAT(error_of(whole.substr(0, n)), testing::StartsWith("in.msh:")) << n << " bytes";
      }
    }
  }
}

}  // namespace
}  // namespace hexweft::test
