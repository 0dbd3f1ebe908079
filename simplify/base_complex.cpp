#include "simplify/base_complex.h"

#include <algorithm>
#include <optional>

#include "simplify/cell_frame.h"
#include "simplify/cut_surfaces.h"

namespace hexweft {
namespace {

// Walks straight along one frame axis to the wall; empty if the walk comes back to its start (a
// ring).
std::optional<CellFrame> walk_to_wall(const HexMesh& mesh, const CutSurfaces& cuts, CellFrame f,
                                      int axis, int end) {
  const CellHandle start = f.cell;
  while (!cuts.is_wall(halfface(mesh, f, axis, end))) {
    f = step(mesh, f, axis, end);
    if (f.cell == start) return std::nullopt;
  }
  return f;
}

int cells_to_wall(const HexMesh& mesh, const CutSurfaces& cuts, CellFrame f, int axis) {
  int n = 1;
  for (; !cuts.is_wall(halfface(mesh, f, axis, 1)); ++n) f = step(mesh, f, axis, 1);
  return n;
}

// Closes rings that no singular edge runs along: three cuts across each. Every row is walked once.
class RingCutter {
 public:
  RingCutter(const HexMesh& mesh, CutSurfaces& cuts)
      : mesh_(mesh), cuts_(cuts), walked_(3 * mesh.cell_slots(), 0) {}

  void run() {
    for (CellHandle c : mesh_.cells()) {
      for (int axis = 0; axis < 3; ++axis) {
        if (is_ring({c}, axis)) cut_ring({c}, axis);
      }
    }
  }

 private:
  bool is_ring(CellFrame f, int axis) {
    const CellHandle start = f.cell;
    while (!walked_[3 * f.cell.idx + f.axes[axis]]) {
      walked_[3 * f.cell.idx + f.axes[axis]] = 1;
      if (cuts_.is_wall(halfface(mesh_, f, axis, 1))) return false;
      f = step(mesh_, f, axis, 1);
      if (f.cell == start) return true;
    }
    return false;
  }

  void cut_ring(CellFrame f, int axis) {
    const CellHandle start = f.cell;
    std::vector<FaceHandle> across;
    do {
      across.push_back(mesh_.face(halfface(mesh_, f, axis, 1)));
      f = step(mesh_, f, axis, 1);
    } while (f.cell != start);
    for (std::size_t i = 0; i < 3; ++i) cuts_.cut(across[i * across.size() / 3]);
  }

  const HexMesh& mesh_;
  CutSurfaces& cuts_;
  std::vector<char> walked_;  // by cell and its own axis
};

class Extractor {
 public:
  Extractor(const HexMesh& mesh, BaseComplex& bc) : mesh_(mesh), bc_(bc), cuts_(mesh, bc.graph) {}

  void run() {
    RingCutter(mesh_, cuts_).run();
    bc_.component_of_cell.assign(mesh_.cell_slots(), kNone);
    bc_.base_edge_of_edge.assign(mesh_.edge_slots(), -1);
    base_vertex_.assign(mesh_.vertex_slots(), -1);
    base_face_.assign(mesh_.face_slots(), -1);
    bc_.grid_cells.reserve(mesh_.n_cells());
    for (CellHandle c : mesh_.cells()) {
      if (bc_.component_of_cell[c.idx] == kNone) add_component(c);
    }
    if (bc_.irregular > 0)
      std::replace(bc_.component_of_cell.begin(), bc_.component_of_cell.end(), kLeftOut, kNone);
  }

 private:
  static constexpr int kNone = -1, kLeftOut = -2;  // not looked at yet; belongs to no component

  void add_component(CellHandle seed) {
    const auto corner = corner_frame(seed);
    Component comp;
    if (!corner || !fill_grid(*corner, comp)) {
      leave_out({&seed, 1});
      return;
    }
    add_vertices(comp);
    const int id = static_cast<int>(bc_.components.size());
    bool conforming = true;
    for (int i = 0; i < 8; ++i) comp.corners[i] = base_vertex(corner_vertex(comp, i));
    for (int e = 0; e < 12; ++e) conforming &= (comp.edges[e] = base_edge(comp, e)) >= 0;
    for (int s = 0; s < 6; ++s) conforming &= (comp.faces[s] = base_face(comp, s, id)) >= 0;
    if (!conforming) {
      leave_out(bc_.cells(comp));
      return;
    }
    for (CellHandle c : bc_.cells(comp)) bc_.component_of_cell[c.idx] = id;
    bc_.components.push_back(comp);
  }

