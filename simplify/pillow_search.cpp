#include "simplify/pillow_search.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>

#include "ovm/detail/sort_unique.h"
#include "ovm/topology_check.h"
#include "ovm/transaction.h"

namespace hexweft {
namespace {

// Components that have to go more than come for a pillow to be worth a trial.
constexpr int kLeastGain = 2;

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
  detail::sort_unique(found.groups);
  return found;
}

Obstacle find_obstacle(HexMesh& mesh, const SingularityGraph& graph, const CollapsePlan& plan,
                       const ValenceLimits& limits) {
  const Refusal refusal = check_plan(mesh, graph, plan, limits);
  if (refusal == Refusal::none) return doublets_after(mesh, graph, plan);
  if (refusal != Refusal::valence) return {refusal};
  return {refusal, groups_out_of_limits(mesh, graph, plan, limits)};
}

// The pillows of one sheet that gain so much at least.
class PillowSearch {
 public:
  /// \param most_added  components that a pillow may have
  PillowSearch(HexMesh& mesh, const BaseComplex& bc, const Sheet& sheet,
               const ValenceLimits& limits, int most_added)
      : mesh_(mesh),
        bc_(bc),
        sheet_(sheet),
        limits_(limits),
        plan_(plan_sheet_collapse(mesh, bc, sheet)),
        most_added_(most_added) {}

  std::vector<Pillow> run() {
    std::vector<Pillow> pillows;
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
      if (!pillow || pillow->added > most_added_) return std::nullopt;
      Transaction look(mesh_);
      const auto inserted = insert_pillow(mesh_, bc_, sheet_, plan_, *pillow);
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
    detail::sort_unique(groups);
  }

  HexMesh& mesh_;
  const BaseComplex& bc_;
  const Sheet& sheet_;
  const ValenceLimits& limits_;
  CollapsePlan plan_;  // without a pillow
  int most_added_;
};

}  // namespace

std::vector<PillowedSheet> find_pillows(HexMesh& mesh, const BaseComplex& bc,
                                        const std::vector<Sheet>& sheets,
                                        const ValenceLimits& limits, int most) {
  const auto n = static_cast<int>(sheets.size());
  std::vector<int> n_components(n), in_turn(n);
  for (int i = 0; i < n; ++i) n_components[i] = static_cast<int>(components_of(sheets[i]).size());
  std::iota(in_turn.begin(), in_turn.end(), 0);
  std::stable_sort(in_turn.begin(), in_turn.end(),
                   [&](int a, int b) { return n_components[a] > n_components[b]; });
  std::vector<PillowedSheet> found;
  int least_gain = kLeastGain;
  for (int i : in_turn) {
    if (n_components[i] <= least_gain) break;  // a pillow has one component at least
    const int most_added = n_components[i] - least_gain;
    for (Pillow& pillow : PillowSearch(mesh, bc, sheets[i], limits, most_added).run()) {
      const int gain = n_components[i] - pillow.added;
      found.push_back({i, std::move(pillow), gain});
    }
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
      return a.gain != b.gain ? a.gain > b.gain : a.sheet < b.sheet;
    });
    if (std::ssize(found) < most) continue;
    found.resize(most);
    least_gain = found.back().gain;
  }
  return found;
}

}  // namespace hexweft
