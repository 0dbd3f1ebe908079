#include "ovm/topology_check.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <sstream>
#include <tuple>

namespace hexweft {
namespace {

bool same_vertices(const QuadVertices& a, const QuadVertices& b) {
  return std::all_of(a.begin(), a.end(),
                     [&](VertexHandle v) { return std::find(b.begin(), b.end(), v) != b.end(); });
}

// True if b names the vertices of a in the opposite direction.
bool reversed(const QuadVertices& a, const QuadVertices& b) {
  const auto at = std::find(b.begin(), b.end(), a[0]) - b.begin();
  if (at == 4) return false;
  for (int i = 1; i < 4; ++i) {
    if (a[i] != b[(at + 4 - i) % 4]) return false;
  }
  return true;
}

// "6, 7 and 8"
std::string list_of(std::span<const VertexHandle> vertices) {
  std::string list;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const bool is_last = i + 1 == vertices.size();
    list += (i == 0 ? "" : is_last ? " and " : ", ") + std::to_string(vertices[i].idx);
  }
  return list;
}

// Vertices and cells have the numbers of a file; those of edges and faces stand nowhere.
std::string name(const HexMesh&, VertexHandle v) { return "vertex " + std::to_string(v.idx); }
std::string name(const HexMesh& mesh, EdgeHandle e) {
  return "the edge between vertices " + list_of(mesh.vertices(e));
}
std::string name(const HexMesh& mesh, FaceHandle f) {
  return "the face of vertices " + list_of(mesh.vertices(f));
}
std::string name(const HexMesh&, CellHandle c) { return "cell " + std::to_string(c.idx); }

VertexHandle first_vertex(const HexMesh&, VertexHandle v) { return v; }
template <class HandleT>
VertexHandle first_vertex(const HexMesh& mesh, HandleT h) {
  return mesh.vertices(h)[0];
}

// Where an element is. A file of which unused points were left out has other numbers.
template <class HandleT>
std::string place(const HexMesh& mesh, HandleT h) {
  const Eigen::Vector3d p = mesh.point(first_vertex(mesh, h));
  std::ostringstream text;
  text << "at (" << p.x() << ", " << p.y() << ", " << p.z() << ")";
  return text.str();
}

// Looks at one element at a time; the buffers are kept between calls.
class TopologyChecker {
 public:
  explicit TopologyChecker(const HexMesh& mesh) : mesh_(mesh) {}

  void check(CellHandle c);
  void check(EdgeHandle e);
  void check(VertexHandle v);
  const std::vector<TopologyViolation>& violations() const { return violations_; }
  std::vector<TopologyViolation> take();

 private:
  struct LinkEdge {  // a face at the vertex, as an edge of its link
    EdgeHandle a, b;
    FaceHandle face;
  };
  template <class HandleT>
  void report(TopologyDefect defect, HandleT h, const std::string& what) {
    violations_.push_back({defect, h.idx, name(mesh_, h) + ", " + place(mesh_, h) + ", " + what});
  }
  void check_boundary_side(HalfFaceHandle hf);
  void gather_link(VertexHandle v);
  void check_link_edges(VertexHandle v);
  bool link_is_connected();

