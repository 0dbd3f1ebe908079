// Searches that pass over what is close find what looking everywhere finds.
#include "optimize/farthest_sample.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "optimize/covered_parts.h"
#include "optimize/reference_surface.h"
#include "tests/optimize/test_meshes.h"

namespace hexweft {
namespace {

using Triangle = std::array<Eigen::Vector3d, 3>;

Triangle random_triangle(Random& random, double flatness) {
  Triangle t;
  for (auto& p : t) {
    for (int k = 0; k < 3; ++k) p[k] = random.uniform(-1, 1);
  }
  t[2][1] = t[2][1] * flatness + (t[0][1] + t[1][1]) / 2 * (1 - flatness);
  return t;
}

TEST(CoveringRadius, IsThatOfRandomTriangles) {
  constexpr int kSteps = 60;
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const auto [p, q, r] = random_triangle(random, i % 2 == 0 ? 1 : 0.05);
    double farthest = 0;
    for (int a = 0; a <= kSteps; ++a) {
      for (int b = 0; a + b <= kSteps; ++b) {
        const Eigen::Vector3d x = (a * p + b * q + (kSteps - a - b) * r) / kSteps;
        farthest = std::max(farthest, std::min({(x - p).norm(), (x - q).norm(), (x - r).norm()}));
      }
    }
    const double step = std::max({(q - p).norm(), (r - q).norm(), (p - r).norm()}) / kSteps;
    EXPECT_GE(covering_radius(p, q, r), farthest * (1 - 1e-12));
    EXPECT_LE(covering_radius(p, q, r), farthest + step);
  }
}

TEST(CoveringRadius, IsKnownWhereCornersCoincide) {
  const Eigen::Vector3d p(1, 2, 3), q(1, 2, 5);
  EXPECT_DOUBLE_EQ(covering_radius(p, p, q), 1);
  EXPECT_DOUBLE_EQ(covering_radius(p, q, p), 1);
  EXPECT_DOUBLE_EQ(covering_radius(q, p, p), 1);
  EXPECT_DOUBLE_EQ(covering_radius(p, p, p), 0);
  EXPECT_DOUBLE_EQ(covering_radius(p, (p + q) / 2, q), 0.5);
}

// The farthest of all the samples: corners and centroids of the parts.
template <class F>
double look_everywhere(const Triangle& t, int levels, F&& distance) {
  const auto& [a, b, c] = t;
  double d = std::max({distance(a), distance(b), distance(c), distance((a + b + c) / 3)});
  if (levels == 0) return d;
  const Eigen::Vector3d ab = (a + b) / 2, bc = (b + c) / 2, ca = (c + a) / 2;
  for (const Triangle& part :
       {Triangle{a, ab, ca}, Triangle{ab, b, bc}, Triangle{ca, bc, c}, Triangle{ab, bc, ca}}) {
    d = std::max(d, look_everywhere(part, levels - 1, distance));
  }
  return d;
}

TEST(FarthestSample, IsThatOfLookingEverywhere) {
  Random random(2);
  for (int i = 0; i < 50; ++i) {
    std::vector<Eigen::Vector3d> places(5);
    for (auto& p : places) p = random_triangle(random, 1)[0];
    const auto distance = [&](const Eigen::Vector3d& x) {
      double d = 10;
      for (const auto& p : places) d = std::min(d, (x - p).norm());
      return d;
    };
    int looks = 0;
    FarthestSample farthest(
        [&](const Eigen::Vector3d& x, double enough) {
          ++looks;
          const double d = distance(x);
          return FoundDistance{d <= enough ? enough : d};  // the most that is allowed
        },
        0);
    double expected = 0;
    constexpr int kLevels = 4;
    for (int k = 0; k < 10; ++k) {
      const Triangle t = random_triangle(random, 1);
      expected = std::max(expected, look_everywhere(t, kLevels, distance));
      farthest.look_at(farthest.look_at(t[0]), farthest.look_at(t[1]), farthest.look_at(t[2]),
                       kLevels);
    }
    EXPECT_DOUBLE_EQ(farthest.distance(), expected);
    EXPECT_LT(looks, 1000);  // of 4,000
  }
}

TEST(FarthestSample, DividesLargePartsUntilNothingIsMissed) {
  Random random(5);
  constexpr double kResolution = 0.01, kWidth = 0.2;
  for (int i = 0; i < 50; ++i) {
    Triangle t = random_triangle(random, 1);
    for (auto& p : t) p *= 5;
    const double u = random.uniform(0, 1), v = random.uniform(0, 1 - u);
    const Eigen::Vector3d place = t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
    const auto tent = [&](const Eigen::Vector3d& x, double) {
      return FoundDistance{std::max(0.0, kWidth - (x - place).norm())};
    };
    int looks = 0;
    FarthestSample farthest(
        [&](const Eigen::Vector3d& x, double enough) { return ++looks, tent(x, enough); }, 0,
        std::numeric_limits<double>::infinity(), Closeness{kResolution, kWidth / 2});
    farthest.look_at(farthest.look_at(t[0]), farthest.look_at(t[1]), farthest.look_at(t[2]), 2);
    EXPECT_GE(farthest.distance(), kWidth - kResolution);
    EXPECT_LE(farthest.distance(), kWidth);
  }
}

// Random triangles near a ball: with the triangles of its surface as pieces the same is found, and
// parts all of whose corners are near the same one are not looked into.
TEST(FarthestSample, PassesOverWhatOneTriangleCovers) {
  const ReferenceSurface surface = make_reference_surface(make_ball(6));
  Random random(6);
  constexpr double kLimit = 0.1;
  constexpr int kLevels = 4;
  int looks_with = 0, looks_without = 0, beyond = 0;
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d centre = random_triangle(random, 1)[0].normalized();
    Triangle t;
    for (auto& p : t)
      p = (1 + random.uniform(-0.11, 0.11)) *
          (centre + 0.2 * random_triangle(random, 1)[0]).normalized();
    const auto counting = [&](int& looks) {
      return [&looks, to = DistanceTo(surface)](const Eigen::Vector3d& p, double enough) mutable {
        ++looks;
        return to(p, enough);
      };
    };
    const auto is_beyond = [&](auto farthest) {
      farthest.look_at(farthest.look_at(t[0]), farthest.look_at(t[1]), farthest.look_at(t[2]),
                       kLevels);
      return farthest.done();
    };
    const Closeness closeness = closeness_for(kLimit, 1);
    const bool with = is_beyond(FarthestSample(counting(looks_with), kLimit, kLimit, closeness,
                                               CoveredByTriangle{surface}));
    const bool without =
        is_beyond(FarthestSample(counting(looks_without), kLimit, kLimit, closeness));
    EXPECT_EQ(with, without) << i;
    beyond += without;
  }
  EXPECT_GT(beyond, 30);
  EXPECT_LT(beyond, 270);
  EXPECT_LT(3 * looks_with, 2 * looks_without);
}

