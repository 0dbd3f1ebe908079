#include "simplify/pillow.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <unordered_map>

#include "ovm/topology_check.h"
#include "ovm/transaction.h"
#include "simplify/component_cut.h"

namespace hexweft {
namespace {

// Whether a component's axis runs against the direction of the sheet.
bool runs_against(const BaseComplex& bc, const Sheet& sheet, const Crossing& x) {
  const Component& c = bc.components[x.component];
  const int edge = 4 * x.axis;
  const auto i = std::lower_bound(sheet.edges.begin(), sheet.edges.end(), c.edges[edge]);
  const bool edge_against = sheet.against[i - sheet.edges.begin()] != 0;
  return edge_against != (bc.edges[*i].ends[0] != c.corners[kEdgeCorners[edge][0]]);
}

// Components that have to go more than come for a pillow to be worth a trial.
constexpr int kLeastGain = 2;

void sort_unique(std::vector<int>& some) {
  std::sort(some.begin(), some.end());
  some.erase(std::unique(some.begin(), some.end()), some.end());
}

std::vector<int> components_of(const Sheet& sheet) {
  std::vector<int> crossed;
  for (const Crossing& x : sheet.crossings) crossed.push_back(x.component);
  sort_unique(crossed);
  return crossed;
}

// Of a violation, those that may have been merged.
std::vector<VertexHandle> vertices_of(const HexMesh& mesh, const TopologyViolation& v) {
  switch (v.defect) {
    case TopologyDefect::doublet:
    case TopologyDefect::nonmanifold_vertex:
      return {VertexHandle(v.index)};
    case TopologyDefect::low_valence_edge:
    case TopologyDefect::nonmanifold_edge: {
      const auto ends = mesh.vertices(EdgeHandle(v.index));
      return {ends.begin(), ends.end()};
    }
    case TopologyDefect::multiply_glued_cells: {
      const auto corners = mesh.vertices(CellHandle(v.index));
      return {corners.begin(), corners.end()};
    }
    default:
      return {};
  }
}

// What keeps a plan from being carried out, as far as a pillow may help.
struct Obstacle {
  Refusal refusal = Refusal::none;
  std::vector<int> groups = {};  // that must not merge, ascending; none: no pillow helps
};

Obstacle doublets_after(HexMesh& mesh, const SingularityGraph& graph, const CollapsePlan& plan) {
  std::unordered_map<int, int> group_of;  // by the index of what is left of it
  for (int g = 0; g < plan.n_groups(); ++g) group_of[plan.group(g)[0].idx] = g;
  Transaction look(mesh);
  const auto left = apply_plan(mesh, plan, default_targets(mesh, graph, plan));
  Obstacle found;
  for (const TopologyViolation& violation : check_topology(mesh, left)) {
    if (severity(violation.defect) < Severity::degenerate) continue;
    found.refusal = Refusal::topology;
    for (VertexHandle v : vertices_of(mesh, violation)) {
      if (const auto g = group_of.find(v.idx); g != group_of.end())
        found.groups.push_back(g->second);
    }
  }
  sort_unique(found.groups);
  return found;
}

Obstacle find_obstacle(HexMesh& mesh, const SingularityGraph& graph, const CollapsePlan& plan,
                       const ValenceLimits& limits) {
  const Refusal refusal = check_plan(mesh, graph, plan, limits);
  if (refusal == Refusal::none) return doublets_after(mesh, graph, plan);
  if (refusal != Refusal::valence) return {refusal};
  return {refusal, groups_out_of_limits(mesh, graph, plan, limits)};
}

}  // namespace

std::vector<char> sides_of_sheet(const HexMesh& mesh, const BaseComplex& bc, const Sheet& sheet) {
  std::vector<char> sides(mesh.vertex_slots(), 0);
  for (const Crossing& x : sheet.crossings) {
    const Component& c = bc.components[x.component];
    const bool against = runs_against(bc, sheet, x);
    const int u = (x.axis + 1) % 3, v = (x.axis + 2) % 3;
    std::array<int, 3> at;
    for (int end = 0; end < 2; ++end) {
      at[x.axis] = end * c.n[x.axis];
      const char side = (end == 1) != against ? 2 : 1;
      for (at[u] = 0; at[u] <= c.n[u]; ++at[u]) {
        for (at[v] = 0; at[v] <= c.n[v]; ++at[v])
          sides[bc.vertex(c, at[0], at[1], at[2]).idx] |= side;
      }
    }
  }
  return sides;
}

std::optional<Pillow> smallest_pillow(const HexMesh& mesh, const BaseComplex& bc,
                                      const Sheet& sheet, const CollapsePlan& plan,
                                      std::span<const int> groups, int side) {
  const std::vector<char> sides = sides_of_sheet(mesh, bc, sheet);
  const std::vector<int> crossed = components_of(sheet);
  std::vector<int> inside, outside;
  for (int g : groups) {
    for (VertexHandle v : plan.group(g)) {
      for (CellHandle cell : mesh.cells(v)) {
        const int c = bc.component_of_cell[cell.idx];
        if (std::binary_search(crossed.begin(), crossed.end(), c)) continue;
        (sides[v.idx] & (1 << side) ? inside : outside).push_back(c);
      }
    }
  }
  outside.insert(outside.end(), crossed.begin(), crossed.end());
  sort_unique(inside);
  sort_unique(outside);
  std::vector<int> both;
  std::set_intersection(inside.begin(), inside.end(), outside.begin(), outside.end(),
                        std::back_inserter(both));
  if (inside.empty() || !both.empty()) return std::nullopt;
  const ComponentCut cut = smallest_cut(bc, inside, outside);
  Pillow pillow;
  pillow.added = cut.n_faces;
  for (int c = 0; c < static_cast<int>(cut.inside.size()); ++c) {
    if (cut.inside[c]) pillow.inside.push_back(c);
  }
  return pillow;
}

namespace {

// The sheet through the same mesh edges in a new base complex, if there is one.
std::optional<Sheet> find_again(const HexMesh& mesh, const BaseComplex& before, const Sheet& sheet,
                                const BaseComplex& bc) {
  for (int e : sheet.edges) {
    const auto chain = before.chain(before.edges[e]);
    const HalfEdgeHandle first = mesh.find_halfedge(chain[0], chain[1]);
    const int now = first.valid() ? bc.base_edge_of_edge[mesh.edge(first).idx] : -1;
    if (now < 0) continue;
    for (Sheet& s : extract_sheets(bc)) {
      if (std::binary_search(s.edges.begin(), s.edges.end(), now)) return std::move(s);
    }
  }
  return std::nullopt;
}

// The pillows of one sheet.
class PillowSearch {
 public:
  PillowSearch(HexMesh& mesh, const BaseComplex& bc, const Sheet& sheet,
               const ValenceLimits& limits)
      : mesh_(mesh),
        bc_(bc),
        sheet_(sheet),
        limits_(limits),
        plan_(plan_sheet_collapse(mesh, bc, sheet)),
        n_components_(static_cast<int>(components_of(sheet).size())) {}

