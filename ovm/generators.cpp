#include "ovm/generators.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "ovm/errors.h"

namespace hexweft {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

void require(bool condition, const std::string& message) {
  if (!condition) throw InputError(message);
}

// A planar mesh of quads, counter-clockwise.
struct Section {
  std::vector<Vector2d> points;
  std::vector<std::array<int, 4>> quads;
};

// n × n quads over [-half, half]^2.
Section square_section(int n, double half) {
  Section s;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      s.points.emplace_back(half * (2.0 * i / n - 1), half * (2.0 * j / n - 1));
    }
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const int a = i + (n + 1) * j;
      s.quads.push_back({a, a + 1, a + n + 2, a + n + 1});
    }
  }
  return s;
}

// Rim of a square section, counter-clockwise from its lowest corner.
std::vector<int> rim_of_square(int n) {
  std::vector<int> rim;
  rim.reserve(4 * n);
  for (int i = 0; i < n; ++i) rim.push_back(i);
  for (int j = 0; j < n; ++j) rim.push_back(n + (n + 1) * j);
  for (int i = n; i > 0; --i) rim.push_back(i + (n + 1) * n);
  for (int j = n; j > 0; --j) rim.push_back((n + 1) * j);
  return rim;
}

// A square core in rings of quads that grow round.
Section round_section(int n_core, int n_ring, double radius) {
  Section s = square_section(n_core, 0.45 * radius);
  std::vector<int> inner = rim_of_square(n_core);
  const std::vector<int> core_rim = inner;
  const int n = static_cast<int>(inner.size());
  for (int r = 1; r <= n_ring; ++r) {
    const double t = static_cast<double>(r) / n_ring;
    std::vector<int> outer(n);
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * std::numbers::pi * i / n - 3 * std::numbers::pi / 4;
      const Vector2d on_circle(radius * std::cos(angle), radius * std::sin(angle));
      outer[i] = static_cast<int>(s.points.size());
      s.points.push_back((1 - t) * s.points[core_rim[i]] + t * on_circle);
    }
    for (int i = 0; i < n; ++i) {
      const int next = (i + 1) % n;
      s.quads.push_back({inner[i], outer[i], outer[next], inner[next]});
    }
    inner = outer;
  }
  return s;
}

// Sweeps a section through n_layers + 1 places. With `closing` the last one is the first, where
// point i of the section arrives at point closing[i].
template <class Place>
HexMesh sweep(const Section& section, int n_layers, const std::vector<int>& closing,
              Place&& place) {
  HexMesh mesh;
  const int n = static_cast<int>(section.points.size());
  const int n_places = n_layers + (closing.empty() ? 1 : 0);
  mesh.reserve(n * n_places, static_cast<int>(section.quads.size()) * n_layers);
  for (int k = 0; k < n_places; ++k) {
    for (const Vector2d& p : section.points) mesh.add_vertex(place(p, k));
  }
  for (int k = 0; k < n_layers; ++k) {
    for (const auto& q : section.quads) {
      CellVertices c;
      for (int i = 0; i < 4; ++i) {
        c[i] = VertexHandle(n * k + q[i]);
        c[i + 4] = VertexHandle(k + 1 < n_places ? n * (k + 1) + q[i] : closing[q[i]]);
      }
      mesh.add_cell(c);
    }
  }
  return mesh;
}

// Where each point of a section with fourfold symmetry goes in a rotation by quarter turns.
std::vector<int> rotated_points(const Section& section, int n_quarter_turns) {
  const Eigen::Rotation2Dd rotation(n_quarter_turns * std::numbers::pi / 2);
  std::vector<int> result;
  for (const Vector2d& p : section.points) {
    const Vector2d q = rotation * p;
    const auto nearest = std::min_element(
        section.points.begin(), section.points.end(),
        [&](const Vector2d& a, const Vector2d& b) { return (a - q).norm() < (b - q).norm(); });
    result.push_back(static_cast<int>(nearest - section.points.begin()));
  }
  return result;
}

}  // namespace

HexMesh make_grid(const std::array<int, 3>& n,
                  const std::optional<Eigen::AlignedBox3d>& given_box) {
  require(n[0] > 0 && n[1] > 0 && n[2] > 0, "a grid needs positive counts of cells");
  const Eigen::AlignedBox3d box =
      given_box.value_or(Eigen::AlignedBox3d(Vector3d::Zero(), Vector3d(n[0], n[1], n[2])));
  HexMesh mesh;
  mesh.reserve((n[0] + 1) * (n[1] + 1) * (n[2] + 1), n[0] * n[1] * n[2]);
  for (int k = 0; k <= n[2]; ++k) {
    for (int j = 0; j <= n[1]; ++j) {
      for (int i = 0; i <= n[0]; ++i) {
        const Vector3d t(double(i) / n[0], double(j) / n[1], double(k) / n[2]);
        mesh.add_vertex(box.min() + t.cwiseProduct(box.sizes()));
      }
    }
  }
  const auto vertex = [&](int i, int j, int k) {
    return VertexHandle(i + (n[0] + 1) * (j + (n[1] + 1) * k));
  };
  for (int k = 0; k < n[2]; ++k) {
    for (int j = 0; j < n[1]; ++j) {
      for (int i = 0; i < n[0]; ++i) {
        CellVertices c;
        for (int a = 0; a < kCorners; ++a) {
          c[a] = vertex(i + kCornerCoords[a][0], j + kCornerCoords[a][1], k + kCornerCoords[a][2]);
        }
        mesh.add_cell(c);
      }
    }
  }
  return mesh;
}