  const HexMesh& mesh_;
  std::vector<TopologyViolation> violations_;
  std::vector<CellHandle> link_cells_;
  std::vector<LinkEdge> link_edges_;  // one per half-face pair
  std::vector<int> reached_, stack_;
  std::vector<std::array<CellHandle, 3>> link_neighbors_;
  bool on_boundary_ = false;
};

// A half-face that waits for a mate must not lie on another half-face.
void TopologyChecker::check_boundary_side(HalfFaceHandle hf) {
  const QuadVertices quad = mesh_.vertices(hf);
  const auto candidates = mesh_.cells(mesh_.edges(hf)[0]);
  for (auto it = candidates.begin(); it != candidates.end(); ++it) {
    for (int s : kEdgeSides[it.slot() % 12]) {
      const HalfFaceHandle other = mesh_.halfface(*it, s);
      if (other == hf || !same_vertices(mesh_.vertices(other), quad)) continue;
      report(TopologyDefect::nonconforming_face, mesh_.face(hf),
             "is a side of " + name(mesh_, mesh_.cell(hf)) +
                 " and lies on another that has its two cells already");
      return;
    }
  }
}

void TopologyChecker::check(CellHandle c) {
  std::array<CellHandle, 6> neighbor;
  for (int s = 0; s < 6; ++s) {
    const HalfFaceHandle hf = mesh_.halfface(c, s), other = mesh_.opposite(hf);
    neighbor[s] = mesh_.cell(other);
    if (!other.valid()) {
      check_boundary_side(hf);
      continue;
    }
    if (hf < other && !reversed(mesh_.vertices(hf), mesh_.vertices(other))) {
      report(TopologyDefect::inside_out_face, mesh_.face(hf),
             "does not have its cells " + std::to_string(c.idx) + " and " +
                 std::to_string(neighbor[s].idx) + " on different sides");
    }
    if (std::find(neighbor.begin(), neighbor.begin() + s, neighbor[s]) != neighbor.begin() + s &&
        c < neighbor[s]) {
      report(TopologyDefect::multiply_glued_cells, c,
             "shares more than one face with " + name(mesh_, neighbor[s]));
    }
  }
}

void TopologyChecker::check(EdgeHandle e) {
  const auto cells = mesh_.cells(e);
  int n_cells = 0, n_boundary_sides = 0;
  HalfFaceHandle start;
  for (auto it = cells.begin(); it != cells.end(); ++it, ++n_cells) {
    for (int s : kEdgeSides[it.slot() % 12]) {
      const HalfFaceHandle hf = mesh_.halfface(*it, s);
      if (mesh_.is_boundary(hf)) ++n_boundary_sides;
      if (!start.valid() || (mesh_.is_boundary(hf) && !mesh_.is_boundary(start))) start = hf;
    }
  }
  int n_fan = 0;
  for (HalfFaceHandle hf = start; hf.valid();) {
    ++n_fan;
    hf = mesh_.opposite(mesh_.adjacent_in_cell(hf, e));
    if (hf == start || (hf.valid() && !mesh_.adjacent_in_cell(hf, e).valid())) break;
  }
  if (n_boundary_sides != 0 && n_boundary_sides != 2) {
    report(TopologyDefect::nonmanifold_edge, e,
           "has " + std::to_string(n_boundary_sides) + " boundary faces, expected 2");
  } else if (n_fan != n_cells) {
    report(TopologyDefect::nonmanifold_edge, e,
           "has " + std::to_string(n_cells) + " cells but turning round it meets " +
               std::to_string(n_fan));
  } else if (n_boundary_sides == 0 && n_cells < 3) {
    report(TopologyDefect::low_valence_edge, e,
           "is inside and has " + std::to_string(n_cells) + " cells, expected 3 or more");
  }
}

// The link of a vertex: edges at it become points, faces become edges, cells become triangles.
void TopologyChecker::gather_link(VertexHandle v) {
  link_cells_.clear(), link_edges_.clear(), link_neighbors_.clear();
  on_boundary_ = false;
  const auto cells = mesh_.cells(v);
  for (auto it = cells.begin(); it != cells.end(); ++it) {
    const int corner = it.slot() % 8;
    const auto& x = kCornerCoords[corner];
    link_cells_.push_back(*it);
    auto& neighbors = link_neighbors_.emplace_back();
    for (int a = 0; a < 3; ++a) {
      const HalfFaceHandle hf = mesh_.halfface(*it, 2 * a + x[a]), other = mesh_.opposite(hf);
      neighbors[a] = mesh_.cell(other);
      if (!other.valid()) on_boundary_ = true;
      if (other.valid() && other < hf) continue;
      const auto& edges = mesh_.edges(*it);
      EdgeHandle e[2];
      for (int i = 0; i < 2; ++i) {
        const int across = kCornerAcross[corner][(a + 1 + i) % 3];
        e[i] = edges[kEdgeBetween[corner][across]];
      }
      link_edges_.push_back({std::min(e[0], e[1]), std::max(e[0], e[1]), mesh_.face(hf)});
    }
  }
}

void TopologyChecker::check_link_edges(VertexHandle v) {
  std::sort(link_edges_.begin(), link_edges_.end(), [](const LinkEdge& x, const LinkEdge& y) {
    return std::tie(x.a, x.b, x.face) < std::tie(y.a, y.b, y.face);
  });
  for (std::size_t i = 1; i < link_edges_.size(); ++i) {
    const LinkEdge &x = link_edges_[i - 1], &y = link_edges_[i];
    if (x.a != y.a || x.b != y.b || x.face == y.face) continue;
    if (same_vertices(mesh_.vertices(x.face), mesh_.vertices(y.face))) {
      report(TopologyDefect::nonconforming_face, y.face, "lies on another of the same vertices");
    } else {
      report(TopologyDefect::doublet, v,
             "lies between two edges that " + name(mesh_, x.face) + " and " + name(mesh_, y.face) +
                 " share");
    }
  }
}

bool TopologyChecker::link_is_connected() {
  const int n = static_cast<int>(link_cells_.size());
  reached_.assign(n, 0);
  stack_.assign(1, 0);
  reached_[0] = 1;
  int n_reached = 1;
  while (!stack_.empty()) {
    const auto neighbors = link_neighbors_[stack_.back()];
    stack_.pop_back();
    for (CellHandle c : neighbors) {
      if (!c.valid()) continue;
      const int i = static_cast<int>(std::find(link_cells_.begin(), link_cells_.end(), c) -
                                     link_cells_.begin());
      if (i == n || reached_[i]) continue;
      reached_[i] = 1;
      ++n_reached;
      stack_.push_back(i);
    }
  }
  return n_reached == n;
}

void TopologyChecker::check(VertexHandle v) {
  gather_link(v);
  if (link_cells_.empty()) {
    report(TopologyDefect::isolated_vertex, v, "is used by no cell");
    return;
  }
  check_link_edges(v);
  const int euler = mesh_.edges(v).size() - static_cast<int>(link_edges_.size()) +
                    static_cast<int>(link_cells_.size());
  const int expected = on_boundary_ ? 1 : 2;
  if (euler != expected) {
    report(TopologyDefect::nonmanifold_vertex, v,
           "has a link of Euler number " + std::to_string(euler) + ", expected " +
               std::to_string(expected));
  } else if (!link_is_connected()) {
    report(TopologyDefect::nonmanifold_vertex, v, "joins cells that share no face there");
  }
}

std::vector<TopologyViolation> TopologyChecker::take() {
  const auto key = [](const TopologyViolation& v) { return std::tie(v.defect, v.index); };
  std::stable_sort(violations_.begin(), violations_.end(),
                   [&](const auto& a, const auto& b) { return key(a) < key(b); });
  const auto last = std::unique(violations_.begin(), violations_.end(),
                                [&](const auto& a, const auto& b) { return key(a) == key(b); });
  violations_.erase(last, violations_.end());
  return std::move(violations_);
}

// A list that takes every element once.
template <class HandleT>
class OnceEach {
 public:
  explicit OnceEach(int slots) : taken_(slots, 0) {}
  void take(HandleT h) {
    if (!taken_[h.idx]) list_.push_back(h);
    taken_[h.idx] = 1;
  }
  const std::vector<HandleT>& list() const { return list_; }

