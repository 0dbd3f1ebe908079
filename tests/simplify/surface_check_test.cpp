#include "simplify/surface_check.h"

#include <gmock/gmock.h>

#include "ovm/neighborhood.h"
#include "tests/ovm/mesh_dump.h"
#include "tests/simplify/test_meshes.h"
#include "tests/simplify/trial_bench.h"

namespace hexweft {
namespace {

// A ball of which one boundary vertex can be pushed out.
struct PushedBall : TrialBench {
  PushedBall() : TrialBench(make_octree_like(Shape::sphere, 8)) {
    pushed = mesh.vertices(mesh.boundary_halffaces()[0])[0];
    touched = cells_around(mesh, {&pushed, 1}, 1);
  }
  void push(double share_of_limit) {
    const Eigen::Vector3d p = mesh.point(pushed);
    const double by = share_of_limit * context.distance_limit;
    mesh.set_point(pushed, p + by * (p - middle()).normalized());
  }
  void keep() {
    ASSERT_TRUE(stays_on_surface(context, touched));
    distance.commit();
  }
  Eigen::Vector3d middle() const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (VertexHandle v : mesh.vertices()) sum += mesh.point(v);
    return sum / mesh.n_vertices();
  }
  double measured_anew() const { return SurfaceDistance(mesh, reference).distance(); }
  VertexHandle pushed;
  std::vector<CellHandle> touched;
};

TEST(StaysOnSurface, WithinTheLimitTheDistanceFollowsTheMesh) {
  PushedBall ball;
  ball.push(0.6);
  EXPECT_TRUE(stays_on_surface(ball.context, ball.touched));
  EXPECT_NEAR(ball.distance.distance(), 0.6 * ball.context.distance_limit,
              0.1 * ball.context.distance_limit);
  EXPECT_DOUBLE_EQ(ball.distance.distance(), ball.measured_anew());
}

TEST(StaysOnSurface, BeyondTheLimitTheDistanceIsAsItWas) {
  PushedBall ball;
  const std::vector<double> before = ball.distance.distance_by_halfface();
  ball.push(1.5);
  EXPECT_FALSE(stays_on_surface(ball.context, ball.touched));
  EXPECT_EQ(ball.distance.distance_by_halfface(), before);
}

TEST(FarthestSide, IsAtTheVertexThatStandsOut) {
  PushedBall ball;
  ball.push(0.8);
  ball.keep();
  const auto [side, d] = farthest_side(ball.distance);
  EXPECT_THAT(ball.mesh.vertices(side), testing::Contains(ball.pushed));
  EXPECT_DOUBLE_EQ(d, ball.distance.distance());
}

TEST(RelieveFarthest, BringsWhatIsCloseToTheLimitNearer) {
  PushedBall ball;
  ball.push(0.9);
  ball.keep();
  const double before = ball.distance.distance();
  EXPECT_TRUE(relieve_farthest(ball.context, {}));
  EXPECT_LT(ball.distance.distance(), 0.7 * before);
  EXPECT_DOUBLE_EQ(ball.distance.distance(), ball.measured_anew());
  EXPECT_TRUE(is_good(ball.mesh));
}

TEST(RelieveFarthest, LeavesAloneWhatIsFarFromTheLimit) {
  PushedBall ball;
  ball.push(0.6);
  ball.keep();
  const MeshDump before(ball.mesh);
  EXPECT_FALSE(relieve_farthest(ball.context, {}));
  EXPECT_TRUE(MeshDump(ball.mesh) == before);
}

// What the relaxation cannot bring nearer, as no vertex may move, stays as it is, and so does the
// distance.
TEST(RelieveFarthest, IsUndoneWhereItDoesNotHelp) {
  PushedBall ball;
  ball.push(0.9);
  ball.keep();
  const MeshDump mesh(ball.mesh);
  const std::vector<double> distance = ball.distance.distance_by_halfface();
  SimplifyOptions no_room;
  no_room.rings = 0;
  EXPECT_FALSE(relieve_farthest(ball.context, no_room));
  EXPECT_TRUE(MeshDump(ball.mesh) == mesh);
  EXPECT_EQ(ball.distance.distance_by_halfface(), distance);
}

}  // namespace
}  // namespace hexweft
