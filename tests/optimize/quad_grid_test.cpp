// While quads come and go, the grid finds what looking at each of them finds.
#include "optimize/quad_grid.h"

#include <cmath>
#include <limits>
#include <map>

#include <gtest/gtest.h>

#include "tests/random.h"

namespace hexweft {
namespace {

using Quads = std::map<int, QuadPoints>;  // by id

QuadPoints random_quad(Random& random, double reach) {
  const Eigen::Vector3d middle = random.in_cube(reach);
  QuadPoints quad;
  for (Eigen::Vector3d& p : quad) p = middle + random.in_cube(0.15);
  return quad;
}

QuadGrid::Nearest nearest_of_all(const Quads& quads, const Eigen::Vector3d& p) {
  QuadGrid::Nearest best{std::numeric_limits<double>::infinity(), -1};
  for (const auto& [id, points] : quads) {
    const double d = squared_distance(p, points);
    if (d < best.squared_distance) best = {d, id};
  }
  return best;
}

QuadGrid make_unit_grid() {
  return {Eigen::Vector3d::Constant(-1), Eigen::Vector3d::Constant(1), 0.2};
}

TEST(QuadGrid, FindsTheNearestWhileQuadsComeAndGo) {
  Random random(1);
  QuadGrid grid = make_unit_grid();
  Quads quads;
  for (int step = 0; step < 400; ++step) {
    const int id = 7 * random.below(60);
    EXPECT_EQ(grid.contains(id), quads.count(id) == 1);
    if (grid.contains(id)) {
      EXPECT_EQ(grid.points(id), quads[id]);
      grid.remove(id);
      quads.erase(id);
    } else {
      quads[id] = random_quad(random, 1.3);  // some lie outside the box
      grid.insert(id, quads[id]);
    }
    const Eigen::Vector3d p = random.in_cube(1);
    const auto expected = nearest_of_all(quads, p);
    const int guess = quads.empty() ? -1 : quads.begin()->first;
    for (const auto& found : {grid.nearest(p), grid.nearest(p, guess)}) {
      EXPECT_EQ(found.id, expected.id);
      EXPECT_EQ(found.squared_distance, expected.squared_distance);
    }
  }
}

TEST(QuadGrid, IsContentWithWhatIsNearEnough) {
  Random random(2);
  QuadGrid grid = make_unit_grid();
  Quads quads;
  for (int id = 0; id < 50; ++id) grid.insert(id, quads[id] = random_quad(random, 1));
  constexpr double kEnough = 0.3;
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d p = random.in_cube(1);
    const double least = nearest_of_all(quads, p).squared_distance;
    const auto found = grid.nearest(p, random.below(50), kEnough);
    EXPECT_EQ(found.squared_distance, squared_distance(p, quads[found.id]));
    if (least > kEnough * kEnough) {
      EXPECT_EQ(found.squared_distance, least);
    } else {
      EXPECT_LE(found.squared_distance, kEnough * kEnough);
    }
  }
}

TEST(QuadGrid, OfEquallyNearQuadsTheLowestIsFoundWhateverCameFirst) {
  Random random(3);
  const QuadPoints quad = random_quad(random, 0.5);
  for (const bool low_first : {true, false}) {
    QuadGrid grid = make_unit_grid();
    for (const int id : {9, 4}) grid.insert(low_first ? 13 - id : id, quad);
    EXPECT_EQ(grid.nearest({0, 0, 0}).id, 4);
    grid.remove(4);
    EXPECT_EQ(grid.nearest({0, 0, 0}).id, 9);
    grid.insert(4, quad);
    EXPECT_EQ(grid.nearest({0, 0, 0}).id, 4);
  }
}

TEST(QuadGrid, AnEmptyOneFindsNothing) {
  Random random(4);
  QuadGrid grid = make_unit_grid();
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(grid.nearest({0, 0, 0}).id, -1);
    EXPECT_TRUE(std::isinf(grid.nearest({0, 0, 0}).squared_distance));
    grid.insert(3, random_quad(random, 1));
    EXPECT_EQ(grid.nearest({0, 0, 0}).id, 3);
    grid.remove(3);
  }
}

}  // namespace
}  // namespace hexweft
