#include "simplify/peel.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "ovm/hex_numbering.h"
#include "simplify/detail/plan_builder.h"

namespace hexweft {

namespace {

std::vector<PeeledComponent> sides_on_boundary(const BaseComplex& bc, const Sheet& sheet) {
  std::vector<PeeledComponent> sides;
  for (const Crossing& x : sheet.crossings) {
    const auto& faces = bc.components[x.component].faces;
    const int near = 2 * x.axis, far = near + 1;
    const bool near_is = bc.faces[faces[near]].boundary(), far_is = bc.faces[faces[far]].boundary();
    if (near_is != far_is) sides.push_back({x.component, near_is ? near : far});
  }
  return sides;
}

// Sides that meet at an edge which is no feature are of one peel.
detail::DisjointSets join_across_edges(const BaseComplex& bc,
                                       const std::vector<PeeledComponent>& sides,
                                       const std::vector<char>& on_feature) {
  const int n = static_cast<int>(sides.size());
  std::vector<std::pair<int, int>> at_edges;  // base edge, side
  for (int i = 0; i < n; ++i) {
    const int face = bc.components[sides[i].component].faces[sides[i].side];
    for (int e : bc.faces[face].edges) {
      if (on_feature[e] == 0) at_edges.emplace_back(e, i);
    }
  }
  std::sort(at_edges.begin(), at_edges.end());
  detail::DisjointSets sets(n);
  for (std::size_t k = 1; k < at_edges.size(); ++k) {
    if (at_edges[k].first == at_edges[k - 1].first)
      sets.join(at_edges[k].second, at_edges[k - 1].second);
  }
  return sets;
}

}  // namespace

std::vector<Peel> extract_peels(const BaseComplex& bc, const std::vector<Sheet>& sheets,
                                const std::vector<char>& on_feature) {
  std::vector<Peel> peels;
  for (const Sheet& sheet : sheets) {
    const std::vector<PeeledComponent> sides = sides_on_boundary(bc, sheet);
    detail::DisjointSets sets = join_across_edges(bc, sides, on_feature);
    std::map<int, Peel> by_set;
    for (int i = 0; i < static_cast<int>(sides.size()); ++i) {
      Peel& peel = by_set[sets.find(i)];
      peel.width = sheet.width;
      peel.kind = sheet.kind;
      peel.components.push_back(sides[i]);
    }
    for (auto& [set, peel] : by_set) {
      if (peel.components.size() < sheet.crossings.size()) peels.push_back(std::move(peel));
    }
  }
  std::stable_sort(peels.begin(), peels.end(), [](const Peel& a, const Peel& b) {
    return a.components.size() > b.components.size();
  });
  return peels;
}

namespace {

class PeelPlan {
 public:
  PeelPlan(const HexMesh& mesh, const BaseComplex& bc, const Peel& peel)
      : mesh_(mesh),
        bc_(bc),
        builder_(mesh),
        removed_(mesh.cell_slots(), 0),
        top_of_(mesh.vertex_slots()) {
    for (const PeeledComponent& p : peel.components) {
      const Component& c = bc.components[p.component];
      for (CellHandle cell : bc.cells(c)) removed_[cell.idx] = 1;
      builder_.remove(bc.cells(c));
    }
    for (const PeeledComponent& p : peel.components) add(p);
    plan_ = builder_.finish(peel.width);
    plan_.peels = true;
    for (int g = 0; g < plan_.n_groups(); ++g) plan_.places.push_back(place_of(plan_.group(g)));
  }
  CollapsePlan take() { return std::move(plan_); }

 private:
  void add(const PeeledComponent& p) {
    const Component& c = bc_.components[p.component];
    const int axis = side_axis(p.side), n = c.n[axis], u = (axis + 1) % 3, v = (axis + 2) % 3;
    const bool far = p.side % 2 != 0;
    std::array<int, 3> at;
    for (at[u] = 0; at[u] <= c.n[u]; ++at[u]) {
      for (at[v] = 0; at[v] <= c.n[v]; ++at[v]) {
        const auto level = [&](int depth) {
          at[axis] = far ? n - depth : depth;
          return bc_.vertex(c, at[0], at[1], at[2]);
        };
        const VertexHandle under = level(n), top = level(0);
        builder_.add(under);
        top_of_[under.idx] = top;
        for (int depth = 0; depth < n; ++depth) {
          const VertexHandle w = level(depth);
          if (goes(w)) {
            builder_.join(under, w);
          } else {
            builder_.add(w);
          }
        }
      }
    }
  }

  bool goes(VertexHandle v) const {
    const auto cells = mesh_.cells(v);
    return std::all_of(cells.begin(), cells.end(),
                       [&](CellHandle c) { return removed_[c.idx] != 0; });
  }

  Eigen::Vector3d place_of(std::span<const VertexHandle> group) const {
    for (VertexHandle v : group) {
      const VertexHandle top = top_of_[v.idx];
      if (!top.valid()) continue;
      return std::find(group.begin(), group.end(), top) != group.end() ? mesh_.point(top)
                                                                       : beside(top);
    }
    return mesh_.point(group.front());
  }

  // A third of a cell into the peel, on the surface.
  Eigen::Vector3d beside(VertexHandle rim) const {
    const Eigen::Vector3d here = mesh_.point(rim);
    Eigen::Vector3d along = Eigen::Vector3d::Zero(), across = along;
    int n_along = 0, n_across = 0;
    for (EdgeHandle e : mesh_.edges(rim)) {
      const VertexHandle w = mesh_.other_end(e, rim);
      if (!mesh_.is_boundary(e) || !goes(w)) continue;
      along += mesh_.point(w) - here;
      ++n_along;
    }
    if (n_along > 0) return here + along / (3 * n_along);
    for (CellHandle c : mesh_.cells(rim)) {
      if (removed_[c.idx] == 0) continue;
      for (HalfFaceHandle side : mesh_.halffaces(c)) {
        const QuadVertices quad = mesh_.vertices(side);
        if (!mesh_.is_boundary(side) || std::find(quad.begin(), quad.end(), rim) == quad.end())
          continue;
        for (VertexHandle w : quad) across += (mesh_.point(w) - here) / 4;
        ++n_across;
      }
    }
    return n_across > 0 ? Eigen::Vector3d(here + 2 * across / (3 * n_across)) : here;
  }

  const HexMesh& mesh_;
  const BaseComplex& bc_;
  detail::PlanBuilder builder_;
  std::vector<char> removed_;         // by cell
  std::vector<VertexHandle> top_of_;  // by vertex under the peel
  CollapsePlan plan_;
};

}  // namespace

CollapsePlan plan_peel(const HexMesh& mesh, const BaseComplex& bc, const Peel& peel) {
  return PeelPlan(mesh, bc, peel).take();
}

}  // namespace hexweft
