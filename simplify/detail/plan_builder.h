/// \file
/// Puts plans together from merges of two vertices.
#pragma once

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "ovm/detail/disjoint_sets.h"
#include "ovm/detail/sort_unique.h"
#include "simplify/collapse_plan.h"

namespace hexweft::detail {

/// Collects the classes of vertices and the cells of a plan.
class PlanBuilder {
 public:
  explicit PlanBuilder(const HexMesh& mesh) : local_(mesh.vertex_slots(), -1) {}

  /// A vertex that merges with no other, maybe.
  void add(VertexHandle v) { local(v); }
  void join(VertexHandle a, VertexHandle b) { sets_.join(local(a), local(b)); }
  void remove(std::span<const CellHandle> cells) {
    plan_.removed.insert(plan_.removed.end(), cells.begin(), cells.end());
  }

  CollapsePlan finish(int width) {
    sort_unique(plan_.removed);
    std::vector<std::pair<int, VertexHandle>> by_class;
    by_class.reserve(sets_.size());
    for (int i = 0; i < sets_.size(); ++i) by_class.emplace_back(sets_.find(i), vertices_[i]);
    std::sort(by_class.begin(), by_class.end());
    for (std::size_t i = 0; i < by_class.size(); ++i) {
      if (i > 0 && by_class[i].first != by_class[i - 1].first) close_group();
      plan_.members.push_back(by_class[i].second);
    }
    if (!plan_.members.empty()) close_group();
    plan_.width = width;
    return std::move(plan_);
  }

 private:
  int local(VertexHandle v) {
    int& id = local_[v.idx];
    if (id < 0) {
      id = sets_.add();
      vertices_.push_back(v);
    }
    return id;
  }
  void close_group() { plan_.group_begin.push_back(static_cast<int>(plan_.members.size())); }

  std::vector<int> local_;  // by vertex handle
  std::vector<VertexHandle> vertices_;
  DisjointSets sets_;
  CollapsePlan plan_;
};

}  // namespace hexweft::detail