// Far from the origin a small triangle has no middles, and is divided no further.
TEST(FarthestSample, EndsWhereCoordinatesHaveNoMoreDigits) {
  const Eigen::Vector3d far(1e15, 0, 0);
  int looks = 0;
  FarthestSample farthest(
      [&](const Eigen::Vector3d&, double) {
        ++looks;
        return FoundDistance{1};
      },
      0, std::numeric_limits<double>::infinity(), Closeness{1e-3});
  const Sample a = farthest.look_at(far), b = farthest.look_at(far + Eigen::Vector3d(1, 0, 0)),
               c = farthest.look_at(far + Eigen::Vector3d(0, 1, 0));
  farthest.look_at(a, b, c, 2);
  EXPECT_EQ(farthest.distance(), 1);
  EXPECT_LT(looks, 100);
}

TEST(FarthestSample, EndsBeyondWhatIsEnough) {
  int looks = 0;
  FarthestSample farthest(
      [&](const Eigen::Vector3d& x, double) { return ++looks, FoundDistance{x.norm()}; }, 0, 1);
  const Sample a = farthest.look_at({0, 0, 2});
  EXPECT_TRUE(farthest.done());
  farthest.look_at(a, a, a, 5);
  EXPECT_EQ(looks, 1);
}

TEST(ReferenceSurfaceDistance, IsExactBeyondWhatIsEnough) {
  const ReferenceSurface surface = make_reference_surface(make_ball(6));
  Random random(3);
  const auto n_triangles = static_cast<int>(surface.triangles().size());
  int early = 0;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d p = 1.5 * random_triangle(random, 1)[0];
    const double exact = surface.closest(p).distance;
    int near = i % n_triangles;
    EXPECT_EQ(surface.distance(p, near), exact);
    constexpr double kEnough = 0.6;
    near = i % n_triangles;
    const double d = surface.distance(p, near, kEnough);
    ASSERT_GE(near, 0);
    EXPECT_GE(d, exact);
    EXPECT_TRUE(d == exact || d <= kEnough);
    early += d > exact;
  }
  EXPECT_GT(early, 100);
}

}  // namespace
}  // namespace hexweft
