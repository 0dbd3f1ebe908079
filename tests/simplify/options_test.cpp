// Bad options and meshes are refused by name, and nothing is changed.
#include <gmock/gmock.h>

#include "ovm/errors.h"
#include "simplify/simplify.h"
#include "tests/ovm/mesh_dump.h"
#include "tests/simplify/test_meshes.h"

namespace hexweft {
namespace {

struct BadOption {
  std::string name;
  std::function<void(SimplifyOptions&)> spoil;
  friend std::ostream& operator<<(std::ostream& out, const BadOption& b) { return out << b.name; }
};

class EveryBadOption : public testing::TestWithParam<BadOption> {};

TEST_P(EveryBadOption, IsAnInputErrorThatNamesIt) {
  SimplifyOptions options;
  GetParam().spoil(options);
  HexMesh mesh = make_pillowed_grid(3);
  const MeshDump before(mesh);
  try {
    simplify(mesh, options);
    FAIL() << "accepted";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr(GetParam().name + " = "));
    EXPECT_THAT(e.what(), testing::HasSubstr("expected"));
  }
  EXPECT_TRUE(MeshDump(mesh) == before);
}

using O = SimplifyOptions;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
INSTANTIATE_TEST_SUITE_P(
    Options, EveryBadOption,
    testing::Values(
        BadOption{"hausdorff_limit_rel", [](O& o) { o.hausdorff_limit_rel = 0; }},
        BadOption{"hausdorff_limit_rel", [](O& o) { o.hausdorff_limit_rel = 2; }},
        BadOption{"hausdorff_limit_rel", [](O& o) { o.hausdorff_limit_rel = kNaN; }},
        BadOption{"min_scaled_jacobian", [](O& o) { o.min_scaled_jacobian = -0.1; }},
        BadOption{"min_scaled_jacobian", [](O& o) { o.min_scaled_jacobian = 1; }},
        BadOption{"mean_scaled_jacobian", [](O& o) { o.mean_scaled_jacobian = 1; }},
        BadOption{"mean_scaled_jacobian", [](O& o) { o.mean_scaled_jacobian = kNaN; }},
        BadOption{"target_hexahedra_rel", [](O& o) { o.target_hexahedra_rel = 0; }},
        BadOption{"target_hexahedra_rel", [](O& o) { o.target_hexahedra_rel = 1001; }},
        BadOption{"beta", [](O& o) { o.weights.beta = -1; }},
        BadOption{"angle_deg",
                  [](O& o) {
                    o.features = {FeatureMode::angle, 200};
                  }},
        BadOption{"rings", [](O& o) { o.rings = 0; }},
        BadOption{"compare", [](O& o) { o.compare = 0; }},
        BadOption{"give_up_factor", [](O& o) { o.give_up_factor = 0.5; }},
        BadOption{"merged_give_up_factor", [](O& o) { o.merged_give_up_factor = 0; }},
        BadOption{"bold.merged_give_up_factor", [](O& o) { o.bold.merged_give_up_factor = kNaN; }},
        BadOption{"max_chord_deviation", [](O& o) { o.max_chord_deviation = -1; }},
        BadOption{"bold.max_chord_deviation", [](O& o) { o.bold.max_chord_deviation = 0; }},
        BadOption{"target_rate", [](O& o) { o.target_rate = 1.5; }},
        BadOption{"target_rate", [](O& o) { o.target_rate = -0.5; }},
        BadOption{"target_components", [](O& o) { o.target_components = 0; }},
        BadOption{"max_seconds", [](O& o) { o.max_seconds = 0; }},
        BadOption{"checkpoint_every_s", [](O& o) { o.checkpoint_every_s = kNaN; }},
        BadOption{"max_iterations", [](O& o) { o.parametrization.max_iterations = 0; }}));

TEST(Options, DefaultsAreValid) { EXPECT_NO_THROW(validate(SimplifyOptions())); }

void expect_refused(HexMesh& mesh, const std::string& message) {
  const MeshDump before(mesh);
  try {
    simplify(mesh);
    FAIL() << "accepted";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr(message));
  }
  EXPECT_TRUE(MeshDump(mesh) == before);
}

TEST(Input, InvertedCellThatCannotBeUntangledIsNamed) {
  HexMesh cube = make_grid({1, 1, 1});
  cube.set_point(VertexHandle(7), {-1, -1, -1});
  expect_refused(cube, "cell 0 ");
  HexMesh inside_out = make_grid({3, 3, 3});
  for (const VertexHandle v : inside_out.vertices()) inside_out.set_point(v, -inside_out.point(v));
  expect_refused(inside_out, "cell 0 ");
}

TEST(Input, CornerFarBeyondTheRestIsNamed) {
  HexMesh mesh = make_grid({2, 2, 2});
  mesh.set_point(VertexHandle(13), {1e200, 1, 1});  // products of lengths overflow
  expect_refused(mesh, "cell 0 ");
}

TEST(Input, TangledSurfaceThatIsTooFarOnceUntangledIsRefused) {
  HexMesh mesh = make_grid({4, 4, 4});
  mesh.set_point(VertexHandle(12 + 100), {2, 2, -6});  // the middle of the top, through the bottom
  expect_refused(mesh, "off its surface");
}

// A mesh dump with NaN in it does not equal itself; the counts have to do.
void expect_coordinate_refused(double x) {
  HexMesh mesh = make_grid({2, 2, 2});
  mesh.set_point(VertexHandle(13), {1, x, 1});
  EXPECT_THROW(simplify(mesh), InputError);
  EXPECT_EQ(mesh.n_cells(), 8);
  EXPECT_EQ(mesh.point(VertexHandle(0)), Eigen::Vector3d(0, 0, 0));
}

TEST(Input, CoordinateThatIsNoNumberIsRefused) { expect_coordinate_refused(kNaN); }

TEST(Input, InfiniteCoordinateIsRefused) {
  expect_coordinate_refused(std::numeric_limits<double>::infinity());
}

TEST(Input, EmptyMeshIsRefused) {
  HexMesh mesh;
  expect_refused(mesh, "no cells");
}

TEST(Input, MeshThatIsNoManifoldIsRefused) {
  // Two cells that share an edge alone.
  HexMesh mesh = make_voxels(VoxelSet({2, 2, 1}, [](int x, int y, int) { return x == y; }));
  expect_refused(mesh, "the mesh is not valid");
}

}  // namespace
}  // namespace hexweft
