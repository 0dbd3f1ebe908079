// Closest points against brute force, normals, thin parts, bad input.
#include "optimize/reference_surface.h"

#include <cmath>
#include <thread>

#include <gtest/gtest.h>

#include "optimize/closest_point.h"
#include "tests/optimize/test_meshes.h"

namespace hexweft {
namespace {

double brute_force_distance(const ReferenceSurface& s, const Eigen::Vector3d& p) {
  double best = std::numeric_limits<double>::infinity();
  for (const auto& t : s.triangles()) {
    const auto& x = s.points();
    best =
        std::min(best, (closest_point(p, x.col(t[0]), x.col(t[1]), x.col(t[2])).point - p).norm());
  }
  return best;
}

TEST(ClosestPoint, IsNoFartherThanAnySampleOfTheTriangle) {
  Random random(1);
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d a = random.in_cube(1), b = random.in_cube(1), c = random.in_cube(1);
    const Eigen::Vector3d p = random.in_cube(2);
    const TrianglePoint q = closest_point(p, a, b, c);
    EXPECT_GE(q.weights.minCoeff(), 0);
    EXPECT_NEAR(q.weights.sum(), 1, 1e-12);
    EXPECT_LT((q.weights[0] * a + q.weights[1] * b + q.weights[2] * c - q.point).norm(), 1e-12);
    for (int u = 0; u <= 20; ++u) {
      for (int v = 0; u + v <= 20; ++v) {
        const Eigen::Vector3d s = a + (b - a) * u / 20 + (c - a) * v / 20;
        EXPECT_LE((q.point - p).norm(), (s - p).norm() + 1e-12);
      }
    }
  }
}

TEST(ClosestPoint, WorksOnTrianglesWithoutArea) {
  const Eigen::Vector3d a(0, 0, 0), b(1, 0, 0), p(0.25, 1, 0);
  EXPECT_NEAR((closest_point(p, a, b, b).point - Eigen::Vector3d(0.25, 0, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((closest_point(p, a, a, a).point - a).norm(), 0, 1e-12);
}

TEST(ReferenceSurface, ClosestPointsAreTheBruteForceOnes) {
  const HexMesh mesh = make_octree_like(Shape::blob, 10, 5);
  const ReferenceSurface surface = make_reference_surface(mesh);
  Random random(2);
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d p = random.in_cube(2);
    const SurfacePoint s = surface.closest(p);
    EXPECT_NEAR(s.distance, brute_force_distance(surface, p), 1e-14);
    EXPECT_NEAR((s.point - p).norm(), s.distance, 1e-14);
    EXPECT_NEAR(s.normal.norm(), 1, 1e-12);
  }
}

TEST(ReferenceSurface, KeepsDoublePrecisionFarFromTheOrigin) {
  HexMesh mesh = make_ball(6);
  const Eigen::Vector3d far(1e6, -2e6, 3e6);
  for (VertexHandle v : mesh.vertices()) mesh.set_point(v, mesh.point(v) + far);
  const ReferenceSurface surface = make_reference_surface(mesh);
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d p = far + random.in_cube(1.5);
    EXPECT_NEAR(surface.closest(p).distance, brute_force_distance(surface, p), 1e-9);
  }
  for (const auto& t : surface.triangles()) {
    EXPECT_EQ(surface.closest(surface.points().col(t[0])).distance, 0);
  }
}

TEST(ReferenceSurface, HintKeepsToTheSideThatFacesTheSameWay) {
  const HexMesh plate = make_grid(
      {10, 10, 1}, Eigen::AlignedBox3d(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 1, 0.01)));
  const ReferenceSurface surface = make_reference_surface(plate);
  const Eigen::Vector3d p(0.52, 0.47, 0.009), down = -Eigen::Vector3d::UnitZ();
  EXPECT_NEAR(surface.closest(p).point[2], 0.01, 1e-15);
  EXPECT_NEAR(surface.closest(p, down).point[2], 0, 1e-15);
  EXPECT_NEAR(surface.closest(p, down).normal[2], -1, 1e-12);
}

TEST(ReferenceSurface, NormalsAreSmoothOnABallAndSharpOnACube) {
  const ReferenceSurface ball = make_reference_surface(make_ball(12));
  Random random(4);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d p = random.in_cube(1).normalized();
    EXPECT_GT(ball.closest(p).normal.dot(p), 0.99);
  }
  const ReferenceSurface cube = make_reference_surface(make_grid({3, 3, 3}));
  for (int i = 0; i < 100; ++i) {
    const SurfacePoint s = cube.closest(Eigen::Vector3d(1.5, 1.5, 1.5) + random.in_cube(1.5));
    EXPECT_NEAR(s.normal.cwiseAbs().maxCoeff(), 1, 1e-12);
  }
}

