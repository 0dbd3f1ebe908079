#include "ovm/edit/split_sheet.h"

#include <algorithm>
#include <functional>
#include <string>

#include "ovm/detail/carry_properties.h"
#include "ovm/detail/require_live.h"
#include "ovm/errors.h"
#include "ovm/transaction.h"

namespace hexweft {
namespace {

// Corner of a cell on the lattice {0, 1, 2}^3, where 1 is the middle.
using LatticePoint = std::array<int, 3>;

// Edge k of a cell is parallel to its axis and has these other two coordinates (0 or 2).
int edge_at(int axis, const LatticePoint& x) {
  LatticePoint low = x;
  low[axis] = 0;
  LatticePoint high = x;
  high[axis] = 2;
  const auto corner = [](const LatticePoint& p) { return kCornerAt[p[0] / 2][p[1] / 2][p[2] / 2]; };
  return kEdgeBetween[corner(low)][corner(high)];
}

class SheetSplitter {
 public:
  SheetSplitter(HexMesh& mesh, const DualSheet& sheet) : mesh_(mesh), sheet_(sheet) {}

  SheetSplit run();

 private:
  using Crossed = std::array<bool, 3>;  // the axes along which a cell is split
  void require_current() const;
  void add_edge_middles();
  void add_face_middles(CellHandle c, const Crossed& crossed);
  VertexHandle add_middle(std::span<const VertexHandle> parents);
  VertexHandle edge_middle(EdgeHandle e) const;
  VertexHandle face_middle(FaceHandle f) const;
  VertexHandle lattice_vertex(CellHandle c, const LatticePoint& x, VertexHandle center) const;
  void split(CellHandle c, const Crossed& crossed);
  void add_child(CellHandle parent, const LatticePoint& low, const LatticePoint& high);

