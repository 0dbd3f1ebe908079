#include "ovm/edit/split_sheet.h"

#include <algorithm>
#include <map>
#include <string>

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

class EveryMeshFamily : public testing::TestWithParam<MeshFamily> {
 protected:
  void SetUp() override {
    mesh_ = GetParam().make();
    sheets_ = list_dual_sheets(mesh_);
  }
  HexMesh mesh_;
  std::vector<DualSheet> sheets_;
};
INSTANTIATE_TEST_SUITE_P(, EveryMeshFamily, testing::ValuesIn(mesh_families()), family_name);

double length(const HexMesh& mesh, EdgeHandle e) {
  const auto [a, b] = mesh.vertices(e);
  return (mesh.point(a) - mesh.point(b)).norm();
}

TEST_P(EveryMeshFamily, SplitKeepsTheTopologyAndCountsAsPredicted) {
  for (const DualSheet& sheet : sheets_) {
    HexMesh mesh = mesh_;
    std::map<CellHandle, int> n_crossings;
    for (const CellAxis& x : sheet.crossings) ++n_crossings[x.cell];
    int n_children = 0;
    for (const auto& [c, n] : n_crossings) n_children += 1 << n;
    const SheetSplit split = split_sheet(mesh, sheet);
    EXPECT_EQ(split.removed.size(), n_crossings.size());
    EXPECT_EQ(static_cast<int>(split.cells.size()), n_children);
    ASSERT_EQ(split.parents.size(), split.cells.size());
    std::map<CellHandle, int> n_of_parent;
    for (std::size_t i = 0; i < split.cells.size(); ++i) {
      ++n_of_parent[split.parents[i]];
      const auto corners = mesh_.vertices(split.parents[i]);
      const auto is_corner = [&](VertexHandle v) {
        return std::find(corners.begin(), corners.end(), v) != corners.end();
      };
      const auto own = mesh.vertices(split.cells[i]);
      EXPECT_TRUE(std::any_of(own.begin(), own.end(), is_corner));
    }
    for (const auto& [c, n] : n_crossings) EXPECT_EQ(n_of_parent[c], 1 << n);
    EXPECT_EQ(mesh.n_cells(), mesh_.n_cells() - static_cast<int>(n_crossings.size()) + n_children);
    EXPECT_EQ(mesh.n_vertices(), mesh_.n_vertices() + static_cast<int>(split.vertices.size()));
    EXPECT_THAT(check_topology(mesh), testing::IsEmpty());
    const auto before = summarize_topology(mesh_), after = summarize_topology(mesh);
    EXPECT_EQ(after.euler_characteristic, before.euler_characteristic);
    EXPECT_EQ(after.genus, before.genus);
    EXPECT_EQ(after.n_parts, before.n_parts);
    EXPECT_EQ(after.n_boundary_components, before.n_boundary_components);
  }
}

TEST_P(EveryMeshFamily, NewVerticesLieAmidTheirParentsAndOnTheBoundaryWithThem) {
  for (const DualSheet& sheet : sheets_) {
    HexMesh mesh = mesh_;
    const SheetSplit split = split_sheet(mesh, sheet);
    std::size_t n_on_edges = 0;
    for (const SplitVertex& s : split.vertices) {
      Vector3d sum = Vector3d::Zero();
      for (VertexHandle v : s.parent_vertices()) sum += mesh.point(v);
      EXPECT_TRUE(mesh.point(s.vertex).isApprox(sum / s.n_parents));
      bool on_boundary = false;
      if (s.n_parents == 2) {
        ++n_on_edges;
        on_boundary = mesh_.is_boundary(mesh_.find_edge(s.parents[0], s.parents[1]));
      } else if (s.n_parents == 4) {
        const QuadVertices quad{s.parents[0], s.parents[1], s.parents[2], s.parents[3]};
        on_boundary = mesh_.is_boundary(mesh_.find_halfface(quad));
      }
      EXPECT_EQ(mesh.is_boundary(s.vertex), on_boundary);
    }
    EXPECT_EQ(n_on_edges, sheet.edges.size());
  }
}

