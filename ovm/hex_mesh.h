/// \file
/// The half-face kernel: a hexahedral mesh with all its incidences, editable in place.
///
/// Cells hold 8 vertices and own 6 half-faces (6c + k, normals outward); a half-face knows the
/// half-face it is glued to, its mate. Edges and faces have handles and properties of their own and
/// live as long as a cell uses them. Storage is flat: vertex-to-cells, vertex-to-edges and
/// edge-to-cells are linked lists threaded through arrays. Elements are deleted lazily; handles
/// stay as they are until collect_garbage(), which tells the new ones and keeps serial numbers.
///
///     HexMesh mesh = make_grid({4, 3, 2});
///     for (CellHandle c : mesh.cells())
///       for (HalfFaceHandle hf : mesh.halffaces(c))
///         if (CellHandle n = mesh.cell(mesh.opposite(hf)); n.valid()) ...
///
/// Edits are undone by a Transaction (transaction.h). The kernel can hold meshes that are not
/// valid; check_topology() (topology_check.h) says what is wrong with one.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "ovm/detail/serial_numbers.h"
#include "ovm/handles.h"
#include "ovm/hex_numbering.h"
#include "ovm/journaled_array.h"
#include "ovm/property.h"
#include "ovm/ranges.h"
#include "ovm/renumbering.h"

namespace hexweft {

using CellVertices = std::array<VertexHandle, 8>;  ///< in VTK order, see hex_numbering.h
using QuadVertices = std::array<VertexHandle, 4>;  ///< in cyclic order

/// Vertex `drop` becomes `keep`.
struct VertexMerge {
  VertexHandle keep, drop;
};

class HexMesh {
 public:
  // ---- A mesh inside a transaction is not copied or assigned, to or from: InputError is thrown and
  // both are as before. Nor may another be constructed by moving it. A mesh moved from is only to be
  // assigned or destroyed. Property objects do not go along with an assignment, see property.h. ----
  HexMesh();
  HexMesh(const HexMesh& other);  ///< named properties are copied, private ones stay behind
  HexMesh(HexMesh&&) noexcept = default;
  HexMesh& operator=(const HexMesh& other);
  HexMesh& operator=(HexMesh&&) = default;

  // ---- Counts and ranges of live elements; *_slots() also counts the deleted ones ----
  int n_vertices() const { return counts_.vertices; }
  int n_edges() const { return counts_.edges; }
  int n_faces() const { return counts_.faces; }
  int n_cells() const { return counts_.cells; }
  int vertex_slots() const { return points_.size(); }
  int edge_slots() const { return edge_ends_.size(); }
  int face_slots() const { return face_side_.size(); }
  int cell_slots() const { return cell_vertices_.size(); }

  bool is_live(VertexHandle v) const { return vertex_live_[v.idx]; }
  bool is_live(EdgeHandle e) const { return edge_ends_[e.idx][0].valid(); }
  bool is_live(FaceHandle f) const { return face_side_[f.idx].valid(); }
  bool is_live(CellHandle c) const { return cell_vertices_[c.idx][0].valid(); }

  LiveRange<VertexHandle, HexMesh> vertices() const { return {this, vertex_slots()}; }
  LiveRange<EdgeHandle, HexMesh> edges() const { return {this, edge_slots()}; }
  LiveRange<FaceHandle, HexMesh> faces() const { return {this, face_slots()}; }
  LiveRange<CellHandle, HexMesh> cells() const { return {this, cell_slots()}; }

  // ---- Geometry ----
  const Eigen::Vector3d& point(VertexHandle v) const { return points_[v.idx]; }
  void set_point(VertexHandle v, const Eigen::Vector3d& p) { points_.set(v.idx, p); }

