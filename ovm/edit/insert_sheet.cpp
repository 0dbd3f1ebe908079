#include "ovm/edit/insert_sheet.h"

#include <algorithm>
#include <string>

#include "ovm/detail/carry_properties.h"
#include "ovm/detail/require_live.h"
#include "ovm/detail/sort_unique.h"
#include "ovm/errors.h"
#include "ovm/topology_check.h"
#include "ovm/transaction.h"

namespace hexweft {
namespace {

using Eigen::Vector3d;

// Side of a layer cell over edge i of the quad it stands on (side 4 is the quad).
constexpr std::array<int, 4> kSideOverEdge{2, 1, 3, 0};

// A quad of the interface, as it was before any edit.
struct InterfaceQuad {
  HalfFaceHandle side;  // of the inside cell
  FaceHandle face;
  QuadVertices vertices;
  std::array<HalfEdgeHandle, 4> edges;  // edge i runs from vertex i to vertex i + 1
  // Where edge i lies on the mesh boundary: the side of the set there, else invalid.
  std::array<HalfFaceHandle, 4> rim;
  std::array<FaceHandle, 4> rim_faces;
};

class SheetInserter {
 public:
  SheetInserter(HexMesh& mesh, std::span<const CellHandle> inside,
                const InsertSheetOptions& options);

  SheetInsertion run();

 private:
  struct InterfaceVertex {
    VertexHandle outer, inner;
    Vector3d target;       // the inner copy lies on the way to here
    HalfEdgeHandle along;  // from here on the mesh boundary into the set, if just one edge does
  };
  bool is_inside(CellHandle c) const { return c.valid() && inside_[c.idx]; }
  bool on_interface(HalfFaceHandle hf) const;
  bool on_interface(EdgeHandle e) const {
    return std::binary_search(interface_edges_.begin(), interface_edges_.end(), e);
  }
  const InterfaceVertex* find(VertexHandle v) const;
  bool find_quad(HalfFaceHandle side) const;
  VertexHandle inner(VertexHandle v) const;
  void gather_interface();
  HalfFaceHandle rim_side(HalfFaceHandle hf, EdgeHandle e) const;
  void aim(InterfaceVertex& v) const;
  HalfEdgeHandle only_boundary_edge_inside(VertexHandle v) const;
  std::vector<CellHandle> cells_to_replace() const;
  void replace(CellHandle c);
  void add_layer(const InterfaceQuad& q);
  bool is_sound() const;

