// Binary files of OpenVolumeMesh: chunks, encodings, what they keep, and what is wrong with one.
#include <cmath>

#include "tests/io/ovm_samples.h"
#include "tests/io/sample_meshes.h"

namespace hexweft::test {
namespace {

const std::string kHeader = ovmb_header(8, 12, 6, 1);

std::string error_of(const std::string& bytes) { return read_error(bytes, "in.ovmb"); }

void expect_unit_cube(const std::string& bytes) {
  ReadReport report;
  expect_same_mesh(read_hex_mesh_text(bytes, "x", {}, &report), unit_cube());
  EXPECT_EQ(report.format, "ovmb");
}

TEST(Ovmb, IndicesOfAnyWidthAndCoordinatesOfAnyPrecision) {
  for (int width : {1, 2, 4}) {
    expect_unit_cube(kHeader + ovmb_cube_points() + ovmb_cube_topology(width) + kOvmbEndChunk);
  }
  expect_unit_cube(kHeader + ovmb_cube_points<float>() + ovmb_cube_topology() + kOvmbEndChunk);
}

TEST(Ovmb, ChunksMayBeSplitAndIndicesShifted) {
  const auto half_edges = [](int from, int to, int offset) {
    std::vector<int> part(kCubeHalfEdges.begin() + 4 * from, kCubeHalfEdges.begin() + 4 * to);
    for (int& h : part) h -= offset;
    return part;
  };
  expect_unit_cube(kHeader + ovmb_cube_points() + ovmb_rows(1, 2, 0, kCubeEdgeEnds) +
                   ovmb_rows(2, 4, 0, half_edges(0, 4, 0)) +
                   ovmb_rows(2, 4, 4, half_edges(4, 6, 1), 1, 1) +
                   ovmb_rows(3, 6, 0, kCubeHalfFaces) + kOvmbEndChunk);
}

TEST(Ovmb, ValencesMayBeGivenOneByOne) {
  Bytes cells;
  cells.span(0, 1).list({3, 0, 2, 1}).number(0, 8).number(6, 2).list(kCubeHalfFaces);
  expect_unit_cube(ovmb_header(8, 12, 6, 1, 0) + ovmb_cube_points() +
                   ovmb_rows(1, 2, 0, kCubeEdgeEnds) + ovmb_rows(2, 4, 0, kCubeHalfEdges) +
                   ovmb_chunk("TOPO", cells) + kOvmbEndChunk);
}

TEST(Ovmb, ChunksThatAreNotMandatoryAreSkipped) {
  const Bytes anything = Bytes{}.list({1, 2, 3});
  expect_unit_cube(kHeader + ovmb_chunk("WHAT", anything, 0) + ovmb_cube_points() +
                   ovmb_chunk("VERT", anything, 0, 1) + ovmb_cube_topology() + kOvmbEndChunk);
}

TEST(Ovmb, PropertiesDefaultsAndParts) {
  Bytes directory;
  const auto entry = [&](int entity, const char* name, const char* type, const Bytes& value) {
    directory.number(entity, 1).word(name).word(type).word(value.text);
  };
  entry(0, "weight", "d", Bytes{}.reals<double>({0.5}));
  entry(1, "feature", "b", Bytes{}.list({0}));
  entry(0, "flag", "b", Bytes{}.list({0}));
  entry(3, "label", "s32", Bytes{}.word("none"));
  entry(3, "small", "i8", Bytes{}.list({-3}));
  entry(0, "uv", "2f", Bytes{}.reals<float>({0, 0}));
  const std::string parts =
      ovmb_chunk("PROP", Bytes{}.span(2, 2).number(0, 4).reals<double>({7, -0.0})) +
      ovmb_chunk("PROP", Bytes{}.span(0, 12).number(1, 4).list({255, 15})) +
      ovmb_chunk("PROP", Bytes{}.span(0, 8).number(2, 4).list({0b10000101})) +
      ovmb_chunk("PROP", Bytes{}.span(7, 1).number(5, 4).reals<float>({0.25, 0.75}));
  ReadReport report;
  const HexMesh mesh =
      read_hex_mesh_text(kHeader + ovmb_chunk("DIRP", directory) + ovmb_cube_points() +
                             ovmb_cube_topology() + parts + kOvmbEndChunk,
                         "x", {}, &report);
  EXPECT_THAT(report.notes, testing::ElementsAre("property \"feature\" of edges (b) was left out",
                                                 "property \"label\" of cells (s32) was left out"));
  const auto weight = named_property<VertexTag, double>(mesh, "weight");
  const auto flag = named_property<VertexTag, bool>(mesh, "flag");
  const auto uv = named_property<VertexTag, Eigen::VectorXd>(mesh, "uv");
  const std::vector<double> weights{0.5, 0.5, 7, -0.0, 0.5, 0.5, 0.5, 0.5};
  for (VertexHandle v : mesh.vertices()) {
    EXPECT_TRUE(same_bits(weight[v], weights[v.idx])) << v.idx;
    EXPECT_EQ(flag[v], v.idx == 0 || v.idx == 2 || v.idx == 7) << v.idx;
    EXPECT_EQ(uv[v], v.idx == 7 ? Eigen::Vector2d(0.25, 0.75) : Eigen::Vector2d(0, 0)) << v.idx;
  }
  EXPECT_EQ((named_property<CellTag, int>(mesh, "small")[CellHandle(0)]), -3);
}

TEST(Ovmb, ErrorsNameTheByte) {
  const std::string points = ovmb_cube_points(), edges = ovmb_rows(1, 2, 0, kCubeEdgeEnds),
                    faces = ovmb_rows(2, 4, 0, kCubeHalfEdges),
                    cell = ovmb_rows(3, 6, 0, kCubeHalfFaces), end = kOvmbEndChunk;
  EXPECT_EQ(error_of("OVMBx"),
            "in.ovmb: byte 0: expected the start of an .ovmb file (8 bytes), "
            "found 5 bytes");
  EXPECT_EQ(error_of("OVMB\n\r\n\n"),
            "in.ovmb: byte 0: expected the start of an .ovmb file, found something else");
  EXPECT_EQ(error_of(ovmb_header(8, 12, 6, 1, 1)),
            "in.ovmb: byte 11: expected hexahedra, found tetrahedra announced");
  EXPECT_EQ(error_of(ovmb_header(8, 1073741824, 6, 1)),
            "in.ovmb: byte 24: expected a number of elements in [0, 1073741823], found 1073741824");
  EXPECT_EQ(error_of(ovmb_header(1073741823, 1073741823, 1073741823, 178956971)),
            "in.ovmb: byte 40: expected a number of elements in [0, 178956970], found 178956971");
  EXPECT_EQ(error_of(kHeader + points),
            "in.ovmb: byte 272: expected another chunk; the last is \"EOF \" (4 bytes), found 0 "
            "bytes");
  EXPECT_EQ(error_of(kHeader + ovmb_chunk("WHAT", {})),
            "in.ovmb: byte 48: found a mandatory chunk of a kind or version not known");
  EXPECT_EQ(error_of(kHeader + points + points), "in.ovmb: byte 288: expected vertex 8, found 0");
  EXPECT_EQ(error_of(kHeader + points + ovmb_rows(1, 2, 1, {0, 1})),
            "in.ovmb: byte 288: expected edge 0, found 1");
  EXPECT_EQ(error_of(kHeader + points + ovmb_rows(1, 2, 0, {0, 8})),
            "in.ovmb: byte 313: edge 0 uses element 8, expected one of 8");
  EXPECT_EQ(error_of(kHeader + points + edges + ovmb_rows(2, 3, 0, {0, 2, 4})),
            "in.ovmb: byte 365: expected the valence of a face (only hexahedra can be read) 4, "
            "found 3");
  EXPECT_EQ(error_of(kHeader + points + edges + faces + end),
            "in.ovmb: byte 40: expected 1 cells as announced, found 0");
  EXPECT_EQ(
      error_of(kHeader + points + edges + faces + ovmb_rows(3, 6, 0, {0, 2, 4, 6, 8, 8}) + end),
      "in.ovmb: byte 416: cell 0 has half-faces that do not bound a hexahedron");
  EXPECT_EQ(error_of(ovmb_cube() + "x"),
            "in.ovmb: byte 464: expected nothing after the chunk \"EOF \"");
  EXPECT_EQ(error_of(ovmb_cube().substr(0, 300)),
            "in.ovmb: byte 280: expected the length of a chunk in [0, 12], found 48");
  Bytes directory;
  directory.number(0, 1).word("w").word("d").word("1234");
  EXPECT_EQ(error_of(kHeader + ovmb_chunk("DIRP", directory)),
            "in.ovmb: byte 79: expected 1 numbers (8 bytes), found 4 bytes");
  Bytes nan;
  nan.span(0, 1).list({2, 0, 0, 0}).reals<double>({0, std::nan(""), 0});
  EXPECT_EQ(error_of(kHeader + ovmb_chunk("VERT", nan)),
            "in.ovmb: byte 80: expected finite coordinates of vertex 0, found another value");
  std::string compressed = ovmb_cube();
  compressed[48 + 6] = 1;
  EXPECT_EQ(error_of(compressed), "in.ovmb: byte 54: expected the compression 0, found 1");
}

}  // namespace
}  // namespace hexweft::test
