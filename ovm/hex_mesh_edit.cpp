// The edits of HexMesh: each leaves every incidence current.
#include <algorithm>
#include <limits>
#include <numeric>
#include <string>

#include "ovm/detail/require_live.h"
#include "ovm/errors.h"
#include "ovm/hex_mesh.h"
#include "ovm/transaction.h"

namespace hexweft {
namespace {

// Takes a slot out of the singly linked list that starts at heads[head].
void unlink(JournaledArray<int>& heads, int head, JournaledArray<int>& next, int slot) {
  if (heads[head] == slot) {
    heads.set(head, next[slot]);
    return;
  }
  int before = heads[head];
  while (next[before] != slot) before = next[before];
  next.set(before, next[slot]);
}

void link_first(JournaledArray<int>& heads, int head, JournaledArray<int>& next, int slot) {
  next.set(slot, heads[head]);
  heads.set(head, slot);
}

bool same_vertices(QuadVertices a, QuadVertices b) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  return a == b;
}

// Incidences are numbered 12c + edge of the cell and 2e + end of the edge, as int.
void require_room(int cell_slots, int edge_slots) {
  constexpr int kMost = std::numeric_limits<int>::max();
  if (cell_slots <= kMost / kHexEdges && edge_slots <= kMost / 2) return;
  throw InputError("a mesh has room for " + std::to_string(kMost / kHexEdges) + " cells and " +
                   std::to_string(kMost / 2) + " edges, gaps of deleted ones among them; not for " +
                   std::to_string(cell_slots) + " and " + std::to_string(edge_slots));
}

}  // namespace

void HexMesh::reserve(int vertices, int cells) {
  require_room(cells, 0);
  points_.reserve(vertices);
  vertex_live_.reserve(vertices);
  first_corner_.reserve(vertices);
  first_half_edge_.reserve(vertices);
  cell_vertices_.reserve(cells);
  cell_edges_.reserve(cells);
  corner_next_.reserve(8 * cells);
  slot_next_.reserve(12 * cells);
  mate_.reserve(6 * cells);
  side_face_.reserve(6 * cells);
}

VertexHandle HexMesh::add_vertex(const Eigen::Vector3d& p) {
  points_.push_back(p);
  vertex_live_.push_back(true);
  first_corner_.push_back(-1);
  first_half_edge_.push_back(-1);
  ++counts_.vertices;
  registries_.vertex->grow(vertex_slots());
  return VertexHandle(vertex_slots() - 1);
}

EdgeHandle HexMesh::find_or_add_edge(VertexHandle a, VertexHandle b) {
  if (const EdgeHandle found = find_edge(a, b); found.valid()) return found;
  const EdgeHandle e(edge_slots());
  edge_ends_.push_back({a, b});
  half_edge_next_.push_back(-1);
  half_edge_next_.push_back(-1);
  first_slot_.push_back(-1);
  link_first(first_half_edge_, a.idx, half_edge_next_, 2 * e.idx);
  link_first(first_half_edge_, b.idx, half_edge_next_, 2 * e.idx + 1);
  ++counts_.edges;
  registries_.edge->grow(edge_slots());
  registries_.half_edge->grow(2 * edge_slots());
  return e;
}

void HexMesh::unlink_edge(EdgeHandle e) {
  const auto ends = edge_ends_[e.idx];
  for (int end = 0; end < 2; ++end) {
    unlink(first_half_edge_, ends[end].idx, half_edge_next_, 2 * e.idx + end);
  }
  edge_ends_.set(e.idx, {VertexHandle(), VertexHandle()});
  --counts_.edges;
}

FaceHandle HexMesh::add_face(HalfFaceHandle hf) {
  face_side_.push_back(hf);
  ++counts_.faces;
  registries_.face->grow(face_slots());
  return FaceHandle(face_slots() - 1);
}

void HexMesh::mate(HalfFaceHandle a, HalfFaceHandle b) {
  mate_.set(a.idx, b);
  mate_.set(b.idx, a);
  const FaceHandle keep = std::min(side_face_[a.idx], side_face_[b.idx]);
  const FaceHandle drop = std::max(side_face_[a.idx], side_face_[b.idx]);
  side_face_.set(a.idx, keep);
  side_face_.set(b.idx, keep);
  face_side_.set(drop.idx, HalfFaceHandle());
  --counts_.faces;
}

// Where two or more candidates wait (a mesh that is not conforming) the first in the list is taken.
HalfFaceHandle HexMesh::waiting_mate(HalfFaceHandle hf) const {
  const QuadVertices quad = vertices(hf);
  const auto candidates = cells(edges(hf)[0]);
  for (auto it = candidates.begin(); it != candidates.end(); ++it) {
    if (*it == cell(hf)) continue;
    for (int s : kEdgeSides[it.slot() % 12]) {
      const HalfFaceHandle other = halfface(*it, s);
      if (!mate_[other.idx].valid() && same_vertices(vertices(other), quad)) return other;
    }
  }
  return HalfFaceHandle();
}

