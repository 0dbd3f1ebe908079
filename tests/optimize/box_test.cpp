// Boxes as a bound of distances.
#include "optimize/box.h"

#include <array>

#include <gtest/gtest.h>

#include "optimize/closest_point.h"
#include "tests/random.h"

namespace hexweft {
namespace {

TEST(Box, IsNeverFartherThanTheTriangleInIt) {
  Random random(3);
  int inside = 0;
  for (int i = 0; i < 1000; ++i) {
    const std::array<Eigen::Vector3d, 3> t = {random.in_cube(1), random.in_cube(1),
                                              random.in_cube(1)};
    const Eigen::Vector3d p = random.in_cube(2);
    const double to_triangle = (closest_point(p, t[0], t[1], t[2]).point - p).squaredNorm();
    const double to_box = box_of(t).squared_distance(p);
    EXPECT_LE(to_box, to_triangle * (1 + 1e-12) + 1e-24);
    inside += to_box == 0;
  }
  EXPECT_GT(inside, 0);
}

TEST(Box, MeasuresToItsNearestPoint) {
  const std::array<Eigen::Vector3d, 2> corners = {Eigen::Vector3d(1, 2, 3),
                                                  Eigen::Vector3d(0, 0, 0)};
  const Box3 box = box_of(corners);
  EXPECT_EQ(box.squared_distance({0.5, 1, 1}), 0);
  EXPECT_EQ(box.squared_distance({-2, 1, 1}), 4);
  EXPECT_EQ(box.squared_distance({2, 3, 5}), 1 + 1 + 4);
}

}  // namespace
}  // namespace hexweft
