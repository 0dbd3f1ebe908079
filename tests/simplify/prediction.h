/// \file
/// Carries plans out and compares what comes of them with what was predicted.
#pragma once

#include <map>
#include <optional>

#include <gmock/gmock.h>

#include "ovm/topology_check.h"
#include "ovm/topology_summary.h"
#include "ovm/transaction.h"
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

/// All sheets, and every `step`-th chord along both diagonals.
inline std::vector<CollapsePlan> all_plans(const HexMesh& mesh, const BaseComplex& bc,
                                           std::size_t step = 1) {
  std::vector<CollapsePlan> plans;
  const std::vector<Sheet> sheets = extract_sheets(bc);
  for (const Sheet& s : sheets) plans.push_back(plan_sheet_collapse(mesh, bc, s));
  const std::vector<Chord> chords = extract_chords(bc);
  for (std::size_t i = 0; i < chords.size(); i += step) {
    if (can_plan(bc, chords[i], sheets) != Refusal::none) continue;
    for (Diagonal d : {Diagonal::first, Diagonal::second}) {
      plans.push_back(plan_chord_collapse(mesh, bc, chords[i], d, sheets));
    }
  }
  return plans;
}

/// What became of the plans of a mesh.
struct PlanTally {
  int refused = 0;       ///< by check_plan
  int other_shape = 0;   ///< carried out, and genus, parts or boundaries were others then
  int as_predicted = 0;  ///< carried out, and every edge was as predicted
};

/// Carries a plan out and takes it back.
inline void try_plan(HexMesh& mesh, const BaseComplex& bc, const CollapsePlan& plan,
                     PlanTally& tally, bool compare_dump) {
  if (check_plan(mesh, bc.graph, plan) != Refusal::none) {
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
