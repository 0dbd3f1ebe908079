/// \file
/// Everything a mesh says about itself, as numbers, the order of every list included.
#pragma once

#include <vector>

#include "ovm/hex_mesh.h"

namespace hexweft {

class MeshDump {
 public:
  explicit MeshDump(const HexMesh& mesh) {
    add(mesh.n_vertices(), mesh.n_edges(), mesh.n_faces(), mesh.n_cells());
    add(mesh.vertex_slots(), mesh.edge_slots(), mesh.face_slots(), mesh.cell_slots());
    for (VertexHandle v : mesh.vertices()) {
      add(v);
      for (double x : mesh.point(v)) numbers_.push_back(x);
      add_all(mesh.cells(v));
      add_all(mesh.edges(v));
    }
    for (EdgeHandle e : mesh.edges()) {
      add(e);
      add_all(mesh.vertices(e));
      add_all(mesh.cells(e));
    }
    for (FaceHandle f : mesh.faces()) add(f, mesh.halfface(f));
    for (CellHandle c : mesh.cells()) {
      add(c);
      add_all(mesh.vertices(c));
      add_all(mesh.edges(c));
      for (HalfFaceHandle hf : mesh.halffaces(c)) add(mesh.opposite(hf), mesh.face(hf));
    }
  }
  friend bool operator==(const MeshDump&, const MeshDump&) = default;

 private:
  void add_one(int i) { numbers_.push_back(i); }
  template <class Tag>
  void add_one(Handle<Tag> h) {
    numbers_.push_back(h.idx);
  }
  template <class... T>
  void add(T... values) {
    (add_one(values), ...);
  }
  template <class Range>
  void add_all(const Range& range) {
    for (auto h : range) add_one(h);
    add_one(-2);  // so that lists cannot run into each other
  }
  std::vector<double> numbers_;
};

}  // namespace hexweft