CellHandle HexMesh::add_cell(CellVertices v) {
  for (int i = 0; i < 8; ++i) {
    if (!detail::is_live(*this, v[i]) ||
        std::find(v.begin(), v.begin() + i, v[i]) != v.begin() + i) {
      throw InputError("a cell needs 8 different vertices of the mesh; corner " +
                       std::to_string(i) + " is vertex " + std::to_string(v[i].idx));
    }
  }
  require_room(cell_slots() + 1, edge_slots() + kHexEdges);
  const CellHandle c(cell_slots());
  cell_vertices_.push_back(v);
  corner_next_.resize(8 * cell_slots(), -1);
  slot_next_.resize(12 * cell_slots(), -1);
  mate_.resize(6 * cell_slots(), HalfFaceHandle());
  side_face_.resize(6 * cell_slots(), FaceHandle());
  for (int i = 0; i < 8; ++i) link_first(first_corner_, v[i].idx, corner_next_, 8 * c.idx + i);
  std::array<EdgeHandle, 12> cell_edge;
  for (int k = 0; k < 12; ++k) {
    cell_edge[k] = find_or_add_edge(v[kEdgeCorners[k][0]], v[kEdgeCorners[k][1]]);
    link_first(first_slot_, cell_edge[k].idx, slot_next_, 12 * c.idx + k);
  }
  cell_edges_.push_back(cell_edge);
  for (int s = 0; s < 6; ++s) {
    const HalfFaceHandle hf = halfface(c, s);
    if (const HalfFaceHandle other = waiting_mate(hf); other.valid()) {
      side_face_.set(hf.idx, side_face_[other.idx]);
      mate_.set(hf.idx, other);
      mate_.set(other.idx, hf);
    } else {
      side_face_.set(hf.idx, add_face(hf));
    }
  }
  ++counts_.cells;
  registries_.half_face->grow(6 * cell_slots());
  registries_.cell->grow(cell_slots());
  return c;
}

void HexMesh::delete_cell(CellHandle c) {
  detail::require_live(*this, c);
  const CellVertices v = cell_vertices_[c.idx];
  for (int i = 0; i < 8; ++i) unlink(first_corner_, v[i].idx, corner_next_, 8 * c.idx + i);
  for (int s = 0; s < 6; ++s) {
    const HalfFaceHandle hf = halfface(c, s);
    const FaceHandle f = side_face_[hf.idx];
    const HalfFaceHandle other = mate_[hf.idx];
    if (other.valid()) {
      mate_.set(other.idx, HalfFaceHandle());
      mate_.set(hf.idx, HalfFaceHandle());
    } else {
      --counts_.faces;
    }
    face_side_.set(f.idx, other);
  }
  for (int k = 0; k < 12; ++k) {
    const EdgeHandle e = cell_edges_[c.idx][k];
    unlink(first_slot_, e.idx, slot_next_, 12 * c.idx + k);
    if (first_slot_[e.idx] < 0) unlink_edge(e);
  }
  cell_vertices_.at(c.idx)[0] = VertexHandle();
  --counts_.cells;
}

void HexMesh::delete_vertex(VertexHandle v) {
  detail::require_live(*this, v);
  if (first_corner_[v.idx] >= 0) {
    throw InputError(detail::name(v) + " cannot be deleted: a cell uses it");
  }
  vertex_live_.set(v.idx, false);
  --counts_.vertices;
}

void HexMesh::merge_edge(EdgeHandle keep, EdgeHandle drop) {
  for (int slot = first_slot_[drop.idx]; slot >= 0;) {
    const int next = slot_next_[slot];
    cell_edges_.at(slot / 12)[slot % 12] = keep;
    link_first(first_slot_, keep.idx, slot_next_, slot);
    slot = next;
  }
  first_slot_.set(drop.idx, -1);
  unlink_edge(drop);
}

void HexMesh::merge_vertex(VertexMerge m) {
  detail::require_live(*this, m.keep);
  detail::require_live(*this, m.drop);
  if (m.keep == m.drop) throw InputError(detail::name(m.keep) + " cannot merge with itself");
  for (CellHandle c : cells(m.drop)) {
    if (corner_of(c, m.keep) >= 0) {
      throw InputError(detail::name(m.keep) + " and " + detail::name(m.drop) +
                       " cannot merge: " + detail::name(c) + " has both");
    }
  }
  for (int corner = first_corner_[m.drop.idx]; corner >= 0;) {
    const int next = corner_next_[corner];
    cell_vertices_.at(corner / 8)[corner % 8] = m.keep;
    link_first(first_corner_, m.keep.idx, corner_next_, corner);
    corner = next;
  }
  first_corner_.set(m.drop.idx, -1);
  for (int half = first_half_edge_[m.drop.idx]; half >= 0;) {
    const int next = half_edge_next_[half];
    const EdgeHandle e(half / 2);
    const EdgeHandle twin = find_edge(m.keep, other_end(e, m.drop));
    if (twin.valid()) {
      merge_edge(twin, e);
    } else {
      unlink(first_half_edge_, m.drop.idx, half_edge_next_, half);
      edge_ends_.at(e.idx)[half % 2] = m.keep;
      link_first(first_half_edge_, m.keep.idx, half_edge_next_, half);
    }
    half = next;
  }
  delete_vertex(m.drop);
}

