/// \file
/// Collapses between two looks at the whole mesh.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "ovm/transaction.h"
#include "simplify/collapse_plan.h"
#include "simplify/trial.h"

namespace hexweft::detail {

/// Extracting and ranking cost a pass over the mesh each: several collapses share them. For each of
/// these the mesh round it is the one that was extracted from, as none touches what another has
/// changed. Unless it is committed, a round is undone as a whole.
class Round {
 public:
  explicit Round(HexMesh& mesh) : mesh_(mesh), change_(mesh), cells_seen_(mesh.cell_slots()) {}

  bool empty() const { return collapses_.empty(); }
  const std::vector<CollapsePlan>& collapses() const { return collapses_; }

  /// Whether the cells at the members are those they were when the round began.
  bool is_clear_of(const CollapsePlan& plan) const {
    return touched_.empty() || std::none_of(plan.members.begin(), plan.members.end(),
                                            [&](VertexHandle v) { return touched_[v.idx] != 0; });
  }

  /// \param plan  was carried out, maybe with splits of sheets anywhere
  void add(CollapsePlan plan) {
    touched_.resize(mesh_.vertex_slots(), 0);
    std::vector<VertexHandle> left;
    for (VertexHandle v : plan.members) {
      touched_[v.idx] = 1;
      if (mesh_.is_live(v)) left.push_back(v);
    }
    for (CellHandle c : cells_around(mesh_, left, 1)) {
      for (VertexHandle v : mesh_.vertices(c)) touched_[v.idx] = 1;
    }
    for (; cells_seen_ < mesh_.cell_slots(); ++cells_seen_) {  // of splits
      const CellHandle c(cells_seen_);
      if (!mesh_.is_live(c)) continue;
      for (VertexHandle v : mesh_.vertices(c)) touched_[v.idx] = 1;
    }
    collapses_.push_back(std::move(plan));
  }

  void commit() { change_.commit(); }
  void take_back() { change_.rollback(); }

 private:
  HexMesh& mesh_;
  Transaction change_;
  std::vector<CollapsePlan> collapses_;
  std::vector<char> touched_;  // by vertex
  int cells_seen_;             // slots
};

}  // namespace hexweft::detail
