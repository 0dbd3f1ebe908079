// Surfaces of triangle files: every format, and what is wrong with one.
#include "io/surface_io.h"

#include <cmath>

#include <Eigen/Geometry>

#include "tests/io/mutate.h"

namespace hexweft::test {
namespace {

std::string error_of(const std::string& name, const std::string& content) {
  try {
    read_surface_mesh_text(content, name);
  } catch (const FormatError& error) {
    return error.what();
  }
  return "read";
}

// The cube of side 1 in quadrilaterals, counter-clockwise from outside.
const std::string kPoints = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n";
const std::string kFaces = "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";
const std::string kOff = "OFF\n8 6 0\n" + kPoints + kFaces;
const std::string kObj =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
const std::string kPlyHeader =
    "element vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 6\nproperty list uchar int vertex_indices\nend_header\n";
const std::string kPly = "ply\nformat ascii 1.0\n" + kPlyHeader + kPoints + kFaces;
const std::string kStl =
    "solid x y\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
    "endfacet\nfacet normal nan nan nan\nouter loop\nvertex 0 1 0\nvertex 1 0 -0\nvertex 1 1 0\n"
    "endloop\nendfacet\nendsolid x y\n";

template <class Number>
void put(std::string& out, Number value, bool big) {
  std::string bytes(sizeof(value), '\0');
  std::memcpy(bytes.data(), &value, sizeof(value));
  if (big) std::reverse(bytes.begin(), bytes.end());
  out += bytes;
}

std::string binary_ply(bool big) {
  std::string text = std::string("ply\r\nformat binary_") + (big ? "big" : "little") +
                     "_endian 1.0\r\ncomment by hand\r\nelement weight 1\r\nproperty list uint8 "
                     "double w\r\n" +
                     kPlyHeader;
  text += '\2';
  for (double w : {0.5, 10.0}) put(text, w, big);  // with bytes that look like ends of lines
  std::istringstream points(kPoints), faces(kFaces);
  for (float x; points >> x;) put(text, x, big);
  for (std::int32_t n; faces >> n;) {
    text += static_cast<char>(n);
    for (std::int32_t v; n > 0 && faces >> v; --n) put(text, v, big);
  }
  return text;
}

std::string binary_stl(const std::string& header) {
  const float square[2][12] = {{0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 1, 0},
                               {0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 1, 0}};
  std::string content = header;
  content.resize(80, header.empty() ? '\0' : ' ');
  content += std::string("\2\0\0\0", 4);
  for (const auto& triangle : square) {
    content.append(reinterpret_cast<const char*>(triangle), sizeof(triangle));
    content.append(2, '\0');
  }
  return content;
}

/// Six times the volume enclosed; positive if the triangles are counter-clockwise from outside.
double volume(const SurfaceMesh& s) {
  double sum = 0;
  for (const auto& t : s.triangles) {
    sum += s.points.col(t[0]).dot(s.points.col(t[1]).cross(s.points.col(t[2])));
  }
  return sum;
}

TEST(SurfaceFile, EveryFormatGivesTheCube) {
  for (const auto& [name, content] : {std::pair<std::string, std::string>("cube.off", kOff),
                                      {"cube.obj", kObj},
                                      {"CUBE.PLY", kPly},
                                      {"little.ply", binary_ply(false)},
                                      {"big.ply", binary_ply(true)}}) {
    SCOPED_TRACE(name);
    const SurfaceMesh surface = read_surface_mesh_text(content, name);
    EXPECT_EQ(surface.triangles.size(), 12u);
    ASSERT_EQ(surface.points.cols(), 8);
    for (int i = 0; i < 8; ++i) {
      const auto& x = kCornerCoords[i];
      EXPECT_EQ(surface.points.col(i), Eigen::Vector3d(x[0], x[1], x[2]));
    }
    EXPECT_NEAR(volume(surface), 6, 1e-12);
    EXPECT_THAT(surface.notes, testing::IsEmpty());
  }
}

TEST(SurfaceFile, EqualPointsOfStlAreOne) {
  for (const std::string& content :
       {kStl, binary_stl("solid x"), binary_stl("made by a scanner"), binary_stl("")}) {
    const SurfaceMesh surface = read_surface_mesh_text(content, "t.stl");
    EXPECT_EQ(surface.triangles.size(), 2u);
    EXPECT_EQ(surface.points.cols(), 4);
  }
}

/// The corners of all triangles, one after the other.
Eigen::Matrix3Xd corners(const SurfaceMesh& s) {
  Eigen::Matrix3Xd result(3, 3 * s.triangles.size());
  Eigen::Index n = 0;
  for (const auto& t : s.triangles) {
    for (int v : t) result.col(n++) = s.points.col(v);
  }
  return result;
}

TEST(SurfaceFile, FacesWithPointsOfTheirOwnReadAsThoseThatShareThem) {
  std::ostringstream points, faces, obj;
  std::istringstream numbers(kFaces);
  for (int n = 0, count, v; numbers >> count; n += count) {
    std::ostringstream obj_face;
    faces << count;
    for (int i = n; i < n + count && numbers >> v; ++i) {
      const auto& x = kCornerCoords[v];
      points << x[0] << ' ' << x[1] << ' ' << x[2] << '\n';
      obj << "v " << x[0] << ' ' << x[1] << ' ' << x[2] << '\n';
      faces << ' ' << i;
      obj_face << ' ' << i + 1;
    }
    faces << '\n';
    obj << 'f' << obj_face.str() << '\n';
  }
  const SurfaceMesh shared = read_surface_mesh_text(kOff, "shared.off");
  std::string header = kPlyHeader;
  header.replace(header.find('8'), 1, "24");
  const std::string rows = points.str() + faces.str();
  for (const auto& [name, content] :
       {std::pair<std::string, std::string>("x.off", "OFF\n24 6 0\n" + rows),
        {"x.obj", obj.str()},
        {"x.ply", "ply\nformat ascii 1.0\n" + header + rows}}) {
    SCOPED_TRACE(name);
    const SurfaceMesh own = read_surface_mesh_text(content, name);
    EXPECT_EQ(own.points.cols(), 8);
    EXPECT_EQ(corners(own), corners(shared));
    EXPECT_THAT(own.notes, testing::IsEmpty());
  }
}

TEST(SurfaceFile, CoordinatesKeepTheirDigits) {
  const double x = 1234567.0000012345;
  const std::string row = "1234567.0000012345 0 0\n";
  const std::string rest = "0 1 0\n0 0 1\n";
  EXPECT_EQ(read_surface_mesh_text("OFF 3 1 3\n" + row + rest + "3 0 1 2 0.5 0.5 0.5\n", "a.off")
                .points(0, 0),
            x);
  EXPECT_EQ(
      read_surface_mesh_text("v " + row + "v 0 1 0\nv 0 0 1\nf 1 2 3\n", "a.obj").points(0, 0), x);
}

TEST(SurfaceFile, NumbersOfAnyLayoutInEveryText) {
  const std::string points[] = {"+1 0 1e-330\n", "0 1. 0\n", ".5 0 +1E0\n"};
  const std::string list = points[0] + points[1] + points[2];
  std::string obj, stl = "solid\nfacet normal 0 0 1\nouter loop\n";
  for (const std::string& point : points) obj += "v " + point, stl += "vertex " + point;
  for (const auto& [name, content] :
       {std::pair<std::string, std::string>("x.obj", obj + "f +1 2 -1\n"),
        {"x.off", "OFF\n3 1 0\n" + list + "3 0 +1 2\n"},
        {"x.ply",
         "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
         "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
         "end_header\n" +
             list + "3 0 +1 2\n"},
        {"x.stl", stl + "endloop\nendfacet\nendsolid\n"}}) {
    SCOPED_TRACE(name);
    Eigen::Matrix3d expected;
    expected << 1, 0, 0.5, 0, 1, 0, 0, 0, 1;
    EXPECT_EQ(read_surface_mesh_text(content, name).points, expected);
  }
}

TEST(SurfaceFile, LayoutsOfObj) {
  const SurfaceMesh surface = read_surface_mesh_text(
      "# a comment\r\nmtllib x.mtl\r\no thing\r\nv 0 0 0 1.0\r\nv 1 0 0 0.5 0.5 0.5\r\nvt 0 0\r\n"
      "vn 0 0 1\r\nv 1 \\\r\n 1 0\r\nv 9 9 9\r\nusemtl m\r\nf 1/1/1 2//1 3/1 # a face\r\n"
      "f -4 -2 5\r\nl 1 2\r\nv 0 1 0\r\nf 1 1 2",
      "x.obj");
  EXPECT_EQ(surface.triangles.size(), 2u);
  EXPECT_EQ(surface.points.cols(), 4);
  EXPECT_THAT(surface.notes,
              testing::ElementsAre("1 triangles that use a point twice were left out",
                                   "1 points that no face uses were left out"));
}

TEST(SurfaceFile, LayoutsOfOff) {
  const SurfaceMesh surface = read_surface_mesh_text(
      "COFF # with colours\n3 1\n\n0 0 0 255 0 0 255\n1 0 0 0 0 0 0 # black\n0 1 0 1 1 1 1\n3 0 1 "
      "2 "
      "red\n",
      "x.off");
  EXPECT_EQ(surface.triangles.size(), 1u);
  EXPECT_EQ(surface.points.col(1), Eigen::Vector3d(1, 0, 0));
}

TEST(SurfaceFile, ErrorsNameThePlace) {
  EXPECT_EQ(error_of("no.obj", "hello\n"), "no.obj: expected a surface, found no triangles");
  EXPECT_EQ(error_of("x.obj", "v 0 0 0\nv 0 nan 0\n"),
            "x.obj:2: expected three finite coordinates of point 2, found \"nan\"");
  EXPECT_EQ(error_of("x.obj", "v 0 0\n"),
            "x.obj:1: expected three finite coordinates of point 1, found the end of the line");
  EXPECT_EQ(error_of("x.obj", "v 0 0 0\nf 1 -2 1\n"),
            "x.obj:2: expected the number of a point of face 1, found \"-2\"");
  EXPECT_EQ(error_of("x.obj", "v 0 0 0\nf 1 0 1\n"),
            "x.obj:2: expected the number of a point of face 1, found \"0\"");
  EXPECT_EQ(error_of("x.obj", "v 0 0 0\nf 1 2 1\nf 1 1 7\n"),
            "x.obj:3: expected the number of a point in [1, 1], found 7");
  EXPECT_EQ(error_of("x.obj", "v 0 0 0\nf 1 2\n"),
            "x.obj:2: expected a face of three points or more, found 2");
  EXPECT_EQ(error_of("x.off", ""), "x.off:1: expected OFF, found the end of the file");
  EXPECT_EQ(error_of("x.off", "OFF\n8 7 0\n" + kPoints + kFaces),
            "x.off:16: expected a number of points in [3, 8] of face 6 of 7, found the end of the "
            "file");
  EXPECT_EQ(error_of("x.off", "OFF\n8 5 0\n" + kPoints + kFaces),
            "x.off:16: expected the end of the file after 5 faces, found \"4\"");
  EXPECT_EQ(error_of("x.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 9\n"),
            "x.off:6: expected a point in [0, 2] of face 0 of 1, found \"9\"");
  EXPECT_EQ(error_of("x.off", "OFF\n-1 1 0\n"),
            "x.off:2: expected a number of points in [0, 268435456], found \"-1\"");
  EXPECT_EQ(error_of("x.off", "OFF\n268435456 268435456 0\n0 0 0\n"),
            "x.off:3: expected a finite coordinate of point 1 of 268435456, found the end of the "
            "file");
  EXPECT_EQ(error_of("x.ply", kPly.substr(0, kPly.size() - 12)),
            "x.ply:22: expected a number of face 4 of 6, found the end of the file");
  EXPECT_EQ(error_of("x.ply",
                     "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                     "property float y\nend_header\n0 0\n"),
            "x.ply:7: expected finite coordinates x, y and z of vertex 0 of 1");
  EXPECT_EQ(error_of("x.ply", kPly + "1 2 3\n"),
            "x.ply:24: expected the end of the file, found \"1\"");
  const std::string binary = binary_ply(true);
  EXPECT_THAT(error_of("x.ply", binary.substr(0, binary.size() - 3)),
              testing::MatchesRegex("x.ply: byte [0-9]+: expected more bytes of face 5 of 6"));
  EXPECT_EQ(error_of("x.stl", kStl.substr(0, kStl.find("endsolid"))),
            "x.stl:15: expected facet, found the end of the file");
  EXPECT_EQ(error_of("x.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 x\n"),
            "x.stl:4: expected a finite coordinate of triangle 0, found \"x\"");
  for (const char* header : {"", "solid x"}) {
    const std::string intact = binary_stl(header);
    const std::string expected = "x.stl: expected 184 bytes of 2 triangles, found ";
    EXPECT_EQ(error_of("x.stl", intact.substr(0, 183)), expected + "183 bytes");
    EXPECT_EQ(error_of("x.stl", intact + "\n"), expected + "185 bytes");
  }
  EXPECT_EQ(error_of("x.stl", "hello"), "x.stl:1: expected solid, found \"hello\"");
  EXPECT_EQ(error_of("x.vtk", kOff), "x.vtk: expected a surface: .obj, .off, .ply or .stl");
  EXPECT_THROW(read_surface_mesh("/no/such/file.off"), FormatError);
}

TEST(SurfaceFile, DamagedOnesAreReadOrRefused) {
  const std::vector<std::pair<std::string, std::string>> files{
      {"x.off", kOff}, {"x.obj", kObj},          {"x.ply", kPly},
      {"x.stl", kStl}, {"x.ply", binary_ply(0)}, {"x.stl", binary_stl("")}};
  std::vector<std::string> contents;
  for (const auto& file : files) contents.push_back(file.second);
  int refused = 0;
  for (const auto& [name, intact] : files) {
    for (unsigned seed = 0; seed < 300; ++seed) {
      SCOPED_TRACE(name + ", seed " + std::to_string(seed));
      try {
        const SurfaceMesh surface = read_surface_mesh_text(mutate(intact, contents, seed), name);
        EXPECT_GT(surface.triangles.size(), 0u);
        EXPECT_TRUE(surface.points.allFinite());
        for (const auto& t : surface.triangles) {
          EXPECT_GE(*std::min_element(t.begin(), t.end()), 0);
          EXPECT_LT(*std::max_element(t.begin(), t.end()), surface.points.cols());
        }
      } catch (const FormatError&) {
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 200);
}

TEST(SurfaceExtensions, AreKnownInAnyCase) {
  EXPECT_TRUE(is_surface_file("a.stl"));
  EXPECT_TRUE(is_surface_file("b/c.OBJ"));
  EXPECT_FALSE(is_surface_file("a.vtk"));
  EXPECT_FALSE(is_surface_file("-"));
}

}  // namespace
}  // namespace hexweft::test
