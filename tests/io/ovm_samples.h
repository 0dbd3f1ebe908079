// Files of OpenVolumeMesh, put together by hand.
#pragma once

#include <cstring>
#include <string>
#include <vector>

namespace hexweft::test {

inline const std::string kOvmCubePoints =
    "Vertices\n8\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n";
inline const std::string kOvmCubeEdges =
    "Edges\n12\n1 2\n2 3\n3 0\n0 1\n7 6\n6 5\n5 4\n4 7\n2 6\n7 3\n5 1\n0 4\n";
inline const std::string kOvmCubeFaces =
    "Faces\n6\n4 0 2 4 6\n4 8 10 12 14\n4 3 16 9 18\n4 13 20 7 22\n4 19 15 23 5\n4 1 21 11 17\n";
inline const std::string kOvmCubeCell = "Polyhedra\n1\n6 0 2 4 6 8 10\n";
inline const std::string kOvmCube =
    "OVM ASCII\n" + kOvmCubePoints + kOvmCubeEdges + kOvmCubeFaces + kOvmCubeCell;

/// Bytes of a binary file.
struct Bytes {
  std::string text;
  Bytes& number(unsigned long long value, int bytes) {
    for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> 8 * i & 0xff);
    return *this;
  }
  Bytes& list(const std::vector<int>& values, int bytes = 1) {
    for (int value : values) number(static_cast<unsigned>(value), bytes);
    return *this;
  }
  template <class Real>
  Bytes& reals(const std::vector<Real>& values) {
    for (Real value : values) {  // of a little-endian machine, as all are that this runs on
      char bytes[sizeof(Real)];
      std::memcpy(bytes, &value, sizeof(Real));
      text.append(bytes, sizeof(Real));
    }
    return *this;
  }
  Bytes& word(const std::string& w) {  // with its length
    number(w.size(), 4);
    text += w;
    return *this;
  }
  Bytes& span(int first, int count) { return number(first, 8).number(count, 4); }
};

inline std::string ovmb_header(int vertices, int edges, int faces, int cells, int kind = 2) {
  Bytes b{std::string("OVMB\n\r\n\xFF", 8)};
  b.list({1, 1, 3, kind, 0, 0, 0, 0});
  return b.number(vertices, 8).number(edges, 8).number(faces, 8).number(cells, 8).text;
}

inline std::string ovmb_chunk(const std::string& type, const Bytes& payload, int mandatory = 1,
                              int version = 0) {
  const int padding = static_cast<int>((8 - payload.text.size() % 8) % 8);
  Bytes b{type};
  b.list({version, padding, 0, mandatory}).number(payload.text.size() + padding, 8);
  return b.text + payload.text + std::string(padding, '\0');
}

inline const std::vector<int> kCubeCoordinates{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0,
                                               0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
template <class Real = double>
std::string ovmb_cube_points() {
  Bytes b;
  b.span(0, 8).list({sizeof(Real) == 4 ? 1 : 2, 0, 0, 0});
  b.reals(std::vector<Real>(kCubeCoordinates.begin(), kCubeCoordinates.end()));
  return ovmb_chunk("VERT", b);
}

/// A chunk TOPO of indices of the given width, to which a reader adds the offset.
inline std::string ovmb_rows(int entity, int valence, int first, const std::vector<int>& indices,
                             int width = 1, int offset = 0) {
  Bytes b;
  b.span(first, static_cast<int>(indices.size()) / valence).list({entity, valence, 0, width});
  return ovmb_chunk("TOPO", b.number(offset, 8).list(indices, width));
}

inline const std::vector<int> kCubeEdgeEnds{1, 2, 2, 3, 3, 0, 0, 1, 7, 6, 6, 5,
                                            5, 4, 4, 7, 2, 6, 7, 3, 5, 1, 0, 4};
inline const std::vector<int> kCubeHalfEdges{0,  2,  4, 6,  8,  10, 12, 14, 3, 16, 9,  18,
                                             13, 20, 7, 22, 19, 15, 23, 5,  1, 21, 11, 17};
inline const std::vector<int> kCubeHalfFaces{0, 2, 4, 6, 8, 10};

inline std::string ovmb_cube_topology(int width = 1) {
  return ovmb_rows(1, 2, 0, kCubeEdgeEnds, width) + ovmb_rows(2, 4, 0, kCubeHalfEdges, width) +
         ovmb_rows(3, 6, 0, kCubeHalfFaces, width);
}

inline const std::string kOvmbEndChunk = ovmb_chunk("EOF ", {});

inline std::string ovmb_cube() {
  return ovmb_header(8, 12, 6, 1) + ovmb_cube_points() + ovmb_cube_topology() + kOvmbEndChunk;
}

}  // namespace hexweft::test
