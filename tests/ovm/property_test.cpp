#include "ovm/property.h"

#include <memory>
#include <optional>
#include <utility>

#include <gmock/gmock.h>

#include "ovm/generators.h"
#include "ovm/transaction.h"

namespace hexweft {
namespace {

TEST(Property, StartsWithItsDefaultAndGrowsWithTheMesh) {
  HexMesh mesh = make_grid({2, 1, 1});
  VertexProperty<int> label(mesh, 4);
  EXPECT_EQ(label.size(), mesh.vertex_slots());
  EXPECT_EQ(label[VertexHandle(3)], 4);
  const VertexHandle v = mesh.add_vertex(Eigen::Vector3d::Zero());
  EXPECT_EQ(label[v], 4);
}

TEST(Property, OfBoolHasAddressableElements) {
  const HexMesh mesh = make_grid({2, 1, 1});
  EdgeProperty<bool> feature(mesh);
  bool& flag = feature[EdgeHandle(2)];
  flag = true;
  EXPECT_TRUE(feature[EdgeHandle(2)]);
  EXPECT_FALSE(feature[EdgeHandle(1)]);
}

TEST(Property, CopiesOfTheObjectShareTheValues) {
  const HexMesh mesh = make_grid({1, 1, 1});
  std::optional<CellProperty<int>> first(std::in_place, mesh, 0);
  CellProperty<int> second = *first;
  (*first)[CellHandle(0)] = 9;
  first.reset();
  EXPECT_EQ(second[CellHandle(0)], 9);
  second = CellProperty<int>(mesh, 2);
  EXPECT_EQ(second[CellHandle(0)], 2);
}

TEST(Property, OutlivesItsMesh) {
  auto mesh = std::make_unique<HexMesh>(make_grid({1, 1, 1}));
  CellProperty<double> value(*mesh, 0.5);
  mesh.reset();
  EXPECT_EQ(value[CellHandle(0)], 0.5);
}

TEST(NamedProperty, StaysWithTheMeshAndItsCopies) {
  HexMesh mesh = make_grid({2, 1, 1});
  named_property<FaceTag, int>(mesh, "patch", -1)[FaceHandle(3)] = 7;
  FaceProperty<int> mine(mesh, 1);
  HexMesh copy = mesh;
  EXPECT_EQ((named_property<FaceTag, int>(copy, "patch")[FaceHandle(3)]), 7);
  named_property<FaceTag, int>(copy, "patch")[FaceHandle(3)] = 8;
  EXPECT_EQ((named_property<FaceTag, int>(mesh, "patch")[FaceHandle(3)]), 7) << "not shared";
  EXPECT_EQ(property_registry<FaceTag>(copy)->named().size(), 1u) << "private ones stay behind";
  HexMesh moved = std::move(copy);
  EXPECT_EQ((named_property<FaceTag, int>(moved, "patch")[FaceHandle(3)]), 8);
}

TEST(NamedProperty, IsFetchedAgainAfterItsMeshWasAssigned) {
  HexMesh mesh = make_grid({1, 1, 1});
  auto weight = named_property<CellTag, double>(mesh, "weight", 0.5);
  HexMesh other = make_grid({2, 1, 1});
  named_property<CellTag, double>(other, "weight", 0.25);
  mesh = std::move(other);
  EXPECT_EQ(weight.size(), 1) << "values of the mesh that was";
  weight = named_property<CellTag, double>(mesh, "weight");
  EXPECT_EQ(weight.size(), 2);
  EXPECT_EQ(weight[CellHandle(1)], 0.25);
  other = make_grid({3, 1, 1});
  EXPECT_EQ(other.n_cells(), 3) << "assigned after it was moved from";
}

TEST(NamedProperty, RefusesAnotherType) {
  const HexMesh mesh = make_grid({1, 1, 1});
  named_property<CellTag, int>(mesh, "material");
  EXPECT_THROW((named_property<CellTag, double>(mesh, "material")), InputError);
  EXPECT_NO_THROW((named_property<VertexTag, double>(mesh, "material"))) << "names are by entity";
  EXPECT_TRUE(property_registry<CellTag>(mesh)->erase("material"));
  EXPECT_NO_THROW((named_property<CellTag, double>(mesh, "material")));
}

TEST(NamedProperty, CannotBeErasedInsideATransaction) {
  HexMesh mesh = make_grid({1, 1, 1});
  auto material = named_property<CellTag, int>(mesh, "material", 4);
  {
    Transaction t(mesh);
    material[CellHandle(0)] = 5;
    EXPECT_THROW(property_registry<CellTag>(mesh)->erase("material"), InputError);
  }
  EXPECT_EQ((named_property<CellTag, int>(mesh, "material")[CellHandle(0)]), 4);
}

// A value that knows how often it was copied.
struct Counted {
  Counted() = default;
  Counted(const Counted&) { ++n_copies; }
  Counted& operator=(const Counted&) = default;
  static inline int n_copies = 0;
};

TEST(Property, IsNotLoggedWhereItIsReadAsConstant) {
  HexMesh mesh = make_grid({1, 1, 1});
  CellProperty<Counted> value(mesh);
  Transaction t(mesh);
  Counted::n_copies = 0;
  value.get(CellHandle(0));
  std::as_const(value)[CellHandle(0)];
  EXPECT_EQ(Counted::n_copies, 0);
  value[CellHandle(0)];
  EXPECT_EQ(Counted::n_copies, 1);
}

TEST(Property, BornInsideATransactionShrinksWithIt) {
  HexMesh mesh = make_grid({1, 1, 1});
  const int n = mesh.vertex_slots();
  Transaction t(mesh);
  mesh.add_vertex(Eigen::Vector3d::Zero());
  VertexProperty<int> late(mesh, 3);
  EXPECT_EQ(late.size(), n + 1);
  t.rollback();
  EXPECT_EQ(late.size(), n);
}

TEST(Property, BornAndGoneInsideATransactionLeavesNothing) {
  HexMesh mesh = make_grid({1, 1, 1});
  VertexProperty<int> kept(mesh, 1);
  Transaction t(mesh);
  {
    VertexProperty<int> brief(mesh, 3);
    brief[VertexHandle(0)] = 5;
  }
  kept[VertexHandle(0)] = 2;
  t.rollback();
  EXPECT_EQ(kept[VertexHandle(0)], 1);
}

}  // namespace
}  // namespace hexweft