 private:
  std::vector<char> taken_;
  std::vector<HandleT> list_;
};

// Calls `visit` with the vertices, then with the edges and cells at them, until it returns false.
// \return whether it never did
template <class Visit>
bool for_each_touched(const HexMesh& mesh, std::span<const VertexHandle> vertices, Visit&& visit) {
  OnceEach<VertexHandle> live(mesh.vertex_slots());
  for (VertexHandle v : vertices) {
    if (mesh.is_live(v)) live.take(v);
  }
  const auto all_pass = [&](const auto& elements) {
    return std::all_of(elements.begin(), elements.end(), visit);
  };
  if (!all_pass(live.list())) return false;
  OnceEach<EdgeHandle> edges(mesh.edge_slots());
  OnceEach<CellHandle> cells(mesh.cell_slots());
  for (VertexHandle v : live.list()) {
    for (EdgeHandle e : mesh.edges(v)) edges.take(e);
    for (CellHandle c : mesh.cells(v)) cells.take(c);
  }
  return all_pass(edges.list()) && all_pass(cells.list());
}

}  // namespace

Severity severity(TopologyDefect defect) {
  switch (defect) {
    case TopologyDefect::isolated_vertex:
      return Severity::note;
    case TopologyDefect::low_valence_edge:
    case TopologyDefect::multiply_glued_cells:
    case TopologyDefect::doublet:
      return Severity::degenerate;
    default:
      return Severity::invalid;
  }
}

std::vector<TopologyViolation> check_topology(const HexMesh& mesh) {
  TopologyChecker checker(mesh);
  for (CellHandle c : mesh.cells()) checker.check(c);
  for (EdgeHandle e : mesh.edges()) checker.check(e);
  for (VertexHandle v : mesh.vertices()) checker.check(v);
  return checker.take();
}

std::vector<TopologyViolation> check_topology(const HexMesh& mesh,
                                              std::span<const VertexHandle> vertices) {
  TopologyChecker checker(mesh);
  for_each_touched(mesh, vertices, [&](auto element) {
    checker.check(element);
    return true;
  });
  return checker.take();
}

bool is_clean(std::span<const TopologyViolation> violations, Severity at_least) {
  return std::none_of(violations.begin(), violations.end(),
                      [&](const TopologyViolation& v) { return severity(v.defect) >= at_least; });
}

bool is_clean(const HexMesh& mesh, std::span<const VertexHandle> vertices, Severity at_least) {
  TopologyChecker checker(mesh);
  return for_each_touched(mesh, vertices, [&](auto element) {
    checker.check(element);
    return is_clean(checker.violations(), at_least);
  });
}

bool is_valid(const HexMesh& mesh) { return is_clean(check_topology(mesh)); }

}  // namespace hexweft
