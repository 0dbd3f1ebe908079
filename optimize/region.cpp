#include "optimize/region.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "ovm/errors.h"

namespace hexweft {
namespace {

/// Position in the region of every cell of the mesh, -1 outside.
std::vector<int> number_cells(const HexMesh& mesh, std::span<const CellHandle> cells) {
  std::vector<int> local(mesh.cell_slots(), -1);
  for (int i = 0; CellHandle c : cells) {
    if (!c.valid() || c.idx >= mesh.cell_slots() || !mesh.is_live(c)) {
      throw InputError("cell " + std::to_string(c.idx) + " of the region is not live");
    }
    if (local[c.idx] >= 0)
      throw InputError("cell " + std::to_string(c.idx) + " is in the region twice");
    local[c.idx] = i++;
  }
  return local;
}

bool all_inside(const HexMesh& mesh, VertexHandle v, const std::vector<int>& local_cell) {
  const auto around = mesh.cells(v);
  return std::all_of(around.begin(), around.end(),
                     [&](CellHandle c) { return local_cell[c.idx] >= 0; });
}

/// Fills vertices and n_free. \return position in the region of every vertex of the mesh
std::vector<int> number_vertices(const HexMesh& mesh, const std::vector<int>& local_cell,
                                 Region& region) {
  std::vector<int> local(mesh.vertex_slots(), -1);
  std::vector<VertexHandle> rim;
  for (CellHandle c : region.cells) {
    for (VertexHandle v : mesh.vertices(c)) {
      if (local[v.idx] >= 0) continue;
      const bool free = all_inside(mesh, v, local_cell);
      (free ? region.vertices : rim).push_back(v);
      local[v.idx] = 0;
    }
  }
  region.n_free = static_cast<int>(region.vertices.size());
  region.vertices.insert(region.vertices.end(), rim.begin(), rim.end());
  for (int i = 0; VertexHandle v : region.vertices) local[v.idx] = i++;
  return local;
}

}  // namespace

Region make_region(const HexMesh& mesh, std::span<const CellHandle> cells) {
  Region region;
  region.cells.assign(cells.begin(), cells.end());
  const std::vector<int> local_cell = number_cells(mesh, cells);
  const std::vector<int> local = number_vertices(mesh, local_cell, region);
  region.points.resize(3, static_cast<Eigen::Index>(region.vertices.size()));
  load_points(mesh, region);
  std::vector<char> on_surface(region.n_free, 0);
  for (CellHandle c : cells) {
    HexCorners& hex = region.hexes.emplace_back();
    for (int k = 0; VertexHandle v : mesh.vertices(c)) hex[k++] = local[v.idx];
    for (int k = 0; HalfFaceHandle hf : mesh.halffaces(c)) {
      const HalfFaceHandle mate = mesh.opposite(hf);
      const int neighbor = mate.valid() ? local_cell[mesh.cell(mate).idx] : -1;
      region.neighbor_side.push_back(neighbor < 0 ? -1 : 6 * neighbor + HexMesh::side(mate));
      std::array<int, 4> quad;
      for (int i = 0; i < 4; ++i) quad[i] = hex[kSideCorners[k][i]];
      ++k;
      if (mate.valid()) continue;
      region.quads.push_back(quad);
      for (int v : quad) {
        if (v < region.n_free) on_surface[v] = 1;
      }
    }
  }
  for (int v = 0; v < region.n_free; ++v) {
    if (on_surface[v]) region.surface.push_back(v);
  }
  return region;
}

void load_points(const HexMesh& mesh, Region& region) {
  for (Eigen::Index i = 0; i < region.points.cols(); ++i) {
    region.points.col(i) = mesh.point(region.vertices[i]);
  }
}

double store_points(const Region& region, HexMesh& mesh) {
  double move = 0;
  for (int i = 0; i < region.n_free; ++i) {
    const Eigen::Vector3d p = region.points.col(i);
    move = std::max(move, (p - mesh.point(region.vertices[i])).norm());
    mesh.set_point(region.vertices[i], p);
  }
  return move;
}

std::vector<double> edge_lengths_at_vertices(const Region& region) {
  std::vector<double> sum(region.vertices.size(), 0);
  std::vector<int> count(region.vertices.size(), 0);
  for (const HexCorners& hex : region.hexes) {
    for (const auto& [a, b] : kEdgeCorners) {
      const double squared = (region.points.col(hex[a]) - region.points.col(hex[b])).squaredNorm();
      for (int v : {hex[a], hex[b]}) {
        sum[v] += squared;
        ++count[v];
      }
    }
  }
  for (std::size_t v = 0; v < sum.size(); ++v) sum[v] = std::sqrt(sum[v] / std::max(1, count[v]));
  return sum;
}

}  // namespace hexweft
