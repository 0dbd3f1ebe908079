#include "io/mesh_data.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "ovm/hex_numbering.h"

namespace hexweft {
namespace {

// The determinant of the mean edge vectors of the three axes: the Jacobian at the cell's centre.
double centre_jacobian(const MeshData& data, const std::array<int, 8>& cell) {
  Eigen::Matrix3d edges = Eigen::Matrix3d::Zero();
  for (int e = 0; e < kHexEdges; ++e) {
    edges.col(edge_axis(e)) +=
        data.points[cell[kEdgeCorners[e][1]]] - data.points[cell[kEdgeCorners[e][0]]];
  }
  return edges.col(0).cross(edges.col(1)).dot(edges.col(2));
}

// Of a mirrored file the bad hexahedra are those whose volume is positive.
void unmirror(MeshData& data) {
  const auto n = static_cast<std::size_t>(
      std::count_if(data.cells.begin(), data.cells.end(),
                    [&](const auto& cell) { return centre_jacobian(data, cell) < 0; }));
  if (2 * n <= data.cells.size()) return;
  for (auto& cell : data.cells) std::swap_ranges(cell.begin(), cell.begin() + 4, cell.begin() + 4);
  data.notes.push_back(
      n == data.cells.size()
          ? "all hexahedra were numbered mirrored; they were turned into VTK order"
          : std::to_string(n) + " of " + std::to_string(data.cells.size()) +
                " hexahedra were numbered mirrored; all were turned into VTK order");
}

void drop_isolated_points(MeshData& data) {
  std::vector<int> new_index(data.points.size(), -1);
  for (const auto& cell : data.cells) {
    for (int v : cell) new_index[v] = 0;
  }
  std::vector<int> used;
  for (int v = 0; v < static_cast<int>(data.points.size()); ++v) {
    if (new_index[v] < 0) continue;
    new_index[v] = static_cast<int>(used.size());
    data.points[used.size()] = data.points[v];
    used.push_back(v);
  }
  if (used.size() == data.points.size()) return;
  data.notes.push_back(std::to_string(data.points.size() - used.size()) +
                       " points that no hexahedron uses were left out");
  data.points.resize(used.size());
  for (auto& cell : data.cells) {
    for (int& v : cell) v = new_index[v];
  }
  for (DataArray& array : data.point_data) keep_rows(array, used);
}

}  // namespace

void keep_rows(DataArray& array, const std::vector<int>& rows) {
  const auto keep = [&](auto& values) {
    if (values.empty()) return;
    auto to = values.begin();
    for (int row : rows) {
      to = std::copy_n(values.begin() + std::size_t(row) * array.components, array.components, to);
    }
    values.erase(to, values.end());
  };
  keep(array.integers);
  keep(array.reals);
}

void add_array(std::vector<DataArray>& arrays, DataArray array, std::vector<std::string>& notes) {
  const bool taken = std::any_of(arrays.begin(), arrays.end(),
                                 [&](const DataArray& a) { return a.name == array.name; });
  if (taken) {
    notes.push_back("a second data array named \"" + array.name + "\" was left out");
  } else {
    arrays.push_back(std::move(array));
  }
}

void check_cells(const MeshData& data, int base,
                 const std::function<void(int cell, const std::string& problem)>& fail,
                 const std::function<std::string(int vertex)>& name) {
  // The kernel walks the cells of a vertex or edge; a file that piles all its cells on a few
  // vertices would make that quadratic.
  constexpr int kMostCellsAtVertex = 4096;
  std::vector<int> cells_at(data.points.size(), 0);
  const auto name_of = [&](int v) {
    return name ? name(v) : "vertex " + std::to_string(std::int64_t{v} + base);
  };
  const int n_points = static_cast<int>(data.points.size());
  for (int c = 0; c < static_cast<int>(data.cells.size()); ++c) {
    const auto& cell = data.cells[c];
    for (int i = 0; i < kCorners; ++i) {
      const int v = cell[i];
      if (v < 0 || v >= n_points) {
        fail(c, "uses " + name_of(v) + ", expected one of [" + std::to_string(base) + ", " +
                    std::to_string(n_points - 1 + base) + "]");
      }
      if (std::find(cell.begin(), cell.begin() + i, v) != cell.begin() + i) {
        fail(c, "uses " + name_of(v) + " twice, expected 8 different ones");
      }
      if (++cells_at[v] > kMostCellsAtVertex) {
        fail(c, "is one of more than " + std::to_string(kMostCellsAtVertex) + " at " + name_of(v));
      }
    }
  }
}

HexMesh build_hex_mesh(MeshData data, bool keep_isolated_vertices,
                       std::vector<std::string>& notes) {
  unmirror(data);
  if (!keep_isolated_vertices) drop_isolated_points(data);
  HexMesh mesh;
  mesh.reserve(static_cast<int>(data.points.size()), static_cast<int>(data.cells.size()));
  for (const Eigen::Vector3d& p : data.points) mesh.add_vertex(p);
  for (const auto& cell : data.cells) {
    CellVertices corners;
    for (int i = 0; i < kCorners; ++i) corners[i] = VertexHandle(cell[i]);
    mesh.add_cell(corners);
  }
  for (const DataArray& array : data.point_data)
    detail::add_property<VertexTag>(mesh, array, data.notes);
  for (const DataArray& array : data.cell_data)
    detail::add_property<CellTag>(mesh, array, data.notes);
  notes.insert(notes.end(), data.notes.begin(), data.notes.end());
  return mesh;
}

}  // namespace hexweft