  int n_components() const { return n_components_; }

  std::vector<Pillow> run() {
    std::vector<Pillow> pillows;
    if (n_components_ <= kLeastGain) return pillows;
    const Obstacle obstacle = find_obstacle(mesh_, bc_.graph, plan_, limits_);
    if (obstacle.groups.empty()) return pillows;
    for (int side = 0; side < 2; ++side) {
      if (auto pillow = on_side(side, obstacle.groups)) pillows.push_back(*std::move(pillow));
    }
    return pillows;
  }

 private:
  // At the rim of a pillow there may be new obstacles: then it has to reach farther.
  std::optional<Pillow> on_side(int side, std::vector<int> groups) {
    constexpr int kTimes = 4;
    for (int i = 0; i < kTimes; ++i) {
      auto pillow = smallest_pillow(mesh_, bc_, sheet_, plan_, groups, side);
      if (!pillow || pillow->added + kLeastGain > n_components_) return std::nullopt;
      Transaction look(mesh_);
      const auto inserted = insert_pillow(mesh_, bc_, sheet_, *pillow);
      if (!inserted) return std::nullopt;
      const Obstacle obstacle =
          find_obstacle(mesh_, inserted->base_complex.graph, inserted->plan, limits_);
      if (obstacle.refusal == Refusal::none) return pillow;
      const std::size_t known = groups.size();
      add_known(*inserted, obstacle.groups, groups);
      if (groups.size() == known) return std::nullopt;
    }
    return std::nullopt;
  }

  // Adds groups of the plan as it was in which there are members of these.
  void add_known(const InsertedPillow& inserted, std::span<const int> of_new_plan,
                 std::vector<int>& groups) const {
    std::unordered_map<int, VertexHandle> outer;  // by the index of the inner copy
    for (const auto& copy : inserted.layer.copies) outer[copy.inner.idx] = copy.outer;
    std::unordered_map<int, int> group_of;  // by the index of the member
    for (int g = 0; g < plan_.n_groups(); ++g) {
      for (VertexHandle v : plan_.group(g)) group_of[v.idx] = g;
    }
    for (int g : of_new_plan) {
      for (VertexHandle v : inserted.plan.group(g)) {
        const auto copied = outer.find(v.idx);
        const auto known = group_of.find(copied == outer.end() ? v.idx : copied->second.idx);
        if (known != group_of.end()) groups.push_back(known->second);
      }
    }
    sort_unique(groups);
  }

  HexMesh& mesh_;
  const BaseComplex& bc_;
  const Sheet& sheet_;
  const ValenceLimits& limits_;
  CollapsePlan plan_;  // without a pillow
  int n_components_;   // of the sheet
};

}  // namespace

std::optional<InsertedPillow> insert_pillow(HexMesh& mesh, const BaseComplex& bc,
                                            const Sheet& sheet, const Pillow& pillow) {
  std::vector<CellHandle> inside;
  for (int c : pillow.inside) {
    const auto cells = bc.cells(bc.components[c]);
    inside.insert(inside.end(), cells.begin(), cells.end());
  }
  const std::vector<CellHandle> removed = plan_sheet_collapse(mesh, bc, sheet).removed;
  InsertedPillow result;
  result.layer = insert_sheet(mesh, inside);
  if (result.layer.refusal != InsertRefusal::none) return std::nullopt;
  result.base_complex = extract_base_complex(mesh);
  if (result.base_complex.irregular > 0) return std::nullopt;
  const auto now = find_again(mesh, bc, sheet, result.base_complex);
  if (!now) return std::nullopt;
  result.plan = plan_sheet_collapse(mesh, result.base_complex, *now);
  if (result.plan.removed != removed) return std::nullopt;
  return result;
}

std::vector<PillowedSheet> find_pillows(HexMesh& mesh, const BaseComplex& bc,
                                        const std::vector<Sheet>& sheets,
                                        const ValenceLimits& limits) {
  std::vector<PillowedSheet> found;
  for (int i = 0; i < static_cast<int>(sheets.size()); ++i) {
    PillowSearch search(mesh, bc, sheets[i], limits);
    for (Pillow& pillow : search.run()) {
      const int gain = search.n_components() - pillow.added;
      found.push_back({i, std::move(pillow), gain});
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const PillowedSheet& a, const PillowedSheet& b) { return a.gain > b.gain; });
  return found;
}

}  // namespace hexweft