  void leave_out(std::span<const CellHandle> cells) {
    ++bc_.irregular;
    for (CellHandle c : cells) bc_.component_of_cell[c.idx] = kLeftOut;
  }

  std::optional<CellFrame> corner_frame(CellHandle seed) const {
    std::optional<CellFrame> f = CellFrame{seed};
    for (int axis = 0; axis < 3 && f; ++axis) f = walk_to_wall(mesh_, cuts_, *f, axis, 0);
    return f;
  }

  // Fills the grid row by row; false where the region is not a full cuboid.
  bool fill_grid(const CellFrame& corner, Component& comp) {
    for (int a = 0; a < 3; ++a) comp.n[a] = cells_to_wall(mesh_, cuts_, corner, a);
    comp.first_cell = static_cast<int>(bc_.grid_cells.size());
    frames_.clear();
    CellFrame layer = corner;
    for (int k = 0; k < comp.n[2]; ++k) {
      CellFrame row = layer;
      for (int j = 0; j < comp.n[1]; ++j) {
        CellFrame f = row;
        for (int i = 0; i < comp.n[0]; ++i) {
          if (!add_grid_cell(comp, f, i, j, k)) return false;
          if (i + 1 < comp.n[0]) f = step(mesh_, f, 0, 1);
        }
        if (j + 1 < comp.n[1]) row = step(mesh_, row, 1, 1);
      }
      if (k + 1 < comp.n[2]) layer = step(mesh_, layer, 2, 1);
    }
    return true;
  }

  // A cell of the grid has walls exactly at the grid's ends.
  bool add_grid_cell(const Component& comp, const CellFrame& f, int i, int j, int k) {
    const std::array<int, 3> at = {i, j, k};
    bool fits = bc_.component_of_cell[f.cell.idx] == kNone;
    for (int a = 0; a < 3 && fits; ++a) {
      fits = cuts_.is_wall(halfface(mesh_, f, a, 0)) == (at[a] == 0) &&
             cuts_.is_wall(halfface(mesh_, f, a, 1)) == (at[a] + 1 == comp.n[a]);
    }
    if (!fits) {
      bc_.grid_cells.resize(comp.first_cell);
      return false;
    }
    bc_.grid_cells.push_back(f.cell);
    frames_.push_back(f);
    return true;
  }

  const CellFrame& frame(const Component& comp, int i, int j, int k) const {
    return frames_[(k * comp.n[1] + j) * comp.n[0] + i];
  }

  void add_vertices(Component& comp) {
    comp.first_vertex = static_cast<int>(bc_.grid_vertices.size());
    const auto& n = comp.n;
    for (int k = 0; k <= n[2]; ++k) {
      for (int j = 0; j <= n[1]; ++j) {
        for (int i = 0; i <= n[0]; ++i) {
          const int bits = (i == n[0] ? 1 : 0) | (j == n[1] ? 2 : 0) | (k == n[2] ? 4 : 0);
          const CellFrame& f =
              frame(comp, std::min(i, n[0] - 1), std::min(j, n[1] - 1), std::min(k, n[2] - 1));
          bc_.grid_vertices.push_back(hexweft::vertex(mesh_, f, bits));
        }
      }
    }
  }

  VertexHandle corner_vertex(const Component& comp, int corner) const {
    const auto& x = kCornerCoords[corner];
    return bc_.vertex(comp, x[0] * comp.n[0], x[1] * comp.n[1], x[2] * comp.n[2]);
  }

  int base_vertex(VertexHandle v) {
    int& id = base_vertex_[v.idx];
    if (id < 0) {
      id = static_cast<int>(bc_.vertices.size());
      bc_.vertices.push_back(v);
    }
    return id;
  }

  // -1 where the chain is cut differently from the other side.
  int base_edge(const Component& comp, int edge) {
    const EdgeHandle first = edge_of_chain(comp, edge, 0);
    const int known = bc_.base_edge_of_edge[first.idx];
    if (known >= 0 && comp.n[edge_axis(edge)] == 1) return bc_.edges[known].n == 1 ? known : -1;
    find_chain(comp, edge);
    if (known < 0) return add_base_edge(comp, edge, first);
    const auto old = bc_.chain(bc_.edges[known]);
    const bool same = std::equal(chain_.begin(), chain_.end(), old.begin(), old.end()) ||
                      std::equal(chain_.rbegin(), chain_.rend(), old.begin(), old.end());
    return same ? known : -1;
  }

