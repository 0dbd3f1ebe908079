// Curves and nodes of the singularity graph.
#include "simplify/singularity_graph.h"

#include <algorithm>
#include <map>
#include <tuple>

#include <gmock/gmock.h>

#include "tests/mesh_families.h"
#include "tests/simplify/test_meshes.h"

namespace hexweft {
namespace {

using testing::ElementsAre;
using testing::Pair;

// How many curves there are of each (valence, on the boundary, closed).
using CurveKind = std::tuple<int, bool, bool>;
std::map<CurveKind, int> curve_kinds(const SingularityGraph& g) {
  std::map<CurveKind, int> n;
  for (const SingularCurve& c : g.curves) ++n[{c.valence, c.boundary, c.closed}];
  return n;
}

int n_nodes(const SingularityGraph& g) {
  return static_cast<int>(std::count(g.singular_vertex.begin(), g.singular_vertex.end(), 1));
}

TEST(SingularityGraph, GridHasTheTwelveEdgesOfItsBox) {
  const SingularityGraph g = extract_singularity_graph(make_grid({4, 3, 2}));
  EXPECT_THAT(curve_kinds(g), ElementsAre(Pair(CurveKind{1, true, false}, 12)));
  EXPECT_EQ(n_nodes(g), 8);
  std::multiset<std::size_t> lengths;
  for (const SingularCurve& c : g.curves) lengths.insert(c.edges.size());
  EXPECT_THAT(lengths, ElementsAre(2, 2, 2, 2, 3, 3, 3, 3, 4, 4, 4, 4));
}

TEST(SingularityGraph, LShapeHasOneCurveOfValenceThreeAtItsInnerCorner) {
  const SingularityGraph g = extract_singularity_graph(make_l_shape(3));
  EXPECT_THAT(curve_kinds(g),
              ElementsAre(Pair(CurveKind{1, true, false}, 17), Pair(CurveKind{3, true, false}, 1)));
  EXPECT_EQ(n_nodes(g), 12);
}

TEST(SingularityGraph, OGridHasFourCurvesInsideAndTwoRims) {
  const SingularityGraph g = extract_singularity_graph(make_o_grid());
  EXPECT_THAT(curve_kinds(g),
              ElementsAre(Pair(CurveKind{1, true, true}, 2), Pair(CurveKind{3, false, false}, 4)));
  EXPECT_EQ(n_nodes(g), 8);
}

TEST(SingularityGraph, ToriHaveClosedCurvesOnly) {
  const auto kinds = [](const TorusOptions& o) {
    return curve_kinds(extract_singularity_graph(make_torus(o)));
  };
  EXPECT_THAT(kinds({}), ElementsAre(Pair(CurveKind{3, false, true}, 4)));
  EXPECT_THAT(kinds({.round_section = false}), ElementsAre(Pair(CurveKind{1, true, true}, 4)));
  EXPECT_THAT(kinds({.round_section = false, .n_quarter_turns = 1}),
              ElementsAre(Pair(CurveKind{1, true, true}, 1)));
  EXPECT_THAT(kinds({.round_section = false, .n_quarter_turns = 2}),
              ElementsAre(Pair(CurveKind{1, true, true}, 2)));
  EXPECT_EQ(n_nodes(extract_singularity_graph(make_torus())), 0);
}

TEST(SingularityGraph, PillowHasTwoCubesJoinedByEightEdges) {
  // 12 edges of the cell inside and 8 that join it to the outer cube have three cells, the 12 of
  // the outer cube five; besides there are those of the grid.
  const SingularityGraph g = extract_singularity_graph(make_pillowed_grid(3));
  EXPECT_THAT(curve_kinds(g),
              ElementsAre(Pair(CurveKind{1, true, false}, 12), Pair(CurveKind{3, false, false}, 20),
                          Pair(CurveKind{5, false, false}, 12)));
  EXPECT_EQ(n_nodes(g), 8 + 16);
}

class SingularityGraphOfEveryFamily : public testing::TestWithParam<MeshFamily> {};
INSTANTIATE_TEST_SUITE_P(, SingularityGraphOfEveryFamily, testing::ValuesIn(mesh_families()),
                         family_name);

TEST_P(SingularityGraphOfEveryFamily, CountsCellsAndBoundariesAsTheMeshDoes) {
  const HexMesh mesh = GetParam().make();
  const SingularityGraph g = extract_singularity_graph(mesh);
  for (EdgeHandle e : mesh.edges()) {
    EXPECT_EQ(g.edge_valence[e.idx], mesh.valence(e));
    EXPECT_EQ(g.boundary_edge[e.idx] != 0, mesh.is_boundary(e));
    const bool singular = mesh.valence(e) != (mesh.is_boundary(e) ? 2 : 4);
    EXPECT_EQ(g.singular_edge[e.idx] != 0, singular);
    EXPECT_EQ(g.curve_of_edge[e.idx] >= 0, singular);
  }
  for (VertexHandle v : mesh.vertices()) {
    EXPECT_EQ(g.boundary_vertex[v.idx] != 0, mesh.is_boundary(v));
  }
}

TEST_P(SingularityGraphOfEveryFamily, CurvesAreMaximalChainsOfOneKind) {
  const HexMesh mesh = GetParam().make();
  const SingularityGraph g = extract_singularity_graph(mesh);
  std::vector<int> seen(mesh.edge_slots(), 0);
  for (std::size_t k = 0; k < g.curves.size(); ++k) {
    const SingularCurve& c = g.curves[k];
    const std::size_t n = c.edges.size();
    ASSERT_EQ(c.vertices.size(), c.closed ? n : n + 1);
    for (std::size_t i = 0; i < n; ++i) {
      const VertexHandle a = c.vertices[i], b = c.vertices[(i + 1) % c.vertices.size()];
      EXPECT_EQ(mesh.find_edge(a, b), c.edges[i]);
      EXPECT_EQ(mesh.valence(c.edges[i]), c.valence);
      EXPECT_EQ(mesh.is_boundary(c.edges[i]), c.boundary);
      EXPECT_EQ(g.curve_of_edge[c.edges[i].idx], static_cast<int>(k));
      ++seen[c.edges[i].idx];
    }
    for (std::size_t i = 0; i < c.vertices.size(); ++i) {
      const bool end = !c.closed && (i == 0 || i == n);
      EXPECT_EQ(g.singular_vertex[c.vertices[i].idx] != 0, end);
    }
  }
  for (EdgeHandle e : mesh.edges()) EXPECT_EQ(seen[e.idx], int(g.singular_edge[e.idx]));
}

}  // namespace
}  // namespace hexweft
