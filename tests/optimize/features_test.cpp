// Lines and corners of surfaces made in code; noise, gaps; the curves' closest points.
#include "optimize/features.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "optimize/feature_curves.h"
#include "optimize/reference_surface.h"
#include "ovm/errors.h"
#include "tests/optimize/test_meshes.h"

namespace hexweft {
namespace {

SurfaceFeatures features_of(const HexMesh& mesh, const FeatureOptions& options = {}) {
  const ReferenceSurface s = make_reference_surface(mesh);
  return find_features(s.points(), s.triangles(), options);
}

int n_closed(const SurfaceFeatures& features) {
  return static_cast<int>(std::count_if(features.lines.begin(), features.lines.end(),
                                        [](const FeatureLine& l) { return l.closed; }));
}

TEST(Features, ACubeHasTwelveLinesAndEightCorners) {
  for (int n : {1, 2, 5}) {
    const SurfaceFeatures f = features_of(make_grid({n, n, n}));
    EXPECT_EQ(f.lines.size(), 12u);
    EXPECT_EQ(f.corners.size(), 8u);
    EXPECT_TRUE(std::is_sorted(f.corners.begin(), f.corners.end()));
    for (const FeatureLine& line : f.lines) {
      EXPECT_FALSE(line.closed);
      EXPECT_EQ(line.n_segments(), n);
      for (int end : {line.points.front(), line.points.back()}) {
        EXPECT_TRUE(std::binary_search(f.corners.begin(), f.corners.end(), end));
      }
    }
  }
}

TEST(Features, ACylinderHasTwoClosedLines) {
  const OGridOptions options{.n_core = 4, .n_ring = 2, .n_layers = 5};
  const SurfaceFeatures f = features_of(make_o_grid(options));
  EXPECT_EQ(f.lines.size(), 2u);
  EXPECT_EQ(n_closed(f), 2);
  EXPECT_TRUE(f.corners.empty());
  for (const FeatureLine& line : f.lines) EXPECT_EQ(line.n_segments(), 4 * options.n_core);
}

TEST(Features, ASquareRingHasFourClosedLines) {
  const SurfaceFeatures f = features_of(make_torus({.n_around = 24, .round_section = false}));
  EXPECT_EQ(f.lines.size(), 4u);
  EXPECT_EQ(n_closed(f), 4);
}

TEST(Features, AnLHasEighteenLinesAndTwelveCorners) {
  const SurfaceFeatures f = features_of(make_l_shape(3));
  EXPECT_EQ(f.lines.size(), 18u);
  EXPECT_EQ(f.corners.size(), 12u);
}

TEST(Features, SmoothSurfacesHaveNone) {
  EXPECT_TRUE(features_of(make_ball(10)).lines.empty());
  for (Shape shape : {Shape::sphere, Shape::blob, Shape::torus, Shape::dumbbell}) {
    for (int resolution : {8, 16}) {
      const SurfaceFeatures f = features_of(make_octree_like(shape, resolution, 3));
      EXPECT_TRUE(f.lines.empty()) << name(shape) << ' ' << resolution;
      EXPECT_TRUE(f.corners.empty()) << name(shape) << ' ' << resolution;
    }
  }
}

TEST(Features, ModeAndAngleDecideWhatCounts) {
  const HexMesh cube = make_grid({3, 3, 3});
  EXPECT_TRUE(features_of(cube, {.mode = FeatureMode::off}).lines.empty());
  EXPECT_TRUE(features_of(cube, {.mode = FeatureMode::angle, .angle_deg = 95}).lines.empty());
  EXPECT_EQ(features_of(cube, {.mode = FeatureMode::angle, .angle_deg = 85}).lines.size(), 12u);
  EXPECT_THROW(features_of(cube, {.angle_deg = 0}), InputError);
  EXPECT_THROW(features_of(cube, {.angle_deg = 181}), InputError);
}

TEST(Features, DoNotDependOnTheUnitOfLength) {
  HexMesh mesh = make_l_shape(2);
  for (VertexHandle v : mesh.vertices()) mesh.set_point(v, 1e-6 * mesh.point(v));
  EXPECT_EQ(features_of(mesh).lines.size(), 18u);
}

/// A sheet of n × 4 squares along x, by its heights.
template <class Height>
ReferenceSurface make_sheet(int n, Height&& height) {
  Eigen::Matrix3Xd points(3, (n + 1) * 5);
  std::vector<std::array<int, 3>> triangles;
  for (int x = 0; x <= n; ++x) {
    for (int y = 0; y <= 4; ++y) points.col(5 * x + y) << x, y, height(x, y);
  }
  for (int x = 0; x < n; ++x) {
    for (int y = 0; y < 4; ++y) {
      const int a = 5 * x + y;
      triangles.push_back({a, a + 5, a + 6});
      triangles.push_back({a + 6, a + 1, a});
    }
  }
  return ReferenceSurface(points, triangles);
}

TEST(Features, AGapIsClosedWhereTheLineGoesOn) {
  // A roof whose ridge is bent by 33° only, at two places next to each other.
  const auto roof = [](int x, int y) { return -std::abs(y - 2) * (x == 7 || x == 8 ? 0.3 : 1.0); };
  const SurfaceFeatures f = make_sheet(16, roof).curves().features();
  std::set<int> on_ridge;
  for (const FeatureLine& line : f.lines) {
    for (int p : line.points) {
      if (p % 5 == 2) on_ridge.insert(p);
    }
  }
  EXPECT_EQ(on_ridge.size(), 17u);
}

TEST(Features, AnOpenSheetHasItsBorder) {
  const SurfaceFeatures f = make_sheet(8, [](int, int) { return 0.0; }).curves().features();
  EXPECT_EQ(f.lines.size(), 4u);
  EXPECT_EQ(f.corners.size(), 4u);
}

TEST(Features, ASpikeIsNoise) {
  const auto spike = [](int x, int y) { return x == 4 && y == 2 ? 1.5 : 0.0; };
  const SurfaceFeatures f = make_sheet(8, spike).curves().features();
  EXPECT_EQ(f.lines.size(), 4u);  // the border
}

TEST(FeatureCurves, ClosestPointsAreTheBruteForceOnes) {
  const ReferenceSurface s = make_reference_surface(make_o_grid({.n_core = 8, .n_layers = 8}));
  const FeatureCurves& curves = s.curves();
  ASSERT_EQ(curves.n_lines(), 2);
  Random random(6);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d p = random.in_cube(2);
    double best = std::numeric_limits<double>::infinity();
    for (int line = 0; line < 2; ++line) {
      double of_line = std::numeric_limits<double>::infinity();
      for (int k = 0; k <= 4000; ++k) {
        const CurvePoint on = curves.at(line, curves.length(line) * k / 4000);
        of_line = std::min(of_line, (on.point - p).norm());
      }
      const CurvePoint c = curves.closest(p, line);
      EXPECT_LE(c.distance, of_line + 1e-12);
      EXPECT_NEAR(c.distance, of_line, 2e-3);
      EXPECT_NEAR((c.point - p).norm(), c.distance, 1e-12);
      EXPECT_LT((curves.at(line, c.at).point - c.point).norm(), 1e-9);
      EXPECT_NEAR(c.tangent.norm(), 1, 1e-12);
      best = std::min(best, c.distance);
    }
    EXPECT_EQ(curves.closest_within(p, 2 * best).distance, best);
    EXPECT_EQ(curves.closest_within(p, 0.99 * best).line, -1);
    const double reach = 0.7;
    EXPECT_EQ(curves.within(p, reach).empty(), best >= reach);
  }
}

TEST(FeatureCurves, WithinReachIsEveryLineThatIsSoClose) {
  for (const HexMesh& mesh : {make_l_shape(4), make_torus({.n_around = 24, .round_section = false}),
                              make_o_grid({.n_core = 8, .n_layers = 8})}) {
    const ReferenceSurface s = make_reference_surface(mesh);
    const FeatureCurves& curves = s.curves();
    ASSERT_GE(curves.n_lines(), 2);
    Random random(7);
    for (int i = 0; i < 300; ++i) {
      const Eigen::Vector3d p = random.in_cube(4);
      for (const double reach : {0.05, 0.5, 3.0}) {
        std::vector<int> found, expected;
        for (const CurvePoint& c : curves.within(p, reach)) {
          found.push_back(c.line);
          EXPECT_EQ(c.distance, curves.closest(p, c.line).distance);
        }
        for (int line = 0; line < curves.n_lines(); ++line) {
          if (curves.closest(p, line).distance <= reach) expected.push_back(line);
        }
        EXPECT_EQ(found, expected);
      }
    }
  }
}

TEST(FeatureCurves, AreEmptyWithoutFeatures) {
  const ReferenceSurface s = make_reference_surface(make_ball(6));
  EXPECT_EQ(s.curves().closest_within({1, 0, 0}, 10).line, -1);
  EXPECT_TRUE(s.curves().within({1, 0, 0}, 10).empty());
}

}  // namespace
}  // namespace hexweft
