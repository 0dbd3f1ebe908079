#include "io/ovm_topology.h"

#include <algorithm>
#include <optional>

#include "io/number_text.h"

namespace hexweft::detail {
namespace {

using Quad = std::array<int, 4>;

constexpr std::array<Quad, 6> kHalfFaceCorners{
    {{1, 2, 3, 0}, {7, 6, 5, 4}, {3, 2, 6, 7}, {4, 5, 1, 0}, {3, 7, 4, 0}, {2, 1, 5, 6}}};

// Numbers edges and faces as they are met.
class TopologyBuilder {
 public:
  explicit TopologyBuilder(const HexMesh& mesh)
      : mesh_(mesh),
        vertex_number_(vertex_numbers(mesh)),
        edge_number_(mesh.edge_slots(), -1),
        face_number_(mesh.face_slots(), -1) {
    result_.edges.reserve(mesh.n_edges());
    result_.faces.reserve(mesh.n_faces());
    result_.cells.reserve(mesh.n_cells());
  }

  OvmTopology build() {
    for (CellHandle c : mesh_.cells()) {
      std::array<int, 6> cell;
      for (int i = 0; i < kSides; ++i) cell[i] = half_face(c, kHalfFaceCorners[i]);
      result_.cells.push_back(cell);
    }
    return std::move(result_);
  }

 private:
  int half_edge(CellHandle c, int from, int to) {
    const EdgeHandle e = mesh_.edges(c)[kEdgeBetween[from][to]];
    const int start = vertex_number_[mesh_.vertices(c)[from].idx];
    if (edge_number_[e.idx] < 0) {
      edge_number_[e.idx] = static_cast<int>(result_.edges.size());
      result_.edges.push_back({start, vertex_number_[mesh_.vertices(c)[to].idx]});
    }
    const int number = edge_number_[e.idx];
    return 2 * number + (result_.edges[number][0] == start ? 0 : 1);
  }

  int half_face(CellHandle c, const Quad& corners) {
    Quad cycle;
    for (int i = 0; i < 4; ++i) cycle[i] = half_edge(c, corners[i], corners[(i + 1) % 4]);
    const FaceHandle f = mesh_.face(mesh_.halfface(c, side_of(corners)));
    if (face_number_[f.idx] < 0) {
      face_number_[f.idx] = static_cast<int>(result_.faces.size());
      result_.faces.push_back(cycle);
    }
    const int number = face_number_[f.idx];
    const Quad& stored = result_.faces[number];
    const bool same_way = std::find(stored.begin(), stored.end(), cycle[0]) != stored.end();
    return 2 * number + (same_way ? 0 : 1);
  }

  static int side_of(const Quad& corners) {
    for (int side = 0; side < kSides; ++side) {
      if (std::is_permutation(corners.begin(), corners.end(), kSideCorners[side].begin())) {
        return side;
      }
    }
    return -1;
  }

