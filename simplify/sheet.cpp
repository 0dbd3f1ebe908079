#include "simplify/sheet.h"

#include <algorithm>
#include <array>

#include "ovm/detail/disjoint_sets.h"

namespace hexweft {
namespace {

// Classes of directed base edges: 2e along its chain, 2e + 1 against it. A sheet is one-sided where
// the two directions of an edge fall together.
class DirectedClasses {
 public:
  explicit DirectedClasses(const BaseComplex& bc)
      : bc_(bc), sets_(2 * static_cast<int>(bc.edges.size())) {
    for (const Component& c : bc.components) {
      for (int axis = 0; axis < 3; ++axis) join_axis(c, axis);
    }
  }
  bool two_sided(int edge) { return sets_.find(2 * edge) != sets_.find(2 * edge + 1); }
  bool against(int edge) { return sets_.find(2 * edge) > sets_.find(2 * edge + 1); }
  int sheet(int edge) { return std::min(sets_.find(2 * edge), sets_.find(2 * edge + 1)); }

 private:
  void join_axis(const Component& c, int axis) {
    const int first = directed(c, 4 * axis);
    for (int e = 4 * axis + 1; e < 4 * axis + 4; ++e) {
      const int other = directed(c, e);
      sets_.join(first, other);
      sets_.join(first ^ 1, other ^ 1);
    }
  }
  int directed(const Component& c, int edge) const {
    const int from = c.corners[kEdgeCorners[edge][0]];
    return 2 * c.edges[edge] + (bc_.edges[c.edges[edge]].ends[0] == from ? 0 : 1);
  }
  const BaseComplex& bc_;
  detail::DisjointSets sets_;
};

bool crosses_itself(const Sheet& s) {
  for (std::size_t i = 1; i < s.crossings.size(); ++i) {
    if (s.crossings[i].component == s.crossings[i - 1].component) return true;
  }
  return false;
}

bool meets_boundary(const BaseComplex& bc, const Sheet& s) {
  for (int e : s.edges) {
    if (bc.edges[e].boundary) return true;
  }
  return false;
}

// `stamp` by base vertex; values below this sheet's are of earlier ones.
bool touches_itself(const BaseComplex& bc, const Sheet& s, std::vector<int>& stamp, int now) {
  for (int e : s.edges) {
    for (int v : bc.edges[e].ends) {
      if (stamp[v] == now) return true;
      stamp[v] = now;
    }
  }
  return false;
}

}  // namespace

std::string_view name(SheetKind kind) {
  static constexpr std::array<std::string_view, 5> names = {"open", "closed", "tangent",
                                                            "intersecting", "moebius"};
  return names[static_cast<std::size_t>(kind)];
}

bool runs_against(const BaseComplex& bc, const Sheet& sheet, const Crossing& x) {
  const Component& c = bc.components[x.component];
  const int edge = 4 * x.axis;
  const auto i = std::lower_bound(sheet.edges.begin(), sheet.edges.end(), c.edges[edge]);
  const bool edge_against = sheet.against[i - sheet.edges.begin()] != 0;
  return edge_against != (bc.edges[*i].ends[0] != c.corners[kEdgeCorners[edge][0]]);
}

std::vector<Sheet> extract_sheets(const BaseComplex& bc) {
  DirectedClasses classes(bc);
  const int n_edges = static_cast<int>(bc.edges.size());
  std::vector<int> sheet_of_class(2 * n_edges, -1);
  std::vector<Sheet> sheets;
  for (int e = 0; e < n_edges; ++e) {
    int& id = sheet_of_class[classes.sheet(e)];
    if (id < 0) {
      id = static_cast<int>(sheets.size());
      sheets.emplace_back().width = bc.edges[e].n;
    }
    sheets[id].edges.push_back(e);
    sheets[id].against.push_back(classes.against(e));
  }
  for (int c = 0; c < static_cast<int>(bc.components.size()); ++c) {
    for (int axis = 0; axis < 3; ++axis) {
      const int id = sheet_of_class[classes.sheet(bc.components[c].edges[4 * axis])];
      sheets[id].crossings.push_back({c, axis});
    }
  }
  std::vector<int> stamp(bc.vertices.size(), -1);
  for (int i = 0; i < static_cast<int>(sheets.size()); ++i) {
    Sheet& s = sheets[i];
    const bool touches = touches_itself(bc, s, stamp, i);
    s.kind = !classes.two_sided(s.edges[0]) ? SheetKind::moebius
             : crosses_itself(s)            ? SheetKind::intersecting
             : touches                      ? SheetKind::tangent
             : !meets_boundary(bc, s)       ? SheetKind::closed
                                            : SheetKind::open;
  }
  return sheets;
}

}  // namespace hexweft