HexMesh make_o_grid(const OGridOptions& o) {
  require(o.n_core > 0 && o.n_ring > 0 && o.n_layers > 0,
          "an O-grid needs positive counts of cells");
  require(o.radius > 0 && o.height > 0, "an O-grid needs a positive radius and height");
  return sweep(
      round_section(o.n_core, o.n_ring, o.radius), o.n_layers, {},
      [&](const Vector2d& p, int k) { return Vector3d(p.x(), p.y(), o.height * k / o.n_layers); });
}

HexMesh make_torus(const TorusOptions& o) {
  require(o.n_core > 0 && o.n_ring > 0, "a torus needs positive counts of cells");
  require(o.n_around > 2, "a torus needs at least 3 cells around");
  require(o.minor_radius > 0 && o.major_radius > o.minor_radius,
          "a torus needs a major radius above its positive minor radius");
  const Section section = o.round_section ? round_section(o.n_core, o.n_ring, o.minor_radius)
                                          : square_section(o.n_core, o.minor_radius);
  const auto closing = rotated_points(section, o.n_quarter_turns);
  return sweep(section, o.n_around, closing, [&](const Vector2d& p, int k) {
    // The section's x runs up and its y outwards, so that x, y and the sweep are right-handed.
    const double angle = 2 * std::numbers::pi * k / o.n_around;
    const Vector2d q = Eigen::Rotation2Dd(o.n_quarter_turns * angle / 4) * p;
    const double r = o.major_radius + q.y();
    return Vector3d(r * std::cos(angle), r * std::sin(angle), q.x());
  });
}

HexMesh make_l_shape(int n) {
  require(n > 0, "an L shape needs a positive count of cells");
  return make_voxels(
      VoxelSet({2 * n, 2 * n, n}, [n](int x, int y, int) { return x < n || y < n; }));
}

VoxelSet::VoxelSet(const std::array<int, 3>& n, const std::function<bool(int, int, int)>& is_filled)
    : size(n) {
  require(n[0] > 0 && n[1] > 0 && n[2] > 0, "a set of voxels needs a positive size");
  filled.reserve(static_cast<std::size_t>(n[0]) * n[1] * n[2]);
  for (int z = 0; z < n[2]; ++z) {
    for (int y = 0; y < n[1]; ++y) {
      for (int x = 0; x < n[0]; ++x) filled.push_back(is_filled(x, y, z));
    }
  }
}

bool VoxelSet::operator()(int x, int y, int z) const {
  if (x < 0 || y < 0 || z < 0 || x >= size[0] || y >= size[1] || z >= size[2]) return false;
  return filled[x +
                static_cast<std::size_t>(size[0]) * (y + static_cast<std::size_t>(size[1]) * z)];
}

HexMesh make_voxels(const VoxelSet& voxels) {
  HexMesh mesh;
  const auto& n = voxels.size;
  std::vector<VertexHandle> vertex(static_cast<std::size_t>(n[0] + 1) * (n[1] + 1) * (n[2] + 1));
  const auto at = [&](int x, int y, int z) {
    VertexHandle& v = vertex[x + static_cast<std::size_t>(n[0] + 1) *
                                     (y + static_cast<std::size_t>(n[1] + 1) * z)];
    if (!v.valid()) v = mesh.add_vertex(Vector3d(x, y, z));
    return v;
  };
  for (int z = 0; z < n[2]; ++z) {
    for (int y = 0; y < n[1]; ++y) {
      for (int x = 0; x < n[0]; ++x) {
        if (!voxels(x, y, z)) continue;
        CellVertices c;
        for (int a = 0; a < kCorners; ++a) {
          c[a] = at(x + kCornerCoords[a][0], y + kCornerCoords[a][1], z + kCornerCoords[a][2]);
        }
        mesh.add_cell(c);
      }
    }
  }
  return mesh;
}

void append_copy(HexMesh& mesh, const HexMesh& other, const Vector3d& offset) {
  // `other` may be `mesh`: what to copy is counted first.
  const int n_vertices = other.vertex_slots(), n_cells = other.cell_slots();
  std::vector<VertexHandle> copy(n_vertices);
  for (VertexHandle v(0); v.idx < n_vertices; ++v.idx) {
    if (other.is_live(v)) copy[v.idx] = mesh.add_vertex(other.point(v) + offset);
  }
  for (CellHandle c(0); c.idx < n_cells; ++c.idx) {
    if (!other.is_live(c)) continue;
    CellVertices corners = other.vertices(c);
    for (VertexHandle& v : corners) v = copy[v.idx];
    mesh.add_cell(corners);
  }
}

void transform(HexMesh& mesh, const Eigen::Affine3d& map) {
  for (VertexHandle v : mesh.vertices()) mesh.set_point(v, map * mesh.point(v));
}

}  // namespace hexweft
