#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "optimize/hex_energy.h"
#include "ovm/detail/disjoint_sets.h"
#include "ovm/errors.h"
#include "ovm/neighborhood.h"
#include "ovm/quality.h"
#include "simplify/rank.h"

namespace hexweft {
namespace {

double length(const HexMesh& mesh, const BaseComplex& bc, const BaseEdge& e) {
  const auto chain = bc.chain(e);
  double sum = 0;
  for (std::size_t i = 1; i < chain.size(); ++i) {
    sum += (mesh.point(chain[i]) - mesh.point(chain[i - 1])).norm();
  }
  return sum;
}

// By axis: the pairs of a component's edges that a collapse along it makes one.
constexpr auto kAcross = [] {
  std::array<std::array<std::array<int, 2>, 4>, 3> pairs{};
  for (int axis = 0; axis < 3; ++axis) {
    int n = 0;
    for (int e = 0; e < kHexEdges; ++e) {
      const auto& [from, to] = kEdgeCorners[e];
      if (edge_axis(e) == axis || kCornerCoords[from][axis] == 1) continue;
      pairs[axis][n++] = {e, kEdgeBetween[kCornerAcross[from][axis]][kCornerAcross[to][axis]]};
    }
  }
  return pairs;
}();

// The base edges of F_L and F_R, in groups that would become one. Scratch is kept from sheet to
// sheet.
class SideGroups {
 public:
  explicit SideGroups(const BaseComplex& bc)
      : bc_(bc),
        sets_(static_cast<int>(bc.edges.size())),
        stamp_(bc.edges.size(), -1),
        surviving_(bc.edges.size(), 0),
        groups_(bc.edges.size()) {}

  /// Sum over the groups of T(K_max - K_new), Eq. 7.
  double gain(const Sheet& sheet) {
    collect(sheet);
    for (int e : members_) groups_[sets_.find(e)].add(bc_.edges[e], surviving_[e]);
    double sum = 0;  // of halves: the same in any order
    for (int e : members_) {
      sum += groups_[e].gain();
      groups_[e] = {};
      sets_.release(e);
    }
    return sum;
  }

 private:
  // At its lowest edge; those at the others are empty.
  struct Group {
    int n = 0, valence = 0, worst = 0;
    bool boundary = false;
    void add(const BaseEdge& e, int surviving) {
      ++n;
      valence += surviving;
      boundary |= e.boundary;
      worst = std::max(worst, e.valence_error());
    }
    double gain() const {
      if (n < 2) return 0;
      const int k = worst - std::abs(valence - (boundary ? 2 : 4));
      return k < 0 ? 0.5 * k : k == 0 ? 1.0 : k;
    }
  };

  void collect(const Sheet& sheet) {
    members_.clear();
    ++now_;
    for (std::size_t i = 0; i < sheet.crossings.size(); ++i) {
      const auto [c, axis] = sheet.crossings[i];
      const auto& edges = bc_.components[c].edges;
      for (const auto& [e, twin] : kAcross[axis]) sets_.join(touch(edges[e]), touch(edges[twin]));
      if (i > 0 && sheet.crossings[i - 1].component == c) continue;
      for (int e : edges) --surviving_[touch(e)];
    }
  }

  int touch(int e) {
    if (stamp_[e] != now_) {
      stamp_[e] = now_;
      members_.push_back(e);
      surviving_[e] = bc_.edges[e].valence;
    }
    return e;
  }

