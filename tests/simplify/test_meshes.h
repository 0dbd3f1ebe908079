/// \file
/// Meshes whose structure is known by hand, and what several tests of simplify/ ask of a mesh.
#pragma once

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "ovm/edit/insert_sheet.h"
#include "ovm/generators.h"
#include "ovm/hex_mesh.h"
#include "ovm/neighborhood.h"
#include "ovm/quality.h"
#include "ovm/topology_check.h"
#include "ovm/topology_summary.h"
#include "simplify/base_complex.h"

namespace hexweft {

inline HexMesh make_grid_with_random_sheets(int n, unsigned seed) {
  HexMesh mesh = make_grid({5, 5, 5});
  EXPECT_EQ(insert_random_sheets(mesh, n, seed), n);
  mesh.collect_garbage();
  return mesh;
}

/// Lets a pillow run round the cells of a grid over a rectangle, from its bottom to its top.
inline void pillow_columns(HexMesh& mesh, int x0, int x1, int y0, int y1) {
  std::vector<CellHandle> inside;
  for (CellHandle c : mesh.cells()) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (VertexHandle v : mesh.vertices(c)) middle += mesh.point(v) / 8;
    if (middle.x() > x0 && middle.x() < x1 && middle.y() > y0 && middle.y() < y1)
      inside.push_back(c);
  }
  EXPECT_EQ(insert_sheet(mesh, inside).refusal, InsertRefusal::none);
}

/// A grid in which the sheet through a column that is one cell wide has curves of valence 3 on both
/// sides, opposite each other. What the other columns have round them cuts it into many components.
inline HexMesh make_blocked_sheet() {
  HexMesh mesh = make_grid({15, 15, 2});
  pillow_columns(mesh, 7, 8, 6, 9);
  pillow_columns(mesh, 1, 3, 1, 3);
  pillow_columns(mesh, 11, 14, 11, 13);
  mesh.collect_garbage();
  return mesh;
}

/// Quadrilaterals in the plane, swept up by `n_layers` unit layers.
inline HexMesh extrude(const std::vector<std::array<double, 2>>& points,
                       const std::vector<std::array<int, 4>>& quads, int n_layers = 1) {
  HexMesh mesh;
  const int n = static_cast<int>(points.size());
  for (int k = 0; k <= n_layers; ++k) {
    for (const auto& [x, y] : points) mesh.add_vertex({x, y, double(k)});
  }
  for (int k = 0; k < n_layers; ++k) {
    for (const auto& q : quads) {
      CellVertices c;
      for (int i = 0; i < 4; ++i) {
        c[i] = VertexHandle(n * k + q[i]);
        c[i + 4] = VertexHandle(n * (k + 1) + q[i]);
      }
      mesh.add_cell(c);
    }
  }
  return mesh;
}

/// Every hexahedron split in eight, its new vertices at the means of what they are in the middle of.
inline HexMesh split_in_eight(const HexMesh& mesh) {
  HexMesh fine;
  std::map<std::vector<VertexHandle>, VertexHandle> middle_of;
  for (CellHandle c : mesh.cells()) {
    const CellVertices corners = mesh.vertices(c);
    // Of a grid of 3 x 3 x 3 vertices, the one in the middle of some of the corners.
    const auto at = [&](int i, int j, int k) {
      std::vector<VertexHandle> around;
      for (int corner = 0; corner < 8; ++corner) {
        const auto [x, y, z] = kCornerCoords[corner];
        if (std::abs(2 * x - i) < 2 && std::abs(2 * y - j) < 2 && std::abs(2 * z - k) < 2)
          around.push_back(corners[corner]);
      }
      std::sort(around.begin(), around.end());
      const auto [found, is_new] = middle_of.try_emplace(around);
      if (is_new) {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (VertexHandle v : around) sum += mesh.point(v);
        found->second = fine.add_vertex(sum / static_cast<double>(around.size()));
      }
      return found->second;
    };
    for (int part = 0; part < 8; ++part) {
      const auto [i, j, k] = kCornerCoords[part];
      CellVertices v;
      for (int corner = 0; corner < 8; ++corner) {
        const auto [x, y, z] = kCornerCoords[corner];
        v[corner] = at(i + x, j + y, k + z);
      }
      fine.add_cell(v);
    }
  }
  return fine;
}

/// Points and quadrilaterals of a plane mesh.
struct PlaneMesh {
  std::vector<std::array<double, 2>> points;
  std::vector<std::array<int, 4>> quads;

  /// Lays a row of quadrilaterals along a chain, to its right; `outer` are its other points.
  void add_row(const std::vector<int>& chain, const std::vector<std::array<double, 2>>& outer) {
    const int first = static_cast<int>(points.size());
    points.insert(points.end(), outer.begin(), outer.end());
    for (int i = 0; i + 1 < static_cast<int>(chain.size()); ++i) {
      quads.push_back({first + i, first + i + 1, chain[i + 1], chain[i]});
    }
  }
};