  HexMesh& mesh_;
  const DualSheet& sheet_;
  std::vector<VertexHandle> edge_middles_;                             // parallel to sheet_.edges
  std::vector<std::pair<FaceHandle, VertexHandle>> face_middles_;      // sorted by face
  std::array<std::array<std::array<VertexHandle, 3>, 3>, 3> lattice_;  // of the cell being split
  std::array<HalfEdgeHandle, 12> parent_edges_;
  std::array<FaceHandle, 6> parent_faces_;
  SheetSplit result_;
};

// The sheet is one of this mesh as it is now if each edge of each crossing is of the sheet, which the
// splitting sees to, and the edges are those of as many cells as there are crossings, four of each.
void SheetSplitter::require_current() const {
  for (const CellAxis& x : sheet_.crossings) {
    detail::require_live(mesh_, x.cell, " of the sheet");
    if (x.axis < 0 || x.axis > 2) {
      throw InputError("the sheet crosses " + detail::name(x.cell) + " along axis " +
                       std::to_string(x.axis) + ", expected 0, 1 or 2");
    }
  }
  const auto twice = std::ranges::adjacent_find(sheet_.crossings, std::greater_equal());
  if (twice != sheet_.crossings.end()) {
    throw InputError(detail::name(twice->cell) + " of the sheet is out of order or there twice");
  }
  std::size_t n_at_edges = 0;
  for (EdgeHandle e : sheet_.edges) {
    detail::require_live(mesh_, e, " of the sheet");
    n_at_edges += mesh_.valence(e);
  }
  if (n_at_edges != 4 * sheet_.crossings.size()) {
    throw InputError("the sheet crosses other cells than those at its edges: there are " +
                     std::to_string(n_at_edges) +
                     " pairs of an edge and a cell at it, expected 4 x " +
                     std::to_string(sheet_.crossings.size()));
  }
}

VertexHandle SheetSplitter::add_middle(std::span<const VertexHandle> parents) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (VertexHandle v : parents) sum += mesh_.point(v);
  SplitVertex& made = result_.vertices.emplace_back();
  made.vertex = mesh_.add_vertex(sum / static_cast<double>(parents.size()));
  detail::carry_mean(mesh_, parents, made.vertex);
  made.n_parents = static_cast<int>(parents.size());
  std::copy(parents.begin(), parents.end(), made.parents.begin());
  return made.vertex;
}

void SheetSplitter::add_edge_middles() {
  for (EdgeHandle e : sheet_.edges) {
    const auto ends = mesh_.vertices(e);
    edge_middles_.push_back(add_middle(ends));
  }
}

// Faces that the sheet crosses in both directions.
void SheetSplitter::add_face_middles(CellHandle c, const Crossed& crossed) {
  for (HalfFaceHandle hf : mesh_.halffaces(c)) {
    const int axis = side_axis(HexMesh::side(hf));
    if (!crossed[(axis + 1) % 3] || !crossed[(axis + 2) % 3]) continue;
    if (mesh_.opposite(hf).valid() && mesh_.halfface(mesh_.face(hf)) != hf) continue;
    const auto quad = mesh_.vertices(hf);
    face_middles_.emplace_back(mesh_.face(hf), add_middle(quad));
  }
}

VertexHandle SheetSplitter::edge_middle(EdgeHandle e) const {
  const auto it = std::lower_bound(sheet_.edges.begin(), sheet_.edges.end(), e);
  if (it == sheet_.edges.end() || *it != e) {
    throw InputError("the sheet lacks edge " + std::to_string(e.idx) +
                     " of a cell that it crosses");
  }
  return edge_middles_[it - sheet_.edges.begin()];
}

VertexHandle SheetSplitter::face_middle(FaceHandle f) const {
  const auto it = std::lower_bound(face_middles_.begin(), face_middles_.end(), f,
                                   [](const auto& x, FaceHandle g) { return x.first < g; });
  if (it == face_middles_.end() || it->first != f) {
    throw InputError("face " + std::to_string(f.idx) + " is crossed twice from one side only");
  }
  return it->second;
}

VertexHandle SheetSplitter::lattice_vertex(CellHandle c, const LatticePoint& x,
                                           VertexHandle center) const {
  const auto n_middle = std::count(x.begin(), x.end(), 1);
  if (n_middle == 3) return center;
  if (n_middle == 0) return mesh_.vertices(c)[kCornerAt[x[0] / 2][x[1] / 2][x[2] / 2]];
  if (n_middle == 1) {
    const auto axis = static_cast<int>(std::find(x.begin(), x.end(), 1) - x.begin());
    return edge_middle(mesh_.edges(c)[edge_at(axis, x)]);
  }
  int axis = 0;
  while (x[axis] == 1) ++axis;
  return face_middle(mesh_.face(mesh_.halfface(c, 2 * axis + x[axis] / 2)));
}

void SheetSplitter::add_child(CellHandle parent, const LatticePoint& low,
                              const LatticePoint& high) {
  CellVertices corners;
  std::array<LatticePoint, 8> x;
  for (int i = 0; i < kCorners; ++i) {
    for (int a = 0; a < 3; ++a) x[i][a] = kCornerCoords[i][a] == 0 ? low[a] : high[a];
    corners[i] = lattice_[x[i][0]][x[i][1]][x[i][2]];
  }
  const CellHandle child = mesh_.add_cell(corners);
  result_.cells.push_back(child);
  result_.parents.push_back(parent);
  detail::carry(mesh_, parent, child);
  for (int k = 0; k < kHexEdges; ++k) {
    const int a = edge_axis(k);
    const LatticePoint& from = x[kEdgeCorners[k][0]];
    if (from[(a + 1) % 3] == 1 || from[(a + 2) % 3] == 1) continue;  // not on an edge of the parent
    detail::carry_edge(mesh_, parent_edges_[edge_at(a, from)],
                       detail::half_edge_of(mesh_, child, k));
  }
  for (int s = 0; s < kSides; ++s) {
    const int a = side_axis(s);
    if ((s % 2 == 0 ? low[a] : high[a]) == 1) continue;  // inside the parent
    detail::carry_side(mesh_, mesh_.halfface(parent, s), parent_faces_[s],
                       mesh_.halfface(child, s));
  }
}

void SheetSplitter::split(CellHandle c, const Crossed& crossed) {
  VertexHandle center;
  if (crossed[0] && crossed[1] && crossed[2]) {
    const CellVertices corners = mesh_.vertices(c);
    center = add_middle(corners);
  }
  const auto levels = [&](int a) { return crossed[a] ? std::vector{0, 1, 2} : std::vector{0, 2}; };
  const std::array<std::vector<int>, 3> level{levels(0), levels(1), levels(2)};
  for (int i : level[0]) {
    for (int j : level[1]) {
      for (int k : level[2]) lattice_[i][j][k] = lattice_vertex(c, {i, j, k}, center);
    }
  }
  for (int k = 0; k < kHexEdges; ++k) parent_edges_[k] = detail::half_edge_of(mesh_, c, k);
  for (int s = 0; s < kSides; ++s) parent_faces_[s] = mesh_.face(mesh_.halfface(c, s));
  mesh_.delete_cell(c);
  result_.removed.push_back(c);
  for (std::size_t k = 0; k + 1 < level[2].size(); ++k) {
    for (std::size_t j = 0; j + 1 < level[1].size(); ++j) {
      for (std::size_t i = 0; i + 1 < level[0].size(); ++i) {
        add_child(c, {level[0][i], level[1][j], level[2][k]},
                  {level[0][i + 1], level[1][j + 1], level[2][k + 1]});
      }
    }
  }
}

SheetSplit SheetSplitter::run() {
  require_current();
  std::vector<std::pair<CellHandle, Crossed>> cells;
  for (const CellAxis& x : sheet_.crossings) {
    if (cells.empty() || cells.back().first != x.cell) cells.emplace_back(x.cell, Crossed{});
    cells.back().second[x.axis] = true;
  }
  add_edge_middles();
  for (const auto& [c, crossed] : cells) add_face_middles(c, crossed);
  std::sort(face_middles_.begin(), face_middles_.end());
  for (const auto& [c, crossed] : cells) split(c, crossed);
  return std::move(result_);
}

}  // namespace

SheetSplit split_sheet(HexMesh& mesh, const DualSheet& sheet) {
  Transaction all_or_nothing(mesh);
  SheetSplit result = SheetSplitter(mesh, sheet).run();
  all_or_nothing.commit();
  return result;
}

SheetSplit split_sheet(HexMesh& mesh, EdgeHandle e) {
  detail::require_live(mesh, e);
  return split_sheet(mesh, dual_sheet(mesh, e));
}

}  // namespace hexweft