  const BaseComplex& bc_;
  detail::DisjointSets sets_;
  std::vector<int> stamp_, surviving_, members_;
  std::vector<Group> groups_;
  int now_ = -1;
};

// Sum of K^m over the singular curves that lie wholly in E_M: those that are one base edge.
double middle_gain(const BaseComplex& bc, const Sheet& sheet) {
  double sum = 0;
  for (int id : sheet.edges) {
    const BaseEdge& e = bc.edges[id];
    if (!e.singular) continue;
    const bool whole = bc.graph.singular_vertex[bc.vertices[e.ends[0]].idx] &&
                       bc.graph.singular_vertex[bc.vertices[e.ends[1]].idx];
    if (whole) sum += e.valence_error();
  }
  return sum;
}

double thickness(const HexMesh& mesh, const BaseComplex& bc, const Sheet& sheet, double mean_edge,
                 const RankingWeights& w) {
  double least = std::numeric_limits<double>::infinity(), sum = 0;
  for (int e : sheet.edges) {
    const double l = length(mesh, bc, bc.edges[e]);
    least = std::min(least, l);
    sum += l;
  }
  const double mean = sum / static_cast<double>(sheet.edges.size());
  return (w.min_width * least + w.mean_width * mean) / mean_edge;
}

// By component, of the cells that are distorted.
std::vector<double> distortions(const HexMesh& mesh, const BaseComplex& bc, double threshold) {
  const std::vector<double> differences = shape_differences(mesh);
  std::vector<double> sums;
  for (const Component& component : bc.components) {
    double sum = 0;
    for (CellHandle c : bc.cells(component)) {
      if (differences[c.idx] >= threshold) sum += differences[c.idx];
    }
    sums.push_back(sum);
  }
  return sums;
}

double distortion_term(const Sheet& sheet, const std::vector<double>& distortions) {
  double sum = 0;
  for (const Crossing& x : sheet.crossings) sum += distortions[x.component];
  return 1 / std::log(sum + std::numbers::e);
}

}  // namespace

void validate(const RankingWeights& w) {
  const auto expect = [](const char* name, double value) {
    if (!(value >= 0) || !std::isfinite(value)) {
      throw InputError(fmt::format("{} = {}, expected a finite number >= 0", name, value));
    }
  };
  expect("k_valence", w.k_valence);
  expect("k_width", w.k_width);
  expect("k_distortion", w.k_distortion);
  expect("beta", w.beta);
  expect("min_width", w.min_width);
  expect("mean_width", w.mean_width);
  expect("distortion_threshold", w.distortion_threshold);
  if (w.min_width + w.mean_width == 0) {
    throw InputError("min_width = mean_width = 0, expected one of them > 0");
  }
}

std::vector<double> shape_differences(const HexMesh& mesh) {
  std::vector<double> shape(mesh.cell_slots(), 0), result(mesh.cell_slots(), 0);
  const std::vector<CellHandle> cells = all_cells(mesh);
  const std::vector<double> metrics = shape_metrics(mesh, cells);
  for (std::size_t i = 0; i < cells.size(); ++i) shape[cells[i].idx] = metrics[i];
  for (CellHandle c : mesh.cells()) {
    for (int axis = 0; axis < 3; ++axis) {
      const CellHandle down = mesh.cell(mesh.opposite(mesh.halfface(c, 2 * axis)));
      const CellHandle up = mesh.cell(mesh.opposite(mesh.halfface(c, 2 * axis + 1)));
      if (!down.valid() || !up.valid()) continue;
      const double second = std::abs(shape[down.idx] + shape[up.idx] - 2 * shape[c.idx]);
      result[c.idx] = std::max(result[c.idx], second);
    }
  }
  return result;
}

std::vector<SheetTerms> rank_sheets(const HexMesh& mesh, const BaseComplex& bc,
                                    const std::vector<Sheet>& sheets, const RankingWeights& w) {
  const std::vector<double> distorted = distortions(mesh, bc, w.distortion_threshold);
  const double mean_edge = mean_edge_length(mesh);
  std::size_t most_edges = 1;  // DM
  for (const Sheet& s : sheets) most_edges = std::max(most_edges, s.edges.size());
  const auto dm = static_cast<double>(most_edges);

  SideGroups groups(bc);
  std::vector<SheetTerms> result;
  for (const Sheet& s : sheets) {
    SheetTerms t;
    t.valence = (dm - w.beta * (groups.gain(s) + middle_gain(bc, s))) / dm;
    t.thickness = thickness(mesh, bc, s, mean_edge, w);
    t.width = std::cbrt(t.thickness);
    t.distortion = distortion_term(s, distorted);
    t.energy = w.k_distortion * (1 - std::exp(-t.distortion)) +
               w.k_width * (1 - std::exp(-t.width)) + w.k_valence * (1 - std::exp(-t.valence));
    result.push_back(t);
  }
  return result;
}

}  // namespace hexweft
