/// \file
/// The one home of how a hexahedron's corners, edges and sides are numbered.
///
/// Corners follow VTK_HEXAHEDRON: 0 to 3 round the bottom, 4 to 7 above. With local axes x, y, z
///
///         7--------6
///        /|       /|        corner  x y z        corner  x y z
///       4--------5 |          0     0 0 0          4     0 0 1
///       | |      | |          1     1 0 0          5     1 0 1
///       | 3------|-2          2     1 1 0          6     1 1 1
///       |/       |/           3     0 1 0          7     0 1 1
///       0--------1
///
/// Edge 4a + i is parallel to axis a and runs in its direction; side 2a + s is where coordinate a
/// is s, its four corners counter-clockwise seen from outside. Triangles of a side are (0,1,2) and
/// (2,3,0) of these four: the surface that every distance in hexweft refers to.
#pragma once

#include <array>

namespace hexweft {

inline constexpr int kCorners = 8, kHexEdges = 12, kSides = 6;

/// Local coordinates (0 or 1) of the corners.
inline constexpr std::array<std::array<int, 3>, 8> kCornerCoords{
    {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};

/// kCornerAt[x][y][z]: the corner with these local coordinates.
inline constexpr int kCornerAt[2][2][2] = {{{0, 4}, {3, 7}}, {{1, 5}, {2, 6}}};

/// Corners of the sides, counter-clockwise from outside.
inline constexpr std::array<std::array<int, 4>, 6> kSideCorners{
    {{3, 0, 4, 7}, {1, 2, 6, 5}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 3, 2, 1}, {4, 5, 6, 7}}};

/// Ends of the edges, in the direction of their axis.
// clang-format off
inline constexpr std::array<std::array<int, 2>, 12> kEdgeCorners{
    {{0, 1}, {3, 2}, {4, 5}, {7, 6},    // along x
     {0, 3}, {1, 2}, {4, 7}, {5, 6},    // along y
     {0, 4}, {1, 5}, {3, 7}, {2, 6}}};  // along z
// clang-format on

/// The corner across an axis: kCornerAcross[corner][axis].
inline constexpr auto kCornerAcross = [] {
  std::array<std::array<int, 3>, 8> t{};
  for (int c = 0; c < 8; ++c) {
    for (int a = 0; a < 3; ++a) {
      auto x = kCornerCoords[c];
      x[a] = 1 - x[a];
      t[c][a] = kCornerAt[x[0]][x[1]][x[2]];
    }
  }
  return t;
}();

/// The three corners joined to a corner by an edge, ordered so that their edge vectors have a
/// positive determinant in a valid hexahedron.
inline constexpr auto kCornerNeighbors = [] {
  std::array<std::array<int, 3>, 8> t{};
  for (int c = 0; c < 8; ++c) {
    const auto& x = kCornerCoords[c];
    const bool even = (x[0] + x[1] + x[2]) % 2 == 0;
    t[c] = {kCornerAcross[c][0], kCornerAcross[c][even ? 1 : 2], kCornerAcross[c][even ? 2 : 1]};
  }
  return t;
}();

/// kEdgeBetween[a][b]: the edge joining corners a and b, -1 where there is none.
inline constexpr auto kEdgeBetween = [] {
  std::array<std::array<int, 8>, 8> t{};
  for (auto& row : t) row.fill(-1);
  for (int e = 0; e < 12; ++e) {
    t[kEdgeCorners[e][0]][kEdgeCorners[e][1]] = e;
    t[kEdgeCorners[e][1]][kEdgeCorners[e][0]] = e;
  }
  return t;
}();

/// The four edges of a side; edge i joins its corners i and i + 1.
inline constexpr auto kSideEdges = [] {
  std::array<std::array<int, 4>, 6> t{};
  for (int s = 0; s < 6; ++s) {
    for (int i = 0; i < 4; ++i) {
      t[s][i] = kEdgeBetween[kSideCorners[s][i]][kSideCorners[s][(i + 1) % 4]];
    }
  }
  return t;
}();

/// The two sides that share an edge.
inline constexpr auto kEdgeSides = [] {
  std::array<std::array<int, 2>, 12> t{};
  for (int e = 0; e < 12; ++e) {
    int n = 0;
    for (int s = 0; s < 6; ++s) {
      for (int k : kSideEdges[s]) {
        if (k == e) t[e][n++] = s;
      }
    }
  }
  return t;
}();

constexpr int edge_axis(int edge) { return edge / 4; }
constexpr int side_axis(int side) { return side / 2; }
constexpr int opposite_side(int side) { return side ^ 1; }

}  // namespace hexweft
