// Meshes and comparisons that the tests of this folder share.
#pragma once

#include <cstring>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/data_array.h"
#include "io/hex_mesh_io.h"

namespace hexweft::test {

/// The unit cube: corner i of the cell is vertex i, at kCornerCoords[i].
inline HexMesh unit_cube() {
  HexMesh mesh;
  CellVertices corners;
  for (int i = 0; i < 8; ++i) {
    const auto& x = kCornerCoords[i];
    corners[i] = mesh.add_vertex(Eigen::Vector3d(x[0], x[1], x[2]));
  }
  mesh.add_cell(corners);
  return mesh;
}

/// n × n × n cells with coordinates that have no short decimal form.
inline HexMesh shaken_grid(int n, unsigned seed = 1) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> shake(-0.2, 0.2);
  HexMesh mesh;
  const auto vertex = [n](int i, int j, int k) {
    return VertexHandle((k * (n + 1) + j) * (n + 1) + i);
  };
  for (int k = 0; k <= n; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i)
        mesh.add_vertex({i + shake(random), j + shake(random), k + shake(random)});
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        CellVertices c;
        for (int corner = 0; corner < 8; ++corner) {
          const auto& x = kCornerCoords[corner];
          c[corner] = vertex(i + x[0], j + x[1], k + x[2]);
        }
        mesh.add_cell(c);
      }
  return mesh;
}

inline bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof(a)) == 0; }

template <class Tag>
void expect_same_properties(const HexMesh& a, const HexMesh& b) {
  std::vector<std::string> notes;
  auto of_a = detail::property_arrays<Tag>(a, notes), of_b = detail::property_arrays<Tag>(b, notes);
  const auto by_name = [](const DataArray& x, const DataArray& y) { return x.name < y.name; };
  std::sort(of_a.begin(), of_a.end(), by_name);
  std::sort(of_b.begin(), of_b.end(), by_name);
  ASSERT_EQ(of_a.size(), of_b.size());
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    SCOPED_TRACE(of_a[i].name);
    EXPECT_EQ(of_a[i].name, of_b[i].name);
    EXPECT_EQ(of_a[i].kind, of_b[i].kind);
    EXPECT_EQ(of_a[i].components, of_b[i].components);
    EXPECT_EQ(of_a[i].integers, of_b[i].integers);
    ASSERT_EQ(of_a[i].reals.size(), of_b[i].reals.size());
    for (std::size_t j = 0; j < of_a[i].reals.size(); ++j) {
      EXPECT_TRUE(same_bits(of_a[i].reals[j], of_b[i].reals[j])) << of_a[i].reals[j];
    }
  }
}

/// Same points to the last bit, same cells, same named vertex and cell properties, in handle order.
inline void expect_same_mesh(const HexMesh& a, const HexMesh& b) {
  ASSERT_EQ(a.n_vertices(), b.n_vertices());
  ASSERT_EQ(a.n_cells(), b.n_cells());
  for (VertexHandle v : a.vertices()) {
    for (int i = 0; i < 3; ++i) {
      EXPECT_TRUE(same_bits(a.point(v)[i], b.point(v)[i])) << a.point(v)[i];
    }
  }
  for (CellHandle c : a.cells()) EXPECT_EQ(a.vertices(c), b.vertices(c));
  expect_same_properties<VertexTag>(a, b);
  expect_same_properties<CellTag>(a, b);
}

/// The message of the FormatError that reading the text ends with; empty if it can be read.
inline std::string read_error(const std::string& text, const std::string& name = "in.vtk") {
  try {
    read_hex_mesh_text(text, name);
  } catch (const FormatError& error) {
    return error.what();
  }
  return {};
}

}  // namespace hexweft::test