  HexMesh& mesh_;
  const InsertSheetOptions& options_;
  std::vector<char> inside_;                 // by cell slot
  std::vector<InterfaceQuad> quads_;         // sorted by side
  std::vector<EdgeHandle> interface_edges_;  // sorted
  std::vector<InterfaceVertex> vertices_;    // sorted by outer
  SheetInsertion result_;
};

SheetInserter::SheetInserter(HexMesh& mesh, std::span<const CellHandle> inside,
                             const InsertSheetOptions& options)
    : mesh_(mesh), options_(options), inside_(mesh.cell_slots(), 0) {
  if (!(options.depth_rel > 0 && options.depth_rel < 1)) {
    throw InputError("depth_rel = " + std::to_string(options.depth_rel) + ", expected (0, 1)");
  }
  for (CellHandle c : inside) {
    detail::require_live(mesh, c);
    inside_[c.idx] = 1;
  }
}

bool SheetInserter::on_interface(HalfFaceHandle hf) const {
  const HalfFaceHandle other = mesh_.opposite(hf);
  return other.valid() ? !is_inside(mesh_.cell(other)) : options_.include_boundary;
}

const SheetInserter::InterfaceVertex* SheetInserter::find(VertexHandle v) const {
  const auto it = std::lower_bound(vertices_.begin(), vertices_.end(), v,
                                   [](const auto& x, VertexHandle w) { return x.outer < w; });
  return it != vertices_.end() && it->outer == v ? &*it : nullptr;
}

bool SheetInserter::find_quad(HalfFaceHandle side) const {
  const auto it = std::lower_bound(quads_.begin(), quads_.end(), side,
                                   [](const auto& q, HalfFaceHandle hf) { return q.side < hf; });
  return it != quads_.end() && it->side == side;
}

VertexHandle SheetInserter::inner(VertexHandle v) const {
  const InterfaceVertex* found = find(v);
  return found ? found->inner : v;
}

// Turns inside the set from an interface side round one of its edges, to the mesh boundary.
HalfFaceHandle SheetInserter::rim_side(HalfFaceHandle hf, EdgeHandle e) const {
  HalfFaceHandle turning = mesh_.adjacent_in_cell(hf, e);
  while (!on_interface(turning)) {
    const HalfFaceHandle other = mesh_.opposite(turning);
    if (!other.valid()) return turning;
    turning = mesh_.adjacent_in_cell(other, e);
  }
  return HalfFaceHandle();
}

void SheetInserter::gather_interface() {
  for (CellHandle c : mesh_.cells()) {
    if (!is_inside(c)) continue;
    for (HalfFaceHandle hf : mesh_.halffaces(c)) {
      if (!on_interface(hf)) continue;
      InterfaceQuad& q = quads_.emplace_back();
      q.side = hf, q.face = mesh_.face(hf), q.vertices = mesh_.vertices(hf);
      const auto edges = mesh_.edges(hf);
      for (int i = 0; i < 4; ++i) {
        q.edges[i] = mesh_.find_halfedge(q.vertices[i], q.vertices[(i + 1) % 4]);
        q.rim[i] = rim_side(hf, edges[i]);
        if (q.rim[i].valid()) q.rim_faces[i] = mesh_.face(q.rim[i]);
        interface_edges_.push_back(edges[i]);
      }
    }
  }
  detail::sort_unique(interface_edges_);
  std::vector<VertexHandle> outer;
  for (const InterfaceQuad& q : quads_)
    outer.insert(outer.end(), q.vertices.begin(), q.vertices.end());
  detail::sort_unique(outer);
  for (VertexHandle v : outer) vertices_.emplace_back().outer = v;
  for (InterfaceVertex& v : vertices_) aim(v);
}

HalfEdgeHandle SheetInserter::only_boundary_edge_inside(VertexHandle v) const {
  HalfEdgeHandle found;
  for (HalfEdgeHandle h : mesh_.halfedges(v)) {
    const EdgeHandle e = mesh_.edge(h);
    if (!mesh_.is_boundary(e) || on_interface(e)) continue;
    if (!is_inside(*mesh_.cells(e).begin())) continue;  // off the interface all its cells agree
    if (found.valid()) return HalfEdgeHandle();
    found = h;
  }
  return found;
}

// The copy of a vertex on the mesh boundary must stay on it: it goes along the edge that continues
// there, or towards the boundary faces of the set; any other one goes towards the cells of the set.
void SheetInserter::aim(InterfaceVertex& v) const {
  Vector3d cell_sum = Vector3d::Zero(), face_sum = Vector3d::Zero();
  int n_cells = 0, n_faces = 0;
  const auto cells = mesh_.cells(v.outer);
  for (auto it = cells.begin(); it != cells.end(); ++it) {
    if (!is_inside(*it)) continue;
    for (VertexHandle w : mesh_.vertices(*it)) cell_sum += mesh_.point(w) / 8;
    ++n_cells;
    const auto& x = kCornerCoords[it.slot() % 8];
    for (int a = 0; a < 3; ++a) {
      const HalfFaceHandle hf = mesh_.halfface(*it, 2 * a + x[a]);
      if (!mesh_.is_boundary(hf)) continue;
      for (VertexHandle w : mesh_.vertices(hf)) face_sum += mesh_.point(w) / 4;
      ++n_faces;
    }
  }
  v.target = cell_sum / n_cells;
  if (options_.include_boundary || n_faces == 0) return;
  v.target = face_sum / n_faces;
  v.along = only_boundary_edge_inside(v.outer);
  if (v.along.valid()) v.target = (mesh_.point(v.outer) + mesh_.point(mesh_.to(v.along))) / 2;
}

std::vector<CellHandle> SheetInserter::cells_to_replace() const {
  std::vector<CellHandle> cells;
  for (const InterfaceVertex& v : vertices_) {
    for (CellHandle c : mesh_.cells(v.outer)) {
      if (is_inside(c)) cells.push_back(c);
    }
  }
  detail::sort_unique(cells);
  return cells;
}

void SheetInserter::replace(CellHandle c) {
  CellVertices corners = mesh_.vertices(c);
  for (VertexHandle& v : corners) v = inner(v);
  std::array<HalfEdgeHandle, 12> edges;
  std::array<FaceHandle, 6> faces;
  std::array<bool, 6> covered;
  for (int k = 0; k < kHexEdges; ++k) edges[k] = detail::half_edge_of(mesh_, c, k);
  for (int s = 0; s < kSides; ++s) {
    faces[s] = mesh_.face(mesh_.halfface(c, s));
    covered[s] = find_quad(mesh_.halfface(c, s));
  }
  mesh_.delete_cell(c);
  const CellHandle after = mesh_.add_cell(corners);
  result_.replaced.push_back({c, after});
  detail::carry(mesh_, c, after);
  for (int k = 0; k < kHexEdges; ++k) {
    if (on_interface(mesh_.edge(edges[k]))) continue;  // its values stay on the outer edge
    detail::carry_edge(mesh_, edges[k], detail::half_edge_of(mesh_, after, k));
  }
  for (int s = 0; s < kSides; ++s) {
    const HalfFaceHandle to = mesh_.halfface(after, s);
    if (!covered[s]) detail::carry_side(mesh_, mesh_.halfface(c, s), faces[s], to);
  }
}

void SheetInserter::add_layer(const InterfaceQuad& q) {
  CellVertices corners;
  for (int i = 0; i < 4; ++i) {
    corners[i] = inner(q.vertices[i]);
    corners[i + 4] = q.vertices[i];
  }
  const CellHandle c = mesh_.add_cell(corners);
  result_.layer.push_back(c);
  detail::carry_side(mesh_, q.side, q.face, mesh_.halfface(c, 5));
  for (int i = 0; i < 4; ++i) {
    const VertexHandle next = q.vertices[(i + 1) % 4];
    detail::carry_edge(mesh_, q.edges[i], mesh_.find_halfedge(q.vertices[i], next));
    if (!q.rim[i].valid()) continue;
    detail::carry_side(mesh_, q.rim[i], q.rim_faces[i], mesh_.halfface(c, kSideOverEdge[i]));
  }
  for (int i = 0; i < 4; ++i) {
    const InterfaceVertex& v = *find(q.vertices[i]);
    if (!v.along.valid()) continue;
    detail::carry_edge(mesh_, v.along, mesh_.find_halfedge(v.outer, v.inner));
  }
}

bool SheetInserter::is_sound() const {
  std::vector<VertexHandle> touched;
  for (const InterfaceVertex& v : vertices_) {
    touched.push_back(v.outer);
    touched.push_back(v.inner);
  }
  return is_clean(mesh_, touched, Severity::degenerate);
}

SheetInsertion SheetInserter::run() {
  gather_interface();
  if (quads_.empty()) {
    result_.refusal = InsertRefusal::no_interface;
    return result_;
  }
  Transaction trial(mesh_);
  const auto cells = cells_to_replace();
  for (InterfaceVertex& v : vertices_) {
    const Vector3d p = mesh_.point(v.outer);
    v.inner = mesh_.add_vertex(p + options_.depth_rel * (v.target - p));
    detail::carry(mesh_, v.outer, v.inner);
    result_.copies.push_back({v.outer, v.inner});
  }
  for (CellHandle c : cells) replace(c);
  for (const InterfaceQuad& q : quads_) add_layer(q);
  if (is_sound()) {
    trial.commit();
    return std::move(result_);
  }
  trial.rollback();
  SheetInsertion refused;
  refused.refusal = InsertRefusal::not_manifold;
  return refused;
}

}  // namespace

SheetInsertion insert_sheet(HexMesh& mesh, std::span<const CellHandle> inside,
                            const InsertSheetOptions& options) {
  return SheetInserter(mesh, inside, options).run();
}

}  // namespace hexweft
