#include "simplify/feature_targets.h"

#include <algorithm>
#include <optional>
#include <vector>

#include <gmock/gmock.h>

#include "tests/simplify/test_meshes.h"
#include "tests/simplify/trial_bench.h"

namespace hexweft {
namespace {

using Eigen::Vector3d;

// A box of 4 x 3 x 2 cells: 8 corners, 12 lines, all sharp.
struct Box : TrialBench {
  Box() : TrialBench(make_grid({4, 3, 2}), 0.01, FeatureMode::automatic) {}
  VertexHandle at(double x, double y, double z) const {
    for (VertexHandle v : mesh.vertices()) {
      if ((mesh.point(v) - Vector3d(x, y, z)).norm() < 1e-9) return v;
    }
    return VertexHandle();
  }
  // Where a group of these goes, if it may be.
  std::optional<Vector3d> target(std::vector<VertexHandle> group) {
    std::sort(group.begin(), group.end());
    CollapsePlan plan;
    plan.members = group;
    plan.group_begin.push_back(static_cast<int>(group.size()));
    const auto targets =
        feature_targets(mesh, bc.graph, plan, context.feature_labels(), reference.curves());
    if (!targets) return std::nullopt;
    return targets->front();
  }
};

MATCHER_P3(IsAt, x, y, z, "") { return arg && (*arg - Vector3d(x, y, z)).norm() < 1e-9; }

TEST(FeatureTargets, WithoutAFeatureAreTheDefaultOnes) {
  Box box;
  EXPECT_THAT(box.target({box.at(1, 1, 1), box.at(2, 1, 1)}), IsAt(1.5, 1, 1));
  EXPECT_THAT(box.target({box.at(1, 1, 0), box.at(1, 1, 1)}), IsAt(1, 1, 0)) << "the boundary";
}

TEST(FeatureTargets, ALineKeepsItsVertices) {
  Box box;
  EXPECT_THAT(box.target({box.at(2, 0, 0), box.at(2, 1, 0)}), IsAt(2, 0, 0));
  EXPECT_THAT(box.target({box.at(1, 0, 0), box.at(2, 0, 0), box.at(2, 1, 0)}), IsAt(1.5, 0, 0));
}

TEST(FeatureTargets, ACornerStaysWhateverMergesIntoIt) {
  Box box;
  EXPECT_THAT(box.target({box.at(0, 0, 0), box.at(1, 1, 0)}), IsAt(0, 0, 0));
  EXPECT_THAT(box.target({box.at(0, 0, 0), box.at(1, 0, 0)}), IsAt(0, 0, 0)) << "its own line";
}

TEST(FeatureTargets, ThereAreNoneWhereAFeatureWouldGo) {
  Box box;
  EXPECT_FALSE(box.target({box.at(0, 0, 0), box.at(4, 0, 0)})) << "two corners";
  EXPECT_FALSE(box.target({box.at(1, 0, 0), box.at(1, 3, 0)})) << "two lines";
  EXPECT_FALSE(box.target({box.at(0, 0, 0), box.at(1, 3, 0)})) << "a line that ends elsewhere";
}

TEST(BaseEdgesOnFeatures, AreThoseOfABoxThatIsOneComponent) {
  Box box;
  ASSERT_EQ(box.bc.components.size(), 1u);
  const auto on = base_edges_on_features(box.bc, box.context.feature_labels());
  EXPECT_THAT(on, testing::AllOf(testing::SizeIs(12), testing::Each(1)));
}

TEST(BaseEdgesOnFeatures, WithoutFeaturesAreNone) {
  TrialBench bar(make_o_grid({.n_core = 2, .n_ring = 2, .n_layers = 2}), 0.01, FeatureMode::off);
  const auto on = base_edges_on_features(bar.bc, bar.context.feature_labels());
  EXPECT_THAT(on, testing::Each(0));
}

}  // namespace
}  // namespace hexweft
