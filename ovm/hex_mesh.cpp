#include "ovm/hex_mesh.h"

#include <algorithm>

#include "ovm/errors.h"

namespace hexweft {

HexMesh::HexMesh() {
  for (auto* r : {&registries_.vertex, &registries_.edge, &registries_.half_edge, &registries_.face,
                  &registries_.half_face, &registries_.cell}) {
    *r = std::make_shared<PropertyRegistry>();
  }
}

HexMesh::HexMesh(const HexMesh& other)
    : savepoints_(other.savepoints_),
      points_(other.points_),
      vertex_live_(other.vertex_live_),
      first_corner_(other.first_corner_),
      first_half_edge_(other.first_half_edge_),
      edge_ends_(other.edge_ends_),
      half_edge_next_(other.half_edge_next_),
      first_slot_(other.first_slot_),
      face_side_(other.face_side_),
      cell_vertices_(other.cell_vertices_),
      cell_edges_(other.cell_edges_),
      corner_next_(other.corner_next_),
      slot_next_(other.slot_next_),
      mate_(other.mate_),
      side_face_(other.side_face_),
      vertex_serials_(other.vertex_serials_),
      cell_serials_(other.cell_serials_),
      counts_(other.counts_) {
  const Registries& from = other.registries_;
  registries_ = {from.vertex->clone(), from.edge->clone(),      from.half_edge->clone(),
                 from.face->clone(),   from.half_face->clone(), from.cell->clone()};
}

HexMesh& HexMesh::operator=(const HexMesh& other) {
  if (this != &other) *this = HexMesh(other);
  return *this;
}

HexMesh::Savepoints::Savepoints(const Savepoints& other) {
  if (!other.counts.empty()) throw InputError("a mesh cannot be copied inside a transaction");
}

HexMesh::Savepoints& HexMesh::Savepoints::operator=(Savepoints&& other) {
  if (!counts.empty() || !other.counts.empty()) {
    throw InputError("a mesh cannot be assigned inside a transaction");
  }
  return *this;
}

std::array<PropertyRegistry*, 6> HexMesh::Registries::all() const {
  return {vertex.get(), edge.get(), half_edge.get(), face.get(), half_face.get(), cell.get()};
}

// ---- Incidences ----

QuadVertices HexMesh::vertices(HalfFaceHandle hf) const {
  const CellVertices& v = cell_vertices_[hf.idx / 6];
  const auto& corners = kSideCorners[hf.idx % 6];
  return {v[corners[0]], v[corners[1]], v[corners[2]], v[corners[3]]};
}

std::array<EdgeHandle, 4> HexMesh::edges(HalfFaceHandle hf) const {
  const auto& e = cell_edges_[hf.idx / 6];
  const auto& side = kSideEdges[hf.idx % 6];
  return {e[side[0]], e[side[1]], e[side[2]], e[side[3]]};
}

std::array<HalfFaceHandle, 6> HexMesh::halffaces(CellHandle c) const {
  const int first = 6 * c.idx;
  return {HalfFaceHandle(first),     HalfFaceHandle(first + 1), HalfFaceHandle(first + 2),
          HalfFaceHandle(first + 3), HalfFaceHandle(first + 4), HalfFaceHandle(first + 5)};
}

VertexHandle HexMesh::other_end(EdgeHandle e, VertexHandle v) const {
  const auto& ends = edge_ends_[e.idx];
  return ends[0] == v ? ends[1] : ends[0];
}

std::array<CellHandle, 2> HexMesh::cells(FaceHandle f) const {
  const HalfFaceHandle hf = face_side_[f.idx];
  return {cell(hf), cell(opposite(hf))};
}

HalfFaceHandle HexMesh::adjacent_in_cell(HalfFaceHandle hf, EdgeHandle e) const {
  const CellHandle c = cell(hf);
  const auto& edges = cell_edges_[c.idx];
  for (int k : kSideEdges[side(hf)]) {
    if (edges[k] != e) continue;
    const auto& sides = kEdgeSides[k];
    return halfface(c, sides[0] == side(hf) ? sides[1] : sides[0]);
  }
  return HalfFaceHandle();
}

HalfFaceHandle HexMesh::adjacent_on_boundary(HalfFaceHandle hf, EdgeHandle e) const {
  HalfFaceHandle turning = adjacent_in_cell(hf, e);
  while (turning.valid() && mate_[turning.idx].valid()) {
    turning = adjacent_in_cell(mate_[turning.idx], e);
  }
  return turning;
}

std::vector<FaceHandle> HexMesh::faces(EdgeHandle e) const {
  std::vector<FaceHandle> result;
  const auto cells_of_edge = cells(e);
  for (auto it = cells_of_edge.begin(); it != cells_of_edge.end(); ++it) {
    for (int s : kEdgeSides[it.slot() % 12]) {
      const FaceHandle f = face(halfface(*it, s));
      if (std::find(result.begin(), result.end(), f) == result.end()) result.push_back(f);
    }
  }
  return result;
}

std::vector<CellHandle> HexMesh::ordered_cells(EdgeHandle e) const {
  const auto all = cells(e);
  if (all.empty()) return {};
  // Turn one way to the boundary, or all the way round; then collect turning the other way.
  const auto first = all.begin();
  HalfFaceHandle start = halfface(*first, kEdgeSides[first.slot() % 12][0]);
  for (HalfFaceHandle hf = start; mate_[hf.idx].valid();) {
    hf = adjacent_in_cell(mate_[hf.idx], e);
    if (!hf.valid() || hf == start) break;
    if (!mate_[hf.idx].valid()) start = hf;
  }
  std::vector<CellHandle> result;
  const bool open = !mate_[start.idx].valid();
  for (HalfFaceHandle hf = start;;) {
    result.push_back(cell(hf));
    hf = opposite(adjacent_in_cell(hf, e));
    if (!hf.valid() || (!open && hf == start)) return result;
  }
}

bool HexMesh::is_boundary(EdgeHandle e) const {
  const auto cells_of_edge = cells(e);
  for (auto it = cells_of_edge.begin(); it != cells_of_edge.end(); ++it) {
    for (int s : kEdgeSides[it.slot() % 12]) {
      if (is_boundary(halfface(*it, s))) return true;
    }
  }
  return false;
}

bool HexMesh::is_boundary(VertexHandle v) const {
  const auto cells_of_vertex = cells(v);
  for (auto it = cells_of_vertex.begin(); it != cells_of_vertex.end(); ++it) {
    const auto& x = kCornerCoords[it.slot() % 8];
    for (int a = 0; a < 3; ++a) {
      if (is_boundary(halfface(*it, 2 * a + x[a]))) return true;
    }
  }
  return false;
}

bool HexMesh::is_boundary(CellHandle c) const {
  for (HalfFaceHandle hf : halffaces(c)) {
    if (is_boundary(hf)) return true;
  }
  return false;
}

std::vector<HalfFaceHandle> HexMesh::boundary_halffaces() const {
  std::vector<HalfFaceHandle> result;
  for (CellHandle c : cells()) {
    for (HalfFaceHandle hf : halffaces(c)) {
      if (is_boundary(hf)) result.push_back(hf);
    }
  }
  return result;
}

// ---- Search ----

HalfEdgeHandle HexMesh::find_halfedge(VertexHandle a, VertexHandle b) const {
  for (HalfEdgeHandle h : halfedges(a)) {
    if (to(h) == b) return h;
  }
  return HalfEdgeHandle();
}

EdgeHandle HexMesh::find_edge(VertexHandle a, VertexHandle b) const {
  const HalfEdgeHandle h = find_halfedge(a, b);
  return EdgeHandle(h.valid() ? h.idx / 2 : -1);
}

namespace {
bool same_vertices(const QuadVertices& a, const QuadVertices& b) {
  return std::all_of(a.begin(), a.end(), [&](VertexHandle v) {
    return v == b[0] || v == b[1] || v == b[2] || v == b[3];
  });
}
}  // namespace

HalfFaceHandle HexMesh::find_halfface(const QuadVertices& vertices_of_quad) const {
  // Only one of the others is across from the first; an edge to it, if any, is of other faces.
  for (int i = 1; i < 3; ++i) {
    const EdgeHandle e = find_edge(vertices_of_quad[0], vertices_of_quad[i]);
    if (!e.valid()) continue;
    const auto cells_of_edge = cells(e);
    for (auto it = cells_of_edge.begin(); it != cells_of_edge.end(); ++it) {
      for (int s : kEdgeSides[it.slot() % 12]) {
        const HalfFaceHandle hf = halfface(*it, s);
        if (same_vertices(vertices(hf), vertices_of_quad)) return hf;
      }
    }
  }
  return HalfFaceHandle();
}

int HexMesh::corner_of(CellHandle c, VertexHandle v) const {
  const CellVertices& corners = cell_vertices_[c.idx];
  const auto it = std::find(corners.begin(), corners.end(), v);
  return it == corners.end() ? -1 : static_cast<int>(it - corners.begin());
}

// ---- Savepoints ----

template <class F>
void HexMesh::for_each_array(F&& f) {
  f(points_), f(vertex_live_), f(first_corner_), f(first_half_edge_);
  f(edge_ends_), f(half_edge_next_), f(first_slot_), f(face_side_);
  f(cell_vertices_), f(cell_edges_), f(corner_next_), f(slot_next_), f(mate_), f(side_face_);
}

void HexMesh::open_savepoint() {
  for_each_array([](auto& a) { a.open_savepoint(); });
  for (PropertyRegistry* r : registries_.all()) r->open_savepoint();
  savepoints_.counts.push_back(counts_);
}

void HexMesh::rollback() {
  for_each_array([](auto& a) { a.rollback(); });
  for (PropertyRegistry* r : registries_.all()) r->rollback();
  counts_ = savepoints_.counts.back();
  savepoints_.counts.pop_back();
}

void HexMesh::commit() {
  for_each_array([](auto& a) { a.commit(); });
  for (PropertyRegistry* r : registries_.all()) r->commit();
  savepoints_.counts.pop_back();
}

// ---- Property registries by tag ----

template <>
const std::shared_ptr<PropertyRegistry>& property_registry<VertexTag>(const HexMesh& m) {
  return m.registries_.vertex;
}
template <>
const std::shared_ptr<PropertyRegistry>& property_registry<EdgeTag>(const HexMesh& m) {
  return m.registries_.edge;
}
template <>
const std::shared_ptr<PropertyRegistry>& property_registry<HalfEdgeTag>(const HexMesh& m) {
  return m.registries_.half_edge;
}
template <>
const std::shared_ptr<PropertyRegistry>& property_registry<FaceTag>(const HexMesh& m) {
  return m.registries_.face;
}
template <>
const std::shared_ptr<PropertyRegistry>& property_registry<HalfFaceTag>(const HexMesh& m) {
  return m.registries_.half_face;
}
template <>
const std::shared_ptr<PropertyRegistry>& property_registry<CellTag>(const HexMesh& m) {
  return m.registries_.cell;
}

}  // namespace hexweft
