/// \file
/// Carries plans out and compares what comes of them with what was predicted.
#pragma once

#include <map>
#include <optional>

#include <gmock/gmock.h>

#include "ovm/topology_check.h"
#include "ovm/topology_summary.h"
#include "ovm/transaction.h"
#include "simplify/candidate_key.h"
#include "simplify/plan_check.h"
#include "tests/ovm/mesh_dump.h"

namespace hexweft {

using VertexPair = std::pair<VertexHandle, VertexHandle>;
using EdgeFacts = std::pair<int, bool>;  ///< cells at the edge; is it on the boundary

inline VertexPair ordered(VertexHandle a, VertexHandle b) {
  return a < b ? VertexPair{a, b} : VertexPair{b, a};
}

inline std::map<VertexPair, EdgeFacts> facts(const std::vector<PredictedEdge>& edges) {
  std::map<VertexPair, EdgeFacts> result;
  for (const PredictedEdge& e : edges) {
    EXPECT_TRUE(result.insert({ordered(e.a, e.b), {e.valence, e.boundary}}).second);
  }
  return result;
}

/// Of the edges at these vertices.
inline std::map<VertexPair, EdgeFacts> facts(const HexMesh& mesh,
                                             std::span<const VertexHandle> vertices) {
  std::map<VertexPair, EdgeFacts> result;
  for (VertexHandle v : vertices) {
    for (EdgeHandle e : mesh.edges(v)) {
      const auto [a, b] = mesh.vertices(e);
      result[ordered(a, b)] = {mesh.valence(e), mesh.is_boundary(e)};
    }
  }
  return result;
}

struct PlannedCandidate {
  std::vector<CandidatePart> parts;
  CollapsePlan plan;
};

inline bool is_whole(const PlannedCandidate& c) {
  return std::all_of(c.parts.begin(), c.parts.end(),
                     [](const CandidatePart& p) { return p.whole; });
}

/// All sheets, every `step`-th chord along both diagonals, and the peels there are where every other
/// edge of the base complex counts as a feature.
inline std::vector<PlannedCandidate> all_candidates(const HexMesh& mesh, const BaseComplex& bc,
                                                    std::size_t step = 1) {
  std::vector<PlannedCandidate> all;
  const std::vector<Sheet> sheets = extract_sheets(bc);
  for (const Sheet& s : sheets) all.push_back({parts_of(s), plan_sheet_collapse(mesh, bc, s)});
  const std::vector<Chord> chords = extract_chords(bc);
  for (std::size_t i = 0; i < chords.size(); i += step) {
    if (can_plan(bc, chords[i], sheets) != Refusal::none) continue;
    for (Diagonal d : {Diagonal::first, Diagonal::second}) {
      all.push_back({parts_of(mesh, bc, chords[i], d, sheets),
                     plan_chord_collapse(mesh, bc, chords[i], d, sheets)});
    }
  }
  std::vector<char> features(bc.edges.size(), 0);
  for (std::size_t i = 0; i < features.size(); i += 2) features[i] = 1;
  for (const Peel& p : extract_peels(bc, sheets, features))
    all.push_back({parts_of(p), plan_peel(mesh, bc, p)});
  return all;
}

inline std::vector<CollapsePlan> all_plans(const HexMesh& mesh, const BaseComplex& bc,
                                           std::size_t step = 1) {
  std::vector<CollapsePlan> plans;
  for (PlannedCandidate& c : all_candidates(mesh, bc, step)) plans.push_back(std::move(c.plan));
  return plans;
}

inline std::vector<VertexHandle> vertices_of_removed(const HexMesh& mesh,
                                                     const CollapsePlan& plan) {
  std::vector<VertexHandle> all;
  for (CellHandle c : plan.removed) {
    for (VertexHandle v : mesh.vertices(c)) all.push_back(v);
  }
  return all;
}

/// Whether the cells at the vertices are, and have the vertices, that they were and had.
inline bool is_as_before(const HexMesh& before, const HexMesh& mesh,
                         std::span<const VertexHandle> vertices) {
  return std::all_of(vertices.begin(), vertices.end(), [&](VertexHandle v) {
    if (!mesh.is_live(v)) return false;
    std::vector<CellHandle> a, b;
    for (CellHandle c : before.cells(v)) a.push_back(c);
    for (CellHandle c : mesh.cells(v)) b.push_back(c);
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    return a == b && std::all_of(a.begin(), a.end(), [&](CellHandle c) {
             const auto x = before.vertices(c), y = mesh.vertices(c);
             return std::equal(x.begin(), x.end(), y.begin(), y.end());
           });
  });
}

/// What became of the plans of a mesh.
struct PlanTally {
  int refused = 0;       ///< by check_plan
  int other_shape = 0;   ///< carried out, and genus, parts or boundaries were others then
  int as_predicted = 0;  ///< carried out, and every edge was as predicted
};

/// Carries a plan out and takes it back.
inline void try_plan(HexMesh& mesh, const BaseComplex& bc, const CollapsePlan& plan,
                     PlanTally& tally, bool compare_dump, const ValenceLimits& limits = {}) {
  if (check_plan(mesh, bc.graph, plan, limits) != Refusal::none) {
    ++tally.refused;
    return;
  }
  const auto predicted = facts(predict_edges(mesh, bc.graph, plan));
  std::optional<MeshDump> before;
  if (compare_dump) before.emplace(mesh);
  const int euler = euler_characteristic(mesh);
  {
    Transaction trial(mesh);
    const auto left = apply_plan(mesh, plan, default_targets(mesh, bc.graph, plan));
    if (euler_characteristic(mesh) != euler || !is_clean(check_topology(mesh, left))) {
      ++tally.other_shape;
    } else {
      EXPECT_EQ(facts(mesh, left), predicted);
      ++tally.as_predicted;
    }
  }
  EXPECT_TRUE(!compare_dump || MeshDump(mesh) == *before);
}

}  // namespace hexweft
