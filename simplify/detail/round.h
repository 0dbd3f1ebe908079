/// \file
/// Collapses between two looks at the whole mesh.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "ovm/neighborhood.h"
#include "ovm/transaction.h"
#include "simplify/candidate_key.h"
#include "simplify/trial.h"

namespace hexweft::detail {

/// Extracting and ranking cost a pass over the mesh each: several collapses share them. For each of
/// these the mesh round it is the one that was extracted from, as none touches what another has
/// changed. Unless it is committed, a round is undone as a whole.
class Round {
 public:
  /// \param bc  of the mesh; must outlive the collapses
  Round(HexMesh& mesh, const BaseComplex& bc)
      : mesh_(mesh), bc_(bc), change_(mesh), cells_seen_(mesh.cell_slots()) {}

  bool empty() const { return collapses_.empty(); }
  const std::vector<CandidateKey>& collapses() const { return collapses_; }

  /// Whether all cells at the vertices of the whole parts are those they were when the round began.
  bool is_clear_of(std::span<const CandidatePart> parts) const {
    return empty() || std::none_of(parts.begin(), parts.end(), [&](const CandidatePart& p) {
             return p.whole && touched_component_[p.component] != 0;
           });
  }
  /// The same of the members, those of layers that go with a chord among them.
  bool is_clear_of(const CollapsePlan& plan) const {
    return empty() || std::none_of(plan.members.begin(), plan.members.end(),
                                   [&](VertexHandle v) { return touched_vertex_[v.idx] != 0; });
  }

  /// \param plan  of the candidate, was carried out, maybe with splits of sheets anywhere
  void add(const CandidateKey& candidate, const CollapsePlan& plan) {
    touched_vertex_.resize(mesh_.vertex_slots(), 0);
    std::vector<VertexHandle> left;
    for (VertexHandle v : plan.members) {
      touched_vertex_[v.idx] = 1;
      if (mesh_.is_live(v)) left.push_back(v);
    }
    for (CellHandle c : cells_around(mesh_, left, 1)) touch(c);
    for (; cells_seen_ < mesh_.cell_slots(); ++cells_seen_) {  // of splits
      if (const CellHandle c(cells_seen_); mesh_.is_live(c)) touch(c);
    }
    touched_component_.resize(bc_.components.size(), 0);
    for (std::size_t i = 0; i < bc_.components.size(); ++i) {
      const auto vertices = bc_.grid(bc_.components[i]);
      touched_component_[i] = std::any_of(vertices.begin(), vertices.end(),
                                          [&](VertexHandle v) { return touched_vertex_[v.idx]; });
    }
    collapses_.push_back(candidate);
  }

  void commit() { change_.commit(); }
  void take_back() { change_.rollback(); }

 private:
  void touch(CellHandle c) {
    for (VertexHandle v : mesh_.vertices(c)) touched_vertex_[v.idx] = 1;
  }

  HexMesh& mesh_;
  const BaseComplex& bc_;
  Transaction change_;
  std::vector<CandidateKey> collapses_;
  std::vector<char> touched_vertex_, touched_component_;
  int cells_seen_;  // slots
};

}  // namespace hexweft::detail