  // ---- Downward incidences ----
  const CellVertices& vertices(CellHandle c) const { return cell_vertices_[c.idx]; }
  const std::array<VertexHandle, 2>& vertices(EdgeHandle e) const { return edge_ends_[e.idx]; }
  QuadVertices vertices(HalfFaceHandle hf) const;  ///< counter-clockwise seen from outside its cell
  QuadVertices vertices(FaceHandle f) const { return vertices(halfface(f)); }
  const std::array<EdgeHandle, 12>& edges(CellHandle c) const { return cell_edges_[c.idx]; }
  std::array<EdgeHandle, 4> edges(HalfFaceHandle hf) const;  ///< edge i joins vertices i and i + 1
  std::array<EdgeHandle, 4> edges(FaceHandle f) const { return edges(halfface(f)); }
  std::array<HalfFaceHandle, 6> halffaces(CellHandle c) const;
  HalfFaceHandle halfface(CellHandle c, int side) const { return HalfFaceHandle(6 * c.idx + side); }
  VertexHandle from(HalfEdgeHandle h) const { return edge_ends_[h.idx / 2][h.idx % 2]; }
  VertexHandle to(HalfEdgeHandle h) const { return edge_ends_[h.idx / 2][1 - h.idx % 2]; }
  EdgeHandle edge(HalfEdgeHandle h) const { return EdgeHandle(h.idx / 2); }
  VertexHandle other_end(EdgeHandle e, VertexHandle v) const;

  // ---- Half-faces ----
  /// The half-face glued to this one; invalid on the boundary and for an invalid handle.
  HalfFaceHandle opposite(HalfFaceHandle hf) const {
    return hf.valid() ? mate_[hf.idx] : HalfFaceHandle();
  }
  CellHandle cell(HalfFaceHandle hf) const { return CellHandle(hf.valid() ? hf.idx / 6 : -1); }
  static int side(HalfFaceHandle hf) { return hf.idx % 6; }
  FaceHandle face(HalfFaceHandle hf) const { return side_face_[hf.idx]; }
  HalfFaceHandle halfface(FaceHandle f) const { return face_side_[f.idx]; }  ///< one of its sides
  std::array<CellHandle, 2> cells(FaceHandle f) const;  ///< the second is invalid on the boundary
  /// The other half-face of the same cell at this edge.
  HalfFaceHandle adjacent_in_cell(HalfFaceHandle hf, EdgeHandle e) const;
  /// The boundary half-face met first when turning from boundary half-face hf round edge e.
  HalfFaceHandle adjacent_on_boundary(HalfFaceHandle hf, EdgeHandle e) const;

  // ---- Upward incidences, in no particular order ----
  ListRange<CellHandle, 8> cells(VertexHandle v) const {
    return {&corner_next_, first_corner_[v.idx]};
  }
  ListRange<CellHandle, 12> cells(EdgeHandle e) const { return {&slot_next_, first_slot_[e.idx]}; }
  ListRange<EdgeHandle, 2> edges(VertexHandle v) const {
    return {&half_edge_next_, first_half_edge_[v.idx]};
  }
  ListRange<HalfEdgeHandle, 1> halfedges(VertexHandle v) const {  ///< those that start at v
    return {&half_edge_next_, first_half_edge_[v.idx]};
  }
  std::vector<FaceHandle> faces(EdgeHandle e) const;
  /// The cells round e in turning order, from boundary to boundary where e is on it.
  /// Follows one fan only: on a mesh that is not manifold it may miss cells.
  std::vector<CellHandle> ordered_cells(EdgeHandle e) const;
  int valence(EdgeHandle e) const { return cells(e).size(); }  ///< number of cells at e

  // ---- Boundary: touching a half-face without mate ----
  bool is_boundary(HalfFaceHandle hf) const { return !mate_[hf.idx].valid(); }
  bool is_boundary(FaceHandle f) const { return is_boundary(face_side_[f.idx]); }
  bool is_boundary(EdgeHandle e) const;
  bool is_boundary(VertexHandle v) const;
  bool is_boundary(CellHandle c) const;
  std::vector<HalfFaceHandle> boundary_halffaces() const;

  // ---- Search; the result is invalid if there is none ----
  EdgeHandle find_edge(VertexHandle a, VertexHandle b) const;
  HalfEdgeHandle find_halfedge(VertexHandle from, VertexHandle to) const;
  /// A half-face with these four vertices, in any order.
  HalfFaceHandle find_halfface(const QuadVertices& vertices) const;
  int corner_of(CellHandle c, VertexHandle v) const;  ///< -1 if v is no corner of c