/// A ribbon that runs round a hole and crosses itself in its cell 0, two-sided:
///
///      o-------o
///      | o---o |
///      | |   | |
///    o-o-o---o |
///    o-o-o-----o
///      o-o
/// \param rimmed  with cells outside along it, so that something is left without the ribbon
inline HexMesh make_crossing_ribbon(bool rimmed = false, int n_layers = 1) {
  PlaneMesh m = {{{0, 0},
                  {1, 0},
                  {1, 1},
                  {0, 1},
                  {-1, 0},
                  {-1, 1},
                  {0, -1},
                  {1, -1},
                  {3, 0},
                  {2, 1},
                  {3, 3},
                  {2, 2},
                  {0, 3},
                  {1, 2}},
                 {{0, 1, 2, 3},
                  {4, 0, 3, 5},
                  {6, 7, 1, 0},
                  {1, 8, 9, 2},
                  {8, 10, 11, 9},
                  {10, 12, 13, 11},
                  {12, 3, 2, 13}}};
  if (rimmed) {
    m.points.push_back({-1, -1});
    m.quads.push_back({14, 6, 0, 4});
    m.add_row({7, 1, 8, 10, 12, 3, 5},
              {{2, -1}, {2, -0.5}, {4, -1}, {4, 4}, {-1, 4}, {-0.5, 2}, {-1, 2}});
  }
  return extrude(m.points, m.quads, n_layers);
}

/// A ribbon that turns back round a hole and lies along itself: cells 0 and 5 share a side that is
/// parallel to the ribbon.
/// \param rimmed  with cells outside along it
inline HexMesh make_touching_ribbon(bool rimmed = false, int n_layers = 1) {
  PlaneMesh m = {
      {{0, 0},
       {1, -0.5},
       {2, -1},
       {4, 1},
       {2, 3},
       {1, 2.5},
       {0, 2},
       {0, 1},
       {1, 1},
       {2, 0.5},
       {3, 1},
       {2, 1.5}},
      {{0, 1, 8, 7}, {1, 2, 9, 8}, {2, 3, 10, 9}, {3, 4, 11, 10}, {4, 5, 8, 11}, {5, 6, 7, 8}}};
  if (rimmed) {
    // Longer than the ribbon, so that its ends have corners of three cells: these keep the ribbon
    // and the rim apart.
    m.points.insert(m.points.end(), {{-1, 0}, {-1, 2}});
    m.add_row({12, 0, 1, 2, 3, 4, 5, 6, 13},
              {{-1, -1}, {0, -1}, {1, -1.5}, {2, -2}, {6, 1}, {2, 4}, {1, 3.5}, {0, 3}, {-1, 3}});
  }
  return extrude(m.points, m.quads, n_layers);
}

/// Three cells round a hole with three sides. Cell 1 joins the vertices 0 and 1 of one of its
/// edges; cell 0 has both as opposite corners. Topology only: the cells are folded.
inline HexMesh make_folded_ring() {
  const std::vector<std::array<double, 2>> points = {{0, 0},   {1, 0}, {0.5, 1},
                                                     {0.5, 2}, {2, 0}, {2, 2}};
  return extrude(points, {{0, 1, 4, 3}, {0, 3, 1, 2}, {1, 3, 5, 4}});
}

/// A grid with a closed sheet round the cell in its middle. n odd, >= 3.
inline HexMesh make_pillowed_grid(int n) {
  HexMesh mesh = make_grid({n, n, n});
  const CellHandle middle(n * n * n / 2);
  insert_sheet(mesh, std::array{middle});
  mesh.collect_garbage();
  return mesh;
}

/// n^3 hexahedra and a closed sheet round them, under the whole of the surface.
inline HexMesh make_padded_cube(int n) {
  HexMesh mesh = make_grid({n, n, n});
  const SheetInsertion padding = insert_sheet(mesh, all_cells(mesh), {.include_boundary = true});
  EXPECT_EQ(padding.refusal, InsertRefusal::none);
  mesh.collect_garbage();
  return mesh;
}

/// Adds another mesh, moved by `offset`, as parts of their own.
inline void append(HexMesh& mesh, const HexMesh& other, const Eigen::Vector3d& offset) {
  std::vector<VertexHandle> copy(other.vertex_slots());
  for (VertexHandle v : other.vertices()) copy[v.idx] = mesh.add_vertex(other.point(v) + offset);
  for (CellHandle c : other.cells()) {
    CellVertices corners = other.vertices(c);
    for (VertexHandle& v : corners) v = copy[v.idx];
    mesh.add_cell(corners);
  }
}

using BaseCounts = std::array<int, 4>;  ///< (B_V, B_E, B_F, B_C)

inline BaseCounts counts(const BaseComplex& bc) {
  return {int(bc.vertices.size()), int(bc.edges.size()), int(bc.faces.size()),
          int(bc.components.size())};
}

/// Coordinates and cells, to compare meshes bit for bit.
struct MeshContent {
  std::vector<std::array<double, 3>> points;
  std::vector<CellVertices> cells;
  friend bool operator==(const MeshContent&, const MeshContent&) = default;
};
inline MeshContent content(const HexMesh& mesh) {
  MeshContent result;
  for (VertexHandle v : mesh.vertices()) {
    const Eigen::Vector3d& p = mesh.point(v);
    result.points.push_back({p.x(), p.y(), p.z()});
  }
  for (CellHandle c : mesh.cells()) result.cells.push_back(mesh.vertices(c));
  return result;
}

/// Valid in the sense of the loop, apart from its distance to the input.
inline bool is_good(const HexMesh& mesh) {
  return is_clean(check_topology(mesh), Severity::degenerate) && min_scaled_jacobian(mesh) > 0 &&
         extract_base_complex(mesh).irregular == 0;
}

}  // namespace hexweft
