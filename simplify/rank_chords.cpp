#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

#include "ovm/quality.h"
#include "simplify/rank.h"

namespace hexweft {
namespace {

// D of one link, Eq. 2 counted in hexahedra: an edge on the sub-diagonal loses one, the pair on the
// main diagonal becomes one edge.
int deviation(const BaseComplex& bc, const LinkEdges& l) {
  const BaseEdge &a = bc.edges[l.a], &b = bc.edges[l.b], &c = bc.edges[l.c], &d = bc.edges[l.d];
  return std::abs(c.valence - 1 - c.regular_valence()) +
         std::abs(d.valence - 1 - d.regular_valence()) +
         std::abs(a.valence + b.valence - 2 - std::min(a.regular_valence(), b.regular_valence()));
}

double mean_deviation(const BaseComplex& bc, const Chord& chord, Diagonal diagonal) {
  int sum = 0;
  for (const ChordLink& l : chord.links) sum += deviation(bc, link_edges(bc, l, diagonal));
  return sum / (3.0 * static_cast<double>(chord.links.size()));
}

int singular_groups(const BaseComplex& bc, const Chord& chord) {
  std::array<bool, 4> singular = {};
  for (const ChordLink& l : chord.links) {
    for (int i = 0; i < 4; ++i) {
      const int edge = bc.components[l.component].edges[4 * l.axis + i];
      singular[l.group[i]] |= bc.edges[edge].singular;
    }
  }
  // Of a closed chord that is twisted by half a turn two groups each are one.
  for (int i = 0; i < 4; ++i) singular[chord.group_at_end[i]] |= singular[i];
  for (int i = 0; i < 4; ++i) singular[i] |= singular[chord.group_at_end[i]];
  return static_cast<int>(std::count(singular.begin(), singular.end(), true));
}

// What the diagonals of a chord and the curvature along it amount to.
struct ChordGeometry {
  double least = std::numeric_limits<double>::infinity();  // of the diagonals that fold
  double main = 0, sub = 0;        // summed lengths of those that fold, of those that stay
  double curvature_deviation = 0;  // standard deviation at the edges that fall together
};

ChordGeometry measure(const HexMesh& mesh, const BaseComplex& bc, const Chord& chord,
                      Diagonal diagonal, const std::vector<double>& curvature, double mean_edge) {
  ChordGeometry g;
  double sum = 0, sum_sq = 0;
  int n = 0;
  const auto vertex = [&](int edge, int end) { return bc.vertices[bc.edges[edge].ends[end]]; };
  for (const ChordLink& link : chord.links) {
    const LinkEdges e = link_edges(bc, link, diagonal);
    const auto middle = [&](int edge) -> Eigen::Vector3d {
      return 0.5 * (mesh.point(vertex(edge, 0)) + mesh.point(vertex(edge, 1)));
    };
    const double main = (middle(e.a) - middle(e.b)).norm();
    g.least = std::min(g.least, main);
    g.main += main;
    g.sub += (middle(e.c) - middle(e.d)).norm();
    for (int edge : {e.a, e.b}) {
      for (int end : {0, 1}) {
        // Relative to the mesh, so that the term has no unit.
        const double q = curvature[vertex(edge, end).idx] * mean_edge * mean_edge;
        sum += q;
        sum_sq += q * q;
        ++n;
      }
    }
  }
  if (n > 1) g.curvature_deviation = std::sqrt(std::max(0.0, (sum_sq - sum * sum / n) / (n - 1)));
  return g;
}

// Mean length of the diagonals that fold, over that of those that stay; and the curvature's spread.
double geometry_term(const ChordGeometry& g) {
  return g.sub > 0 ? g.main / g.sub * g.curvature_deviation : g.main > 0 ? 1e3 : 0.0;
}

}  // namespace

std::vector<double> boundary_gaussian_curvature(const HexMesh& mesh) {
  std::vector<double> angles(mesh.vertex_slots(), 0), area(mesh.vertex_slots(), 0);
  for (HalfFaceHandle hf : mesh.boundary_halffaces()) {
    const QuadVertices q = mesh.vertices(hf);
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector3d& p = mesh.point(q[i]);
      const Eigen::Vector3d u = mesh.point(q[(i + 1) % 4]) - p, v = mesh.point(q[(i + 3) % 4]) - p;
      const double twice_area = u.cross(v).norm();
      angles[q[i].idx] += std::atan2(twice_area, u.dot(v));
      area[q[i].idx] += twice_area / 4;  // a quarter of the quadrilateral, seen from this corner
    }
  }
  std::vector<double> result(mesh.vertex_slots(), 0);
  for (std::size_t v = 0; v < result.size(); ++v) {
    if (area[v] > 0) result[v] = (2 * std::numbers::pi - angles[v]) / area[v];
  }
  return result;
}

std::vector<ChordTerms> rank_chords(const HexMesh& mesh, const BaseComplex& bc,
                                    const std::vector<Chord>& chords,
                                    const std::vector<double>& curvature, const RankingWeights& w) {
  const double mean_edge = mean_edge_length(mesh);
  std::vector<ChordTerms> result;
  for (const Chord& chord : chords) {
    ChordTerms t;
    const double first = mean_deviation(bc, chord, Diagonal::first);
    const double second = mean_deviation(bc, chord, Diagonal::second);
    t.diagonal = second < first ? Diagonal::second : Diagonal::first;
    t.deviation = std::min(first, second);
    t.singular_groups = singular_groups(bc, chord);
    t.valence = w.beta * t.deviation;
    const ChordGeometry g = measure(mesh, bc, chord, t.diagonal, curvature, mean_edge);
    t.thickness =
        (w.min_width * g.least + w.mean_width * g.main / static_cast<double>(chord.links.size())) /
        mean_edge;
    t.geometry = geometry_term(g);
    t.energy =
        w.k_distortion * (1 - std::exp(-t.geometry)) + w.k_valence * (1 - std::exp(-t.valence));
    result.push_back(t);
  }
  return result;
}

}  // namespace hexweft