  // ---- Edits: all keep every incidence current; use inside a Transaction to be able to undo.
  // Handles are those of live elements, or InputError is thrown and the mesh is as before ----
  VertexHandle add_vertex(const Eigen::Vector3d& p);
  /// Faces are glued where a half-face with the same vertices waits for a mate.
  /// \throws InputError unless the 8 vertices are live and different, and where the numbers of
  ///         incidences outgrow int: beyond 178 million cells or 1,073 million edges, gaps included
  CellHandle add_cell(CellVertices vertices);  // by value: it may come out of this very mesh
  void delete_cell(CellHandle c);      ///< edges and faces that no cell uses go too; vertices stay
  void delete_vertex(VertexHandle v);  ///< \throws InputError if a cell uses it
  /// Relabels vertices, in this order, and glues the half-faces that have come to lie on another.
  /// Of two edges that fall together the one at `keep` survives, of two faces the lower handle.
  /// A vertex may be kept by many pairs, but one that is dropped is in no other pair.
  /// \throws InputError if it is, or a cell has both vertices of a pair; the mesh is then as before
  void merge_vertices(std::span<const VertexMerge> merges);
  void reserve(int vertices, int cells);  ///< \throws InputError for more than add_cell() can add

  /// Closes the gaps of deleted elements; all handles change but for their order, properties follow.
  /// \return the new handles
  /// \throws InputError inside a transaction
  Renumbering collect_garbage();
  /// The index that the handle would have if no gap had ever been closed: it stays with the element, to
  /// know it again by. Copies of the mesh have the same.
  int serial(VertexHandle v) const { return vertex_serials_[v.idx]; }
  int serial(CellHandle c) const { return cell_serials_[c.idx]; }

 private:
  friend class Transaction;
  template <class Tag>
  friend const std::shared_ptr<PropertyRegistry>& property_registry(const HexMesh& mesh);
  struct Counts {
    int vertices = 0, edges = 0, faces = 0, cells = 0;
  };
  /// The counts when each savepoint was opened. What refuses copies and assignments while there are
  /// any, hence the first of the members.
  struct Savepoints {
    Savepoints() = default;
    Savepoints(const Savepoints& other);
    Savepoints(Savepoints&&) noexcept = default;
    Savepoints& operator=(Savepoints&& other);
    std::vector<Counts> counts;
  };
  /// Visits every array of the mesh (for savepoints and compaction).
  template <class F>
  void for_each_array(F&& f);
  void open_savepoint();
  void rollback();
  void commit();
  int depth() const { return static_cast<int>(savepoints_.counts.size()); }

  EdgeHandle find_or_add_edge(VertexHandle a, VertexHandle b);
  void unlink_edge(EdgeHandle e);
  void mate(HalfFaceHandle a, HalfFaceHandle b);
  HalfFaceHandle waiting_mate(HalfFaceHandle hf) const;
  FaceHandle add_face(HalfFaceHandle hf);
  void merge_vertex(VertexMerge m);
  void merge_edge(EdgeHandle keep, EdgeHandle drop);

  Savepoints savepoints_;
  JournaledArray<Eigen::Vector3d> points_;
  JournaledArray<bool> vertex_live_;
  JournaledArray<int> first_corner_;     // per vertex: 8c + corner
  JournaledArray<int> first_half_edge_;  // per vertex: 2e + end
  JournaledArray<std::array<VertexHandle, 2>> edge_ends_;
  JournaledArray<int> half_edge_next_;  // 2 per edge
  JournaledArray<int> first_slot_;      // per edge: 12c + edge of the cell
  JournaledArray<HalfFaceHandle> face_side_;
  JournaledArray<CellVertices> cell_vertices_;
  JournaledArray<std::array<EdgeHandle, 12>> cell_edges_;
  JournaledArray<int> corner_next_;       // 8 per cell
  JournaledArray<int> slot_next_;         // 12 per cell
  JournaledArray<HalfFaceHandle> mate_;   // 6 per cell
  JournaledArray<FaceHandle> side_face_;  // 6 per cell
  detail::SerialNumbers vertex_serials_, cell_serials_;
  Counts counts_;
  struct Registries {
    std::shared_ptr<PropertyRegistry> vertex, edge, half_edge, face, half_face, cell;
    std::array<PropertyRegistry*, 6> all() const;
  } registries_;
};

}  // namespace hexweft