  void find_chain(const Component& comp, int edge) {
    const int axis = edge_axis(edge);
    const auto& x = kCornerCoords[kEdgeCorners[edge][0]];
    std::array<int, 3> at = {x[0] * comp.n[0], x[1] * comp.n[1], x[2] * comp.n[2]};
    chain_.clear();
    for (at[axis] = 0; at[axis] <= comp.n[axis]; ++at[axis]) {
      chain_.push_back(bc_.vertex(comp, at[0], at[1], at[2]));
    }
  }

  // Edge i of the chain along a component's edge.
  EdgeHandle edge_of_chain(const Component& comp, int edge, int i) const {
    const auto& x = kCornerCoords[kEdgeCorners[edge][0]];
    std::array<int, 3> at;
    for (int a = 0; a < 3; ++a) at[a] = x[a] * (comp.n[a] - 1);
    at[edge_axis(edge)] = i;
    return hexweft::edge(mesh_, frame(comp, at[0], at[1], at[2]), x[0] | x[1] << 1 | x[2] << 2,
                         edge_axis(edge));
  }

  int add_base_edge(const Component& comp, int edge, EdgeHandle first) {
    BaseEdge e;
    e.first = static_cast<int>(bc_.edge_vertices.size());
    e.n = static_cast<int>(chain_.size()) - 1;
    e.ends = {base_vertex(chain_.front()), base_vertex(chain_.back())};
    e.valence = bc_.graph.edge_valence[first.idx];
    e.boundary = bc_.graph.boundary_edge[first.idx];
    e.singular = bc_.graph.singular_edge[first.idx];
    const int id = static_cast<int>(bc_.edges.size());
    for (int i = 0; i < e.n; ++i) {
      int& of = bc_.base_edge_of_edge[edge_of_chain(comp, edge, i).idx];
      if (of >= 0) return -1;
      of = id;
    }
    bc_.edge_vertices.insert(bc_.edge_vertices.end(), chain_.begin(), chain_.end());
    bc_.edges.push_back(e);
    return id;
  }

  // -1 where a third component, or one with other edges, claims the face.
  int base_face(const Component& comp, int side, int component) {
    const int axis = side_axis(side), end = side % 2;
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    std::array<int, 4> edges;
    for (int i = 0; i < 4; ++i) edges[i] = comp.edges[kSideEdges[side][i]];
    int id = -1;
    std::array<int, 3> at;
    at[axis] = end ? comp.n[axis] - 1 : 0;
    for (at[u] = 0; at[u] < comp.n[u]; ++at[u]) {
      for (at[v] = 0; at[v] < comp.n[v]; ++at[v]) {
        const CellFrame& f = frame(comp, at[0], at[1], at[2]);
        int& of = base_face_[mesh_.face(halfface(mesh_, f, axis, end)).idx];
        if (id < 0) id = of >= 0 ? join_face(of, edges, component) : add_face(edges, component);
        if (id < 0 || (of >= 0 && of != id)) return -1;
        of = id;
      }
    }
    return id;
  }

  int add_face(const std::array<int, 4>& edges, int component) {
    bc_.faces.push_back({edges, {component, -1}});
    return static_cast<int>(bc_.faces.size()) - 1;
  }

  int join_face(int id, std::array<int, 4> edges, int component) {
    BaseFace& f = bc_.faces[id];
    auto known = f.edges;
    std::sort(edges.begin(), edges.end());
    std::sort(known.begin(), known.end());
    if (f.components[1] >= 0 || known != edges) return -1;
    f.components[1] = component;
    return id;
  }

  const HexMesh& mesh_;
  BaseComplex& bc_;
  CutSurfaces cuts_;
  std::vector<int> base_vertex_, base_face_;
  std::vector<CellFrame> frames_;    // of the grid being filled
  std::vector<VertexHandle> chain_;  // of the base edge being found
};

}  // namespace

BaseComplex extract_base_complex(const HexMesh& mesh) {
  BaseComplex bc;
  bc.graph = extract_singularity_graph(mesh);
  Extractor(mesh, bc).run();
  return bc;
}

}  // namespace hexweft
