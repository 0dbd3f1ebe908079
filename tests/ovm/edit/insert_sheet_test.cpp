#include "ovm/edit/insert_sheet.h"

#include <array>

#include <gmock/gmock.h>

#include "ovm/errors.h"
#include "ovm/quality.h"
#include "ovm/topology_check.h"
#include "ovm/topology_summary.h"
#include "tests/mesh_families.h"
#include "tests/ovm/mesh_dump.h"

namespace hexweft {
namespace {

using Eigen::Vector3d;
using testing::IsEmpty;

class EveryMeshFamily : public testing::TestWithParam<MeshFamily> {
 protected:
  const HexMesh mesh_ = GetParam().make();
  // Some cells spread over the mesh.
  std::vector<CellHandle> samples() const {
    std::vector<CellHandle> cells(mesh_.cells().begin(), mesh_.cells().end()), some;
    for (std::size_t i = 0; i < cells.size(); i += 1 + cells.size() / 12) some.push_back(cells[i]);
    return some;
  }
  static std::vector<CellHandle> with_neighbors(const HexMesh& mesh, CellHandle c) {
    std::vector<CellHandle> cells{c};
    for (VertexHandle v : mesh.vertices(c)) {
      for (CellHandle n : mesh.cells(v)) cells.push_back(n);
    }
    return cells;
  }
};
INSTANTIATE_TEST_SUITE_P(, EveryMeshFamily, testing::ValuesIn(mesh_families()), family_name);

TEST_P(EveryMeshFamily, APillowKeepsTheTopologyOrIsRefusedWithoutATrace) {
  const MeshDump before(mesh_);
  int n_inserted = 0;
  for (CellHandle c : samples()) {
    for (bool with_ring : {false, true}) {
      for (bool include_boundary : {false, true}) {
        HexMesh mesh = mesh_;
        const auto inside = with_ring ? with_neighbors(mesh, c) : std::vector{c};
        const auto pillow = insert_sheet(mesh, inside, {.include_boundary = include_boundary});
        if (pillow.refusal != InsertRefusal::none) {
          EXPECT_TRUE(MeshDump(mesh) == before);
          EXPECT_THAT(pillow.layer, IsEmpty());
          continue;
        }
        ++n_inserted;
        EXPECT_THAT(check_topology(mesh), IsEmpty());
        EXPECT_EQ(mesh.n_cells(), mesh_.n_cells() + static_cast<int>(pillow.layer.size()));
        EXPECT_EQ(mesh.n_vertices(), mesh_.n_vertices() + static_cast<int>(pillow.copies.size()));
        const auto was = summarize_topology(mesh_), after = summarize_topology(mesh);
        EXPECT_EQ(after.euler_characteristic, was.euler_characteristic);
        EXPECT_EQ(after.genus, was.genus);
        EXPECT_EQ(after.n_parts, was.n_parts);
        EXPECT_EQ(after.n_boundary_components, was.n_boundary_components);
      }
    }
  }
  EXPECT_GT(n_inserted, 0);
}

TEST_P(EveryMeshFamily, BoundaryLabelsStayOnTheBoundary) {
  for (CellHandle c : samples()) {
    for (bool include_boundary : {false, true}) {
      HexMesh mesh = mesh_;
      FaceProperty<int> patch(mesh, 0);
      CellProperty<int> block(mesh, 0);
      for (FaceHandle f : mesh.faces()) patch[f] = mesh.is_boundary(f);
      for (CellHandle inside : mesh.cells()) block[inside] = 1;
      const auto pillow = insert_sheet(mesh, std::array{c}, {.include_boundary = include_boundary});
      for (FaceHandle f : mesh.faces()) ASSERT_EQ(patch[f], mesh.is_boundary(f));
      int n_new = 0;
      for (CellHandle x : mesh.cells()) n_new += block[x] == 0;
      EXPECT_EQ(n_new, static_cast<int>(pillow.layer.size()));
    }
  }
}

double length_of_marked(const HexMesh& mesh, const EdgeProperty<bool>& marked) {
  double sum = 0;
  for (EdgeHandle e : mesh.edges()) {
    const auto [a, b] = mesh.vertices(e);
    if (marked[e]) sum += (mesh.point(a) - mesh.point(b)).norm();
  }
  return sum;
}

// A box keeps its shape, its twelve sharp edges and valid cells wherever a sheet is inserted.
TEST(InsertSheet, InAGridKeepsSharpEdgesAndInvertsNothing) {
  const HexMesh grid = make_grid({4, 3, 3});
  for (CellHandle first : grid.cells()) {
    for (int axis = -1; axis < 3; ++axis) {
      for (bool include_boundary : {false, true}) {
        HexMesh mesh = grid;
        EdgeProperty<bool> sharp(mesh);
        for (EdgeHandle e : mesh.edges()) sharp[e] = mesh.is_boundary(e) && mesh.valence(e) == 1;
        std::vector<CellHandle> inside{first};
        if (axis >= 0) {
          const CellHandle next = mesh.cell(mesh.opposite(mesh.halfface(first, 2 * axis + 1)));
          if (!next.valid()) continue;
          inside.push_back(next);
        }
        const auto pillow = insert_sheet(mesh, inside, {.include_boundary = include_boundary});
        ASSERT_EQ(pillow.refusal, InsertRefusal::none);
        EXPECT_GT(min_scaled_jacobian(mesh), 0.1);
        EXPECT_NEAR(summarize_quality(mesh).total_volume, 36, 1e-9);
        EXPECT_NEAR(length_of_marked(mesh, sharp), 4 * (4 + 3 + 3), 1e-9);
        for (EdgeHandle e : mesh.edges()) {
          EXPECT_TRUE(!sharp[e] || mesh.is_boundary(e));
        }
      }
    }
  }
}

TEST(InsertSheet, CopiesOfVerticesHaveTheirProperties) {
  HexMesh mesh = make_grid({3, 3, 3});
  VertexProperty<int> number(mesh, -1);
  for (VertexHandle v : mesh.vertices()) number[v] = v.idx;
  const std::array<CellHandle, 1> inside{CellHandle(13)};
  const SheetInsertion made = insert_sheet(mesh, inside);
  ASSERT_EQ(made.copies.size(), 8u);
  for (const auto& copy : made.copies) EXPECT_EQ(number[copy.inner], copy.outer.idx);
}

TEST(InsertSheet, AcrossAGridIsALayerOfBoxes) {
  HexMesh mesh = make_grid({4, 2, 2});
  std::vector<CellHandle> left;
  for (CellHandle c : mesh.cells()) {
    if (c.idx % 4 < 2) left.push_back(c);
  }
  const auto pillow = insert_sheet(mesh, left);
  ASSERT_EQ(pillow.refusal, InsertRefusal::none);
  EXPECT_EQ(pillow.layer.size(), 4u);
  EXPECT_EQ(pillow.copies.size(), 9u);
  EXPECT_NEAR(min_scaled_jacobian(mesh), 1, 1e-12) << "all right angles";
  for (CellHandle c : pillow.layer) {
    for (VertexHandle v : mesh.vertices(mesh.halfface(c, 5))) EXPECT_EQ(mesh.point(v).x(), 2.0);
  }
  for (const auto& copy : pillow.copies) EXPECT_LT(mesh.point(copy.inner).x(), 2.0);
  for (const auto& r : pillow.replaced) {
    EXPECT_FALSE(mesh.is_live(r.before));
    EXPECT_TRUE(mesh.is_live(r.after));
  }
}

TEST(InsertSheet, UnderTheWholeBoundaryAddsACellAFace) {
  HexMesh mesh = make_octree_like(Shape::torus, 12);
  const int n_boundary = static_cast<int>(mesh.boundary_halffaces().size()), n = mesh.n_cells();
  const std::vector<CellHandle> all(mesh.cells().begin(), mesh.cells().end());
  const auto pillow = insert_sheet(mesh, all, {.include_boundary = true});
  ASSERT_EQ(pillow.refusal, InsertRefusal::none);
  EXPECT_EQ(mesh.n_cells(), n + n_boundary);
  EXPECT_EQ(static_cast<int>(mesh.boundary_halffaces().size()), n_boundary);
}

TEST(InsertSheet, RefusesAnInterfaceThatTouchesItself) {
  HexMesh mesh = make_grid({4, 4, 4});
  VertexProperty<int> label(mesh, 1);
  const MeshDump before(mesh);
  const auto cell = [](int x, int y, int z) { return CellHandle(x + 4 * (y + 4 * z)); };
  EXPECT_EQ(insert_sheet(mesh, std::array{cell(1, 1, 1), cell(2, 2, 1)}).refusal,
            InsertRefusal::not_manifold)
      << "along an edge";
  EXPECT_EQ(insert_sheet(mesh, std::array{cell(1, 1, 1), cell(2, 2, 2)}).refusal,
            InsertRefusal::not_manifold)
      << "at a vertex";
  EXPECT_TRUE(MeshDump(mesh) == before);
}

TEST(InsertSheet, RefusesWhereNothingLiesBetween) {
  HexMesh mesh = make_grid({2, 2, 2});
  const MeshDump before(mesh);
  const std::vector<CellHandle> all(mesh.cells().begin(), mesh.cells().end());
  EXPECT_EQ(insert_sheet(mesh, {}).refusal, InsertRefusal::no_interface);
  EXPECT_EQ(insert_sheet(mesh, all).refusal, InsertRefusal::no_interface);
  EXPECT_THROW(insert_sheet(mesh, std::array{CellHandle(8)}), InputError);
  EXPECT_THROW(insert_sheet(mesh, all, {.depth_rel = 1}), InputError);
  EXPECT_TRUE(MeshDump(mesh) == before);
}

}  // namespace
}  // namespace hexweft