TEST_P(EveryMeshFamily, ChildrenTakeOverProperties) {
  EdgeProperty<bool> feature(mesh_);
  FaceProperty<int> patch(mesh_, 0);
  CellProperty<int> block(mesh_, -1);
  Property<HalfEdgeTag, Vector3d> direction(mesh_, Vector3d::Zero());
  HalfFaceProperty<int> outside(mesh_, 0);
  double feature_length = 0;
  for (EdgeHandle e : mesh_.edges()) {
    feature[e] = e.idx % 3 == 0;
    if (feature[e]) feature_length += length(mesh_, e);
    for (HalfEdgeHandle h : {HalfEdgeHandle(2 * e.idx), HalfEdgeHandle(2 * e.idx + 1)}) {
      direction[h] = (mesh_.point(mesh_.to(h)) - mesh_.point(mesh_.from(h))).normalized();
    }
  }
  for (FaceHandle f : mesh_.faces()) patch[f] = mesh_.is_boundary(f) ? 1 : 2;
  for (CellHandle c : mesh_.cells()) block[c] = c.idx;
  for (HalfFaceHandle hf : mesh_.boundary_halffaces()) outside[hf] = 1;
  const DualSheet& sheet = sheets_[sheets_.size() / 2];
  std::map<int, int> n_children;
  for (CellHandle c : mesh_.cells()) n_children[c.idx] = 1;
  for (const CellAxis& x : sheet.crossings) n_children[x.cell.idx] *= 2;

  const SheetSplit split = split_sheet(mesh_, sheet);
  double length_after = 0;
  for (EdgeHandle e : mesh_.edges()) {
    if (feature[e]) length_after += length(mesh_, e);
    for (HalfEdgeHandle h : {HalfEdgeHandle(2 * e.idx), HalfEdgeHandle(2 * e.idx + 1)}) {
      if (direction[h].isZero()) continue;
      const Vector3d now = (mesh_.point(mesh_.to(h)) - mesh_.point(mesh_.from(h))).normalized();
      EXPECT_TRUE(direction[h].isApprox(now, 1e-6));
    }
  }
  EXPECT_NEAR(length_after, feature_length, 1e-9 * feature_length);
  for (FaceHandle f : mesh_.faces()) EXPECT_EQ(patch[f] == 1, mesh_.is_boundary(f));
  for (CellHandle c : mesh_.cells()) {
    --n_children[block[c]];
    for (HalfFaceHandle hf : mesh_.halffaces(c)) EXPECT_EQ(outside[hf] == 1, mesh_.is_boundary(hf));
  }
  for (const auto& [c, n] : n_children) EXPECT_EQ(n, 0) << "of cell " << c;
}

TEST_P(EveryMeshFamily, NewVerticesTakeTheMeanOfRealsAndWhatTheirParentsHaveInCommon) {
  VertexProperty<Vector3d> place(mesh_, Vector3d::Zero());
  VertexProperty<int> side(mesh_, -1);
  VertexProperty<std::string> text(mesh_, "none");
  VertexProperty<Eigen::VectorXd> uneven(mesh_, Eigen::VectorXd::Zero(7));
  for (VertexHandle v : mesh_.vertices()) {
    place[v] = mesh_.point(v);
    side[v] = mesh_.point(v).x() < 0.3 ? 3 : 4;
    text[v] = "some";
    uneven[v] = Eigen::VectorXd::Ones(side[v]);
  }
  const SheetSplit split = split_sheet(mesh_, sheets_[sheets_.size() / 2]);
  for (const SplitVertex& s : split.vertices) {
    EXPECT_NEAR((place[s.vertex] - mesh_.point(s.vertex)).norm(), 0, 1e-12);
    const auto parents = s.parent_vertices();
    const bool together = std::all_of(parents.begin(), parents.end(),
                                      [&](VertexHandle v) { return side[v] == side[parents[0]]; });
    EXPECT_EQ(side[s.vertex], together ? side[parents[0]] : -1);
    EXPECT_EQ(uneven[s.vertex].size(), together ? side[parents[0]] : 7);
    EXPECT_EQ(text[s.vertex], "none");
  }
}

TEST(SplitSheet, OfAGridInsertsALayer) {
  HexMesh mesh = make_grid({3, 2, 2});
  const int before = extract_dual_sheets(mesh).n_sheets;
  split_sheet(mesh, mesh.edges(CellHandle(1))[0]);
  EXPECT_EQ(mesh.n_cells(), 16);
  EXPECT_EQ(mesh.n_vertices(), 5 * 3 * 3);
  EXPECT_EQ(extract_dual_sheets(mesh).n_sheets, before + 1);
  EXPECT_NEAR(summarize_quality(mesh).total_volume, 12, 1e-12);
  EXPECT_NEAR(min_scaled_jacobian(mesh), 1, 1e-12);
}

int most_crossings(const DualSheet& sheet) {
  std::map<CellHandle, int> n;
  int most = 0;
  for (const CellAxis& x : sheet.crossings) most = std::max(most, ++n[x.cell]);
  return most;
}

TEST(SplitSheet, CrossesCellsTwiceSomewhere) {
  int most = 0;
  for (const MeshFamily& family : mesh_families()) {
    for (const DualSheet& sheet : list_dual_sheets(family.make())) {
      most = std::max(most, most_crossings(sheet));
    }
  }
  EXPECT_GE(most, 2) << "no family tests the splitting in four";
}

