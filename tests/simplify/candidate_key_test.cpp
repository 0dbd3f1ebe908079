// Candidates known by what they are made of.
#include "simplify/candidate_key.h"

#include <cmath>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "tests/simplify/prediction.h"
#include "tests/simplify/test_meshes.h"

namespace hexweft {
namespace {

bool same_plan(const CollapsePlan& a, const CollapsePlan& b) {
  return a.removed == b.removed && a.members == b.members && a.group_begin == b.group_begin;
}

std::vector<HexMesh> make_some_meshes() {
  std::vector<HexMesh> meshes = {make_pillowed_grid(4), make_torus({.n_around = 12}),
                                 make_octree_like(Shape::sphere, 7)};
  for (unsigned seed = 1; seed <= 4; ++seed)
    meshes.push_back(make_grid_with_random_sheets(3, seed));
  return meshes;
}

TEST(CandidateKey, TellsCandidatesApart) {
  for (const HexMesh& mesh : make_some_meshes()) {
    const BaseComplex bc = extract_base_complex(mesh);
    const CandidateKeys keys(mesh, bc);
    std::set<std::size_t> itself, surroundings;
    const auto candidates = all_candidates(mesh, bc);
    for (const PlannedCandidate& c : candidates) {
      const CandidateKey key = keys.key(c.parts);
      itself.insert(key.itself);
      surroundings.insert(key.surroundings);
    }
    EXPECT_EQ(itself.size(), candidates.size());
    EXPECT_EQ(surroundings.size(), candidates.size());
  }
}

// Each collapse is one that the others may or may not notice.
TEST(CandidateKey, IsKeptAsLongAsTheCellsAre) {
  int kept = 0, changed = 0, only_surroundings = 0;
  for (HexMesh mesh : make_some_meshes()) {
    const HexMesh before = mesh;
    const BaseComplex bc = extract_base_complex(mesh);
    const CandidateKeys keys(mesh, bc);
    const auto candidates = all_candidates(mesh, bc, 3);
    for (std::size_t i = 0; i < candidates.size(); i += 11) {
      Transaction edit(mesh);
      const CollapsePlan& plan = candidates[i].plan;
      apply_plan(mesh, plan, default_targets(mesh, bc.graph, plan));
      if (!is_clean(check_topology(mesh))) continue;
      const BaseComplex bc_after = extract_base_complex(mesh);
      const CandidateKeys keys_after(mesh, bc_after);
      std::map<std::size_t, std::pair<CandidateKey, CollapsePlan>> after;
      for (const PlannedCandidate& c : all_candidates(mesh, bc_after)) {
        const CandidateKey key = keys_after.key(c.parts);
        after[key.itself] = {key, c.plan};
      }
      for (const PlannedCandidate& c : candidates) {
        const CandidateKey key = keys.key(c.parts);
        const auto found = after.find(key.itself);
        if (found == after.end()) {
          ++changed;
          continue;
        }
        const auto& [key_after, plan_after] = found->second;
        const bool same = key_after.surroundings == key.surroundings;
        // What goes with a peel is up to the cells round it.
        EXPECT_TRUE((c.plan.peels && !same) || same_plan(c.plan, plan_after));
        EXPECT_TRUE(!same || is_as_before(before, mesh, c.plan.members));
        if (is_whole(c)) {
          EXPECT_EQ(same, is_as_before(before, mesh, vertices_of_removed(before, c.plan)));
        }
        ++(same ? kept : only_surroundings);
      }
    }
  }
  EXPECT_GT(kept, 0);
  EXPECT_GT(changed, 0);
  EXPECT_GT(only_surroundings, 0);
}

// A chord whose sides are unequal takes the thinnest layers of a sheet with it.
TEST(CandidateKey, KnowsWhichLayersGo) {
  int whole = 0, other_layers = 0;
  for (HexMesh mesh : make_some_meshes()) {
    const BaseComplex bc = extract_base_complex(mesh);
    const CandidateKeys keys(mesh, bc);
    const auto before = all_candidates(mesh, bc);
    double x = 0.3;  // vertices go where no layer is as thin as it was
    for (VertexHandle v : mesh.vertices()) {
      x = std::fmod(137.5 * x + 1, 1.0);
      mesh.set_point(v, mesh.point(v) * (1 + x));
    }
    const auto after = all_candidates(mesh, bc);
    for (std::size_t i = 0; i < before.size(); ++i) {
      const bool same = same_plan(before[i].plan, after[i].plan);
      EXPECT_EQ(keys.key(before[i].parts).itself == keys.key(after[i].parts).itself, same);
      EXPECT_TRUE(same || !is_whole(before[i]));
      ++(same ? whole : other_layers);
    }
  }
  EXPECT_GT(whole, 0);
  EXPECT_GT(other_layers, 0);
}

}  // namespace
}  // namespace hexweft