  const HexMesh& mesh_;
  std::vector<int> vertex_number_, edge_number_, face_number_;
  OvmTopology result_;
};

int from(const OvmTopology& topology, int half_edge) {
  return topology.edges[half_edge / 2][half_edge % 2];
}

// The vertices round a half-face; nothing if its half-edges do not follow each other.
std::optional<Quad> vertices_round(const OvmTopology& topology, int half_face) {
  Quad cycle = topology.faces[half_face / 2];
  if (half_face % 2 == 1) {
    std::reverse(cycle.begin(), cycle.end());
    for (int& h : cycle) h ^= 1;
  }
  Quad vertices;
  for (int i = 0; i < 4; ++i) {
    if (from(topology, cycle[i] ^ 1) != from(topology, cycle[(i + 1) % 4])) return std::nullopt;
    vertices[i] = from(topology, cycle[i]);
  }
  return vertices;
}

bool has(const Quad& quad, int vertex) {
  return std::find(quad.begin(), quad.end(), vertex) != quad.end();
}

// Where one side goes from a to b, another of the same cell goes from b to a, and no other does.
bool close_up(const std::array<Quad, 6>& quads) {
  std::vector<std::array<int, 2>> there, back;
  for (const Quad& q : quads) {
    for (int i = 0; i < 4; ++i) {
      there.push_back({q[i], q[(i + 1) % 4]});
      back.push_back({q[(i + 1) % 4], q[i]});
    }
  }
  std::sort(there.begin(), there.end());
  std::sort(back.begin(), back.end());
  return there == back && std::adjacent_find(there.begin(), there.end()) == there.end();
}

// The neighbor of a vertex of the bottom that is not in it; -1 if none or several are.
int above(const std::array<Quad, 6>& quads, int vertex) {
  int result = -1;
  for (int s = 1; s < kSides; ++s) {
    const Quad& q = quads[s];
    for (int i = 0; i < 4; ++i) {
      if (q[i] != vertex) continue;
      for (int neighbor : {q[(i + 1) % 4], q[(i + 3) % 4]}) {
        if (has(quads[0], neighbor)) continue;
        if (result >= 0 && result != neighbor) return -1;
        result = neighbor;
      }
    }
  }
  return result;
}

/// In VTK order. \param problem  what is wrong if the half-faces do not bound a hexahedron, else untouched
std::array<int, 8> corners_of(const OvmTopology& topology, int cell, std::string& problem) {
  std::array<int, 8> corners{};
  std::array<Quad, 6> quads;
  for (int i = 0; i < kSides; ++i) {
    const int half_face = topology.cells[cell][i];
    const auto vertices = vertices_round(topology, half_face);
    if (!vertices) {
      problem = "has face " + std::to_string(half_face / 2) +
                ", the half-edges of which do not follow each other";
      return corners;
    }
    quads[i] = *vertices;
  }
  const auto first = std::find_if(quads[0].begin(), quads[0].end(),
                                  [&](int v) { return has(quads[3], v) && has(quads[4], v); });
  const auto start = first == quads[0].end() ? 0 : first - quads[0].begin();
  Quad top;
  for (int i = 0; i < 4; ++i) {
    corners[i] = quads[0][(start + i) % 4];
    corners[4 + i] = top[i] = above(quads, corners[i]);
  }
  const bool has_top = std::any_of(quads.begin() + 1, quads.end(), [&](const Quad& q) {
    return std::is_permutation(q.begin(), q.end(), top.begin());
  });
  if (!close_up(quads) || !has_top) problem = "has half-faces that do not bound a hexahedron";
  return corners;
}

void note_loose_faces(const OvmTopology& topology, std::vector<std::string>& notes) {
  std::vector<char> used(topology.faces.size(), 0);
  for (const auto& cell : topology.cells) {
    for (int half_face : cell) used[half_face / 2] = 1;
  }
  const auto n = std::count(used.begin(), used.end(), 0);
  if (n > 0) {
    notes.push_back(std::to_string(n) + " faces that no hexahedron has were left out");
  }
}

}  // namespace

OvmTopology make_ovm_topology(const HexMesh& mesh) { return TopologyBuilder(mesh).build(); }

void add_hexahedra(const OvmTopology& topology, MeshData& data,
                   const std::function<void(int cell, const std::string& problem)>& fail) {
  data.cells.reserve(topology.cells.size());
  for (int c = 0; c < static_cast<int>(topology.cells.size()); ++c) {
    std::string problem;
    data.cells.push_back(corners_of(topology, c, problem));
    if (!problem.empty()) fail(c, problem);
  }
  check_cells(data, 0, fail);
  note_loose_faces(topology, data.notes);
}

std::size_t count(OvmEntity entity, std::size_t n_vertices, const OvmTopology& topology) {
  switch (entity) {
    case OvmEntity::vertex:
      return n_vertices;
    case OvmEntity::edge:
      return topology.edges.size();
    case OvmEntity::half_edge:
      return 2 * topology.edges.size();
    case OvmEntity::face:
      return topology.faces.size();
    case OvmEntity::half_face:
      return 2 * topology.faces.size();
    case OvmEntity::cell:
      return topology.cells.size();
    case OvmEntity::mesh:
      break;
  }
  return 1;
}

}  // namespace hexweft::detail