// A handle on a ring: a column of cells that leaves the side of one cell and arrives at that of
// another, its end turned by some quarter turns. Topology only, the cells are not meant to be good.
HexMesh ring_with_handle(int n_turns) {
  HexMesh mesh =
      make_torus({.n_core = 1, .n_around = 9, .round_section = false, .n_quarter_turns = 1});
  const auto from = mesh.vertices(mesh.halfface(CellHandle(0), 3));
  const auto to = mesh.vertices(mesh.halfface(CellHandle(4), 3));
  QuadVertices bottom = from;
  for (int layer = 1; layer <= 3; ++layer) {
    QuadVertices top;
    for (int i = 0; i < 4; ++i) {
      const VertexHandle end = to[(n_turns + 4 - i) % 4];
      top[i] = layer == 3 ? end
                          : mesh.add_vertex(mesh.point(from[i]) +
                                            layer / 3.0 * (mesh.point(end) - mesh.point(from[i])));
    }
    mesh.add_cell({bottom[0], bottom[1], bottom[2], bottom[3], top[0], top[1], top[2], top[3]});
    bottom = top;
  }
  return mesh;
}

TEST(SplitSheet, SplitsInEightWhereThreeLayersCross) {
  int n_three_times = 0;
  for (int n_turns = 0; n_turns < 4; ++n_turns) {
    const HexMesh before = ring_with_handle(n_turns);
    ASSERT_THAT(check_topology(before), testing::IsEmpty());
    for (const DualSheet& sheet : list_dual_sheets(before)) {
      if (most_crossings(sheet) < 3) continue;
      ++n_three_times;
      HexMesh mesh = before;
      const SheetSplit split = split_sheet(mesh, sheet);
      const auto n_centers = std::ranges::count(split.vertices, 8, &SplitVertex::n_parents);
      EXPECT_GT(n_centers, 0);
      EXPECT_THAT(check_topology(mesh), testing::IsEmpty());
      EXPECT_EQ(euler_characteristic(mesh), euler_characteristic(before));
      EXPECT_EQ(summarize_topology(mesh).genus, 2);
    }
  }
  EXPECT_GT(n_three_times, 0);
}

TEST(SplitSheet, RefusesWhatIsNoSheetOfTheMesh) {
  HexMesh mesh = make_grid({3, 2, 2});
  DualSheet sheet = dual_sheet(mesh, EdgeHandle(0));
  sheet.edges.pop_back();
  const MeshDump before(mesh);
  EXPECT_THROW(split_sheet(mesh, sheet), InputError);
  EXPECT_THROW(split_sheet(mesh, EdgeHandle()), InputError);
  EXPECT_THROW(split_sheet(mesh, EdgeHandle(mesh.edge_slots())), InputError);
  EXPECT_TRUE(MeshDump(mesh) == before);
}

// The sheet of the one cell would part the two that share a face by now.
TEST(SplitSheet, RefusesASheetThatHasGrownSince) {
  HexMesh mesh = make_grid({1, 1, 1});
  const DualSheet sheet = dual_sheet(mesh, mesh.edges(CellHandle(0))[0]);
  const CellVertices v = mesh.vertices(CellHandle(0));
  std::array<VertexHandle, 4> top;
  for (int i = 0; i < 4; ++i) top[i] = mesh.add_vertex({double(i % 2), 2, double(i / 2)});
  mesh.add_cell({v[3], v[2], top[1], top[0], v[7], v[6], top[3], top[2]});
  ASSERT_THAT(check_topology(mesh), testing::IsEmpty());
  const MeshDump before(mesh);
  EXPECT_THROW(split_sheet(mesh, sheet), InputError);
  EXPECT_TRUE(MeshDump(mesh) == before);
}

TEST(SplitSheet, RefusesCrossingsThatAreNotThoseOfTheEdges) {
  HexMesh mesh = make_grid({3, 2, 2});
  const DualSheet sheet = dual_sheet(mesh, EdgeHandle(0));
  const auto expect_refused = [&](const char* what, auto change) {
    DualSheet wrong = sheet;
    change(wrong);
    const MeshDump before(mesh);
    EXPECT_THROW(split_sheet(mesh, wrong), InputError) << what;
    EXPECT_TRUE(MeshDump(mesh) == before) << what;
  };
  expect_refused("one too few", [](DualSheet& s) { s.crossings.pop_back(); });
  expect_refused("one twice", [](DualSheet& s) { s.crossings[1] = s.crossings[0]; });
  expect_refused("out of order", [](DualSheet& s) { std::swap(s.crossings[0], s.crossings[1]); });
  expect_refused("another axis", [](DualSheet& s) { s.crossings[0].axis ^= 1; });
  expect_refused("no axis", [](DualSheet& s) { s.crossings[0].axis = 3; });
  expect_refused("no cell", [](DualSheet& s) { s.crossings[0].cell = CellHandle(); });
  expect_refused("an edge twice", [](DualSheet& s) { s.edges[1] = s.edges[0]; });
}

}  // namespace
}  // namespace hexweft