TEST(ReferenceSurface, ReachLimitsTheSearch) {
  const ReferenceSurface cube = make_reference_surface(make_grid({2, 2, 2}));
  EXPECT_EQ(cube.closest_within({1, 1, 5}, 2.9).triangle, -1);
  EXPECT_NEAR(cube.closest_within({1, 1, 5}, 3.1).distance, 3, 1e-14);
}

TEST(ReferenceSurface, QueriesMayRunAtTheSameTime) {
  const ReferenceSurface surface = make_reference_surface(make_ball(8));
  std::vector<Eigen::Vector3d> queries;
  Random random(5);
  for (int i = 0; i < 2000; ++i) queries.push_back(random.in_cube(2));
  const auto run = [&] {
    std::vector<int> triangles;
    for (const auto& q : queries) triangles.push_back(surface.closest(q).triangle);
    return triangles;
  };
  const auto expected = run();
  std::vector<int> got[2];
  std::thread other([&] { got[0] = run(); });
  got[1] = run();
  other.join();
  EXPECT_EQ(got[0], expected);
  EXPECT_EQ(got[1], expected);
}

TEST(ReferenceSurface, TakesTrianglesThatFormNoManifold) {
  Eigen::Matrix3Xd p(3, 5);
  p << 0, 1, 0, 0, 0,  //
      0, 0, 1, -1, 0,  //
      0, 0, 0, 0, 1;
  testing::internal::CaptureStderr();
  const ReferenceSurface s(p, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {2, 2, 1}});
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_NEAR(s.closest({0.1, 0, 2}).distance, std::sqrt(1.01), 1e-12);
}

TEST(ReferenceSurface, RefusesWhatIsNoSurface) {
  EXPECT_THROW(make_reference_surface(HexMesh()), InputError);
  EXPECT_THROW(ReferenceSurface(Eigen::Matrix3Xd::Zero(3, 3), {{0, 1, 3}}), InputError);
  Eigen::Matrix3Xd p = Eigen::Matrix3Xd::Zero(3, 3);
  p(0, 0) = std::nan("");
  EXPECT_THROW(ReferenceSurface(p, {{0, 1, 2}}), InputError);
}

TEST(ReferenceSurface, IsAsExactInAnyUnitOfLength) {
  const HexMesh mesh = make_octree_like(Shape::blob, 6, 1);
  const ReferenceSurface one = make_reference_surface(mesh);
  for (const double unit : {1e-40, 1e-20, 1e20, 1e40}) {
    HexMesh scaled = mesh;
    for (VertexHandle v : mesh.vertices()) scaled.set_point(v, unit * mesh.point(v));
    const ReferenceSurface surface = make_reference_surface(scaled);
    Random random(4);
    for (int i = 0; i < 100; ++i) {
      const Eigen::Vector3d p = random.in_cube(2);
      const SurfacePoint a = one.closest(p), b = surface.closest(unit * p);
      EXPECT_NEAR(b.distance / unit, a.distance, 1e-12) << unit;
    }
  }
}

TEST(ReferenceSurface, RefusesSizesOfWhichPowersVanishOrOverflow) {
  for (const double unit : {0.0, 1e-50, 1e-200, 1e50, 1e200}) {
    HexMesh mesh = make_grid({1, 1, 1});
    for (VertexHandle v : mesh.vertices()) mesh.set_point(v, unit * mesh.point(v));
    EXPECT_THROW(make_reference_surface(mesh), InputError) << unit;
  }
}

}  // namespace
}  // namespace hexweft
