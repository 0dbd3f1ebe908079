// Surfaces whose triangles face the wrong way, and what they become.
#include "optimize/orient_surface.h"

#include <cmath>
#include <utility>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace hexweft {
namespace {

using Triangle = std::array<int, 3>;

struct Surface {
  Eigen::Matrix3Xd points{3, 0};
  std::vector<Triangle> triangles;
};

/// The twelve triangles of a box, facing out of it.
Surface box(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper) {
  Surface s;
  s.points.resize(3, 8);
  for (int i = 0; i < 8; ++i) {
    for (int k = 0; k < 3; ++k) s.points(k, i) = i >> k & 1 ? upper[k] : lower[k];
  }
  s.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                 {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return s;
}

/// A cube of this side round a point on the x axis.
Surface cube(double side, double x = 0) {
  const Eigen::Vector3d centre(x, 0, 0), half = Eigen::Vector3d::Constant(side / 2);
  return box(centre - half, centre + half);
}

Surface operator+(const Surface& a, const Surface& b) {
  Surface both = a;
  both.points.conservativeResize(3, a.points.cols() + b.points.cols());
  both.points.rightCols(b.points.cols()) = b.points;
  const int n = static_cast<int>(a.points.cols());
  for (const auto& [i, j, k] : b.triangles) both.triangles.push_back({i + n, j + n, k + n});
  return both;
}

/// Every so many-th triangle is turned.
Surface turned(Surface s, int step = 1) {
  for (std::size_t t = 0; t < s.triangles.size(); t += step)
    std::swap(s.triangles[t][1], s.triangles[t][2]);
  return s;
}

void expect_becomes(Surface s, const Surface& expected, int n_turned) {
  EXPECT_EQ(orient_surface(s.points, s.triangles), n_turned);
  EXPECT_EQ(s.triangles, expected.triangles);
}

TEST(OrientSurface, ABoxFacesOutward) {
  expect_becomes(cube(2), cube(2), 0);
  expect_becomes(turned(cube(2)), cube(2), 12);
}

TEST(OrientSurface, NeighboursAgree) {
  for (int step : {2, 3, 5}) {
    SCOPED_TRACE(step);
    expect_becomes(turned(cube(2), step), cube(2), (12 + step - 1) / step);
    expect_becomes(turned(turned(cube(2), step)), cube(2), 12 - (12 + step - 1) / step);
  }
}

TEST(OrientSurface, EveryPieceOfSeveralFacesOutward) {
  const Surface two = cube(2) + cube(1, 5);
  expect_becomes(two, two, 0);
  expect_becomes(turned(two), two, 24);
  expect_becomes(cube(2) + turned(cube(1, 5)), two, 12);
  expect_becomes(turned(cube(2)) + turned(cube(1, 5), 2), two, 18);
}

TEST(OrientSurface, CavitiesFaceIntoThemselves) {
  const Surface hollow = cube(8) + turned(cube(4));
  expect_becomes(hollow, hollow, 0);
  expect_becomes(turned(hollow), hollow, 24);
  expect_becomes(cube(8) + cube(4), hollow, 12);
  // A solid in the cavity faces outward again.
  const Surface kernel = hollow + cube(2);
  expect_becomes(kernel, kernel, 0);
  expect_becomes(turned(kernel, 2), kernel, 18);
}

TEST(OrientSurface, BoxesThatTouchAreNotWithinEachOther) {
  // Along an edge that both use: four triangles meet there.
  Surface edge = box({0, 0, 0}, {1, 1, 1}) + box({1, 1, 0}, {2, 2, 1});
  for (Triangle& t : edge.triangles) {
    for (int& v : t) v = v == 8 ? 3 : v == 12 ? 7 : v;
  }
  expect_becomes(turned(edge), edge, 24);
  // Side against side, with points of their own.
  const Surface side = box({0, 0, 0}, {1, 1, 1}) + box({1, 0, 0}, {2, 1, 1});
  expect_becomes(turned(side), side, 24);
}

TEST(OrientSurface, OpenPiecesAgreeWithTheMostOfTheirTriangles) {
  Surface open = cube(2);
  open.triangles.resize(10);
  expect_becomes(open, open, 0);
  expect_becomes(turned(open), turned(open), 0);
  expect_becomes(turned(open, 3), open, 4);
  // Neither is an open piece anything's outside.
  expect_becomes(open + cube(1), open + cube(1), 0);
}

TEST(OrientSurface, AMoebiusStripStays) {
  constexpr int n = 9;
  Surface strip;
  strip.points.resize(3, 2 * n);
  for (int i = 0; i < n; ++i) {
    const double a = 2 * std::acos(-1.0) * i / n;
    const Eigen::Vector3d out(std::cos(a), std::sin(a), 0);
    const Eigen::Vector3d across =
        std::cos(a / 2) * Eigen::Vector3d::UnitZ() + std::sin(a / 2) * out;
    strip.points.col(2 * i) = 4 * out - across;
    strip.points.col(2 * i + 1) = 4 * out + across;
    const int p = 2 * i, q = 2 * i + 1, next = (p + 2) % (2 * n);
    const int r = i + 1 < n ? next : 1, s = i + 1 < n ? next + 1 : 0;
    strip.triangles.push_back({p, r, q});
    strip.triangles.push_back({q, r, s});
  }
  expect_becomes(strip, strip, 0);
  expect_becomes(turned(strip, 2), turned(strip, 2), 0);
}

TEST(OrientSurface, FarFromTheOriginToo) {
  const Surface s = box({1e7, 1e7, 1e7}, {1e7 + 0.01, 1e7 + 0.01, 1e7 + 0.01});
  expect_becomes(turned(s), s, 12);
}

}  // namespace
}  // namespace hexweft
