// Sheets at random places.
#include <algorithm>
#include <random>

#include "ovm/detail/guarded_smoothing.h"
#include "ovm/detail/sort_unique.h"
#include "ovm/edit/insert_sheet.h"
#include "ovm/generators.h"
#include "ovm/neighborhood.h"
#include "ovm/transaction.h"

namespace hexweft {
namespace {

constexpr double kMinScaledJacobian = 0.02;

// Cells within some rings of a seed; a ring spreads over faces or over vertices.
std::vector<CellHandle> ball(const HexMesh& mesh, CellHandle seed, int n_rings,
                             bool over_vertices) {
  std::vector<CellHandle> cells{seed};
  std::vector<char> reached(mesh.cell_slots(), 0);
  reached[seed.idx] = 1;
  std::size_t ring_begin = 0;
  const auto reach = [&](CellHandle c) {
    if (!c.valid() || reached[c.idx]) return;
    reached[c.idx] = 1;
    cells.push_back(c);
  };
  for (int r = 0; r < n_rings; ++r) {
    const std::size_t ring_end = cells.size();
    for (std::size_t i = ring_begin; i < ring_end; ++i) {
      if (over_vertices) {
        for (VertexHandle v : mesh.vertices(cells[i])) {
          for (CellHandle c : mesh.cells(v)) reach(c);
        }
      } else {
        for (HalfFaceHandle hf : mesh.halffaces(cells[i])) reach(mesh.cell(mesh.opposite(hf)));
      }
    }
    ring_begin = ring_end;
  }
  return cells;
}

// Evens out the layer and the cells under it; false if a cell stays bad.
bool settle(HexMesh& mesh, const SheetInsertion& pillow) {
  std::vector<VertexHandle> vertices;
  std::vector<CellHandle> cells = pillow.layer;
  for (const auto& r : pillow.replaced) cells.push_back(r.after);
  for (CellHandle c : cells) {
    const auto& corners = mesh.vertices(c);
    vertices.insert(vertices.end(), corners.begin(), corners.end());
  }
  detail::sort_unique(vertices);
  std::erase_if(vertices, [&](VertexHandle v) { return mesh.is_boundary(v); });
  for (int i = 0; i < 3; ++i) {
    for (VertexHandle v : vertices) {
      const auto mean = detail::mean_of_neighbors(mesh, v, [](EdgeHandle) { return true; });
      detail::move_guarded(mesh, v, mean, 0.3);
    }
  }
  const auto is_bad = [&](CellHandle c) { return scaled_jacobian(mesh, c) < kMinScaledJacobian; };
  if (std::any_of(cells.begin(), cells.end(), is_bad)) return false;
  return std::all_of(vertices.begin(), vertices.end(), [&](VertexHandle v) {
    return detail::min_scaled_jacobian_round(mesh, v) >= kMinScaledJacobian;
  });
}

}  // namespace

int insert_random_sheets(HexMesh& mesh, int n, unsigned seed) {
  // The engine's numbers are the same everywhere; those of the library's distributions are not.
  std::mt19937_64 random(seed);
  const auto below = [&](int bound) { return static_cast<int>(random() % bound); };
  int n_inserted = 0;
  for (int trial = 0; trial < 10 * n && n_inserted < n; ++trial) {
    const std::vector<CellHandle> live = all_cells(mesh);
    if (live.empty()) break;
    const CellHandle center = live[below(static_cast<int>(live.size()))];
    const int n_rings = 1 + below(3);
    const bool over_vertices = below(2) == 0, include_boundary = below(2) == 0;
    const auto cells =
        ball(mesh, center, over_vertices ? (n_rings + 1) / 2 : n_rings, over_vertices);
    Transaction attempt(mesh);
    const auto pillow = insert_sheet(mesh, cells, {.include_boundary = include_boundary});
    if (pillow.refusal != InsertRefusal::none || !settle(mesh, pillow)) continue;
    attempt.commit();
    ++n_inserted;
  }
  return n_inserted;
}

}  // namespace hexweft