void HexMesh::merge_vertices(std::span<const VertexMerge> merges) {
  Transaction all_or_nothing(*this);
  for (const VertexMerge& m : merges) merge_vertex(m);
  for (const VertexMerge& m : merges) {
    if (!is_live(m.keep)) throw InputError(detail::name(m.keep) + " cannot be kept and dropped");
    const auto touched = cells(m.keep);
    for (auto it = touched.begin(); it != touched.end(); ++it) {
      const auto& x = kCornerCoords[it.slot() % 8];
      for (int a = 0; a < 3; ++a) {
        const HalfFaceHandle hf = halfface(*it, 2 * a + x[a]);
        if (!is_boundary(hf)) continue;
        if (const HalfFaceHandle other = waiting_mate(hf); other.valid()) mate(hf, other);
      }
    }
  }
  all_or_nothing.commit();
}

namespace {

// New index of each kept element, -1 for the others.
std::vector<int> inverse(const std::vector<int>& old_of_new, int n_old) {
  std::vector<int> new_of_old(n_old, -1);
  for (std::size_t i = 0; i < old_of_new.size(); ++i)
    new_of_old[old_of_new[i]] = static_cast<int>(i);
  return new_of_old;
}

std::vector<int> times(const std::vector<int>& elements, int slots) {
  std::vector<int> result;
  result.reserve(elements.size() * slots);
  for (int e : elements) {
    for (int k = 0; k < slots; ++k) result.push_back(slots * e + k);
  }
  return result;
}

template <class Range>
std::vector<int> live(const Range& range) {
  std::vector<int> result;
  for (auto h : range) result.push_back(h.idx);
  return result;
}

// Renumbers slot indices (slots per element) held in an array.
void renumber(JournaledArray<int>& slots_held, const std::vector<int>& new_of_old, int slots) {
  for (int i = 0; i < slots_held.size(); ++i)
    slots_held.set(i, detail::renumbered(new_of_old, slots_held[i], slots));
}

}  // namespace

Renumbering HexMesh::collect_garbage() {
  if (depth() > 0) throw InputError("garbage cannot be collected inside a transaction");
  const auto kept_v = live(vertices()), kept_e = live(edges());
  const auto kept_f = live(faces()), kept_c = live(cells());
  Renumbering now = {inverse(kept_v, vertex_slots()), inverse(kept_e, edge_slots()),
                     inverse(kept_f, face_slots()), inverse(kept_c, cell_slots())};
  const auto kept_half_e = times(kept_e, 2), kept_half_f = times(kept_c, 6);
  vertex_serials_.keep(kept_v, vertex_slots());
  cell_serials_.keep(kept_c, cell_slots());

  points_.keep(kept_v), vertex_live_.keep(kept_v);
  first_corner_.keep(kept_v), first_half_edge_.keep(kept_v);
  edge_ends_.keep(kept_e), half_edge_next_.keep(kept_half_e), first_slot_.keep(kept_e);
  face_side_.keep(kept_f);
  cell_vertices_.keep(kept_c), cell_edges_.keep(kept_c);
  corner_next_.keep(times(kept_c, 8)), slot_next_.keep(times(kept_c, 12));
  mate_.keep(kept_half_f), side_face_.keep(kept_half_f);

  renumber(first_corner_, now.cells, 8), renumber(corner_next_, now.cells, 8);
  renumber(first_slot_, now.cells, 12), renumber(slot_next_, now.cells, 12);
  renumber(first_half_edge_, now.edges, 2), renumber(half_edge_next_, now.edges, 2);
  for (int i = 0; i < mate_.size(); ++i) {
    mate_.set(i, now[mate_[i]]);
    side_face_.set(i, now[side_face_[i]]);
  }
  for (int i = 0; i < face_side_.size(); ++i) face_side_.set(i, now[face_side_[i]]);
  for (int i = 0; i < edge_ends_.size(); ++i) {
    for (VertexHandle& v : edge_ends_.at(i)) v = now[v];
  }
  for (int i = 0; i < cell_vertices_.size(); ++i) {
    for (VertexHandle& v : cell_vertices_.at(i)) v = now[v];
    for (EdgeHandle& e : cell_edges_.at(i)) e = now[e];
  }
  registries_.vertex->keep(kept_v);
  registries_.edge->keep(kept_e);
  registries_.half_edge->keep(kept_half_e);
  registries_.face->keep(kept_f);
  registries_.half_face->keep(kept_half_f);
  registries_.cell->keep(kept_c);
  return now;
}

}  // namespace hexweft
