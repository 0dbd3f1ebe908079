// Counts and grids of the base complex.
#include "simplify/base_complex.h"

#include <algorithm>
#include <set>

#include <gmock/gmock.h>

#include "tests/mesh_families.h"
#include "tests/simplify/test_meshes.h"

namespace hexweft {
namespace {

using testing::ElementsAre;

BaseCounts base_counts(const HexMesh& mesh) {
  const BaseComplex bc = extract_base_complex(mesh);
  EXPECT_EQ(bc.irregular, 0);
  return counts(bc);
}

TEST(BaseComplex, GridIsOneComponentWhateverItsSize) {
  for (const std::array<int, 3>& n : {std::array{1, 1, 1}, {4, 3, 2}, {1, 7, 1}, {5, 5, 5}}) {
    EXPECT_THAT(base_counts(make_grid(n)), ElementsAre(8, 12, 6, 1));
  }
  EXPECT_THAT(base_counts(make_two_boxes()), ElementsAre(16, 24, 12, 2));
}

TEST(BaseComplex, GridKeepsItsCounts) {
  const BaseComplex bc = extract_base_complex(make_grid({4, 3, 2}));
  std::array<int, 3> n = bc.components[0].n;
  std::sort(n.begin(), n.end());
  EXPECT_THAT(n, ElementsAre(2, 3, 4));
}

TEST(BaseComplex, OGridHasACoreAndFourSides) {
  EXPECT_THAT(base_counts(make_o_grid()), ElementsAre(16, 32, 22, 5));
  EXPECT_THAT(base_counts(make_o_grid({.n_core = 1, .n_ring = 3, .n_layers = 1})),
              ElementsAre(16, 32, 22, 5));
}

TEST(BaseComplex, LShapeHasThreeComponents) {
  EXPECT_THAT(base_counts(make_l_shape(1)), ElementsAre(16, 28, 16, 3));
  EXPECT_THAT(base_counts(make_l_shape(3)), ElementsAre(16, 28, 16, 3));
}

TEST(BaseComplex, ClosedCurvesGetThreeNodes) {
  // Three stretches, each of 5 components (round) or 1 (square).
  EXPECT_THAT(base_counts(make_torus()), ElementsAre(24, 60, 51, 15));
  EXPECT_THAT(base_counts(make_torus({.n_around = 7, .round_section = false})),
              ElementsAre(12, 24, 15, 3));
  EXPECT_THAT(base_counts(make_torus({.n_core = 1, .n_around = 3, .round_section = false})),
              ElementsAre(12, 24, 15, 3));
}

TEST(BaseComplex, TwistedToriAreCutAsPlainOnes) {
  // By a quarter turn or three there is a single closed curve, with three nodes.
  for (int turns : {1, 3}) {
    EXPECT_THAT(base_counts(make_torus({.round_section = false, .n_quarter_turns = turns})),
                ElementsAre(12, 24, 15, 3));
    EXPECT_THAT(base_counts(make_torus({.n_quarter_turns = turns})), ElementsAre(24, 60, 51, 15));
  }
}

TEST(BaseComplex, ClosedCurvesOfATwistedTorusHaveThreeNodes) {
  const HexMesh mesh = make_torus({.round_section = false, .n_quarter_turns = 2});
  const BaseComplex bc = extract_base_complex(mesh);
  for (const SingularCurve& c : bc.graph.curves) {
    const auto is_node = [&](VertexHandle v) { return bc.graph.singular_vertex[v.idx] != 0; };
    EXPECT_GE(std::count_if(c.vertices.begin(), c.vertices.end(), is_node), 3);
  }
}

TEST(BaseComplex, RibbonsAreCutAtTheirCrossingAndTouchingPlaces) {
  // In the plane these are (V, E, F) = (8, 12, 4), the crossing, two ends and the loop; and
  // (6, 9, 3), two ends and the loop. One layer makes (2V, 2E + V, 2F + E, F) of them.
  EXPECT_THAT(base_counts(make_crossing_ribbon()), ElementsAre(16, 32, 20, 4));
  EXPECT_THAT(base_counts(make_touching_ribbon()), ElementsAre(12, 24, 15, 3));
}

TEST(BaseComplex, PillowCutsTheGridThrough) {
  // Each of the 26 cells round the middle is a component, and six layers of the pillow, and a core.
  EXPECT_EQ(base_counts(make_pillowed_grid(3))[3], 26 + 6 + 1);
  EXPECT_EQ(base_counts(make_pillowed_grid(5))[3], 26 + 6 + 1);
}

class BaseComplexOfEveryFamily : public testing::TestWithParam<MeshFamily> {};
INSTANTIATE_TEST_SUITE_P(, BaseComplexOfEveryFamily, testing::ValuesIn(mesh_families()),
                         family_name);

TEST_P(BaseComplexOfEveryFamily, EveryCellIsInOneGrid) {
  const HexMesh mesh = GetParam().make();
  const BaseComplex bc = extract_base_complex(mesh);
  ASSERT_EQ(bc.irregular, 0);
  std::vector<int> seen(mesh.cell_slots(), 0);
  for (std::size_t i = 0; i < bc.components.size(); ++i) {
    for (CellHandle c : bc.cells(bc.components[i])) {
      ++seen[c.idx];
      EXPECT_EQ(bc.component_of_cell[c.idx], static_cast<int>(i));
    }
  }
  for (CellHandle c : mesh.cells()) EXPECT_EQ(seen[c.idx], 1);
}

TEST_P(BaseComplexOfEveryFamily, GridNeighboursAreMeshNeighbours) {
  const HexMesh mesh = GetParam().make();
  const BaseComplex bc = extract_base_complex(mesh);
  const auto adjacent = [&](CellHandle a, CellHandle b) {
    for (HalfFaceHandle hf : mesh.halffaces(a)) {
      if (mesh.cell(mesh.opposite(hf)) == b) return true;
    }
    return false;
  };
  for (const Component& comp : bc.components) {
    for (int k = 0; k < comp.n[2]; ++k) {
      for (int j = 0; j < comp.n[1]; ++j) {
        for (int i = 0; i < comp.n[0]; ++i) {
          const CellHandle c = bc.cell(comp, i, j, k);
          EXPECT_TRUE(i == 0 || adjacent(c, bc.cell(comp, i - 1, j, k)));
          EXPECT_TRUE(j == 0 || adjacent(c, bc.cell(comp, i, j - 1, k)));
          EXPECT_TRUE(k == 0 || adjacent(c, bc.cell(comp, i, j, k - 1)));
        }
      }
    }
  }
}

TEST_P(BaseComplexOfEveryFamily, GridVerticesAreTheCornersOfTheGridCells) {
  const HexMesh mesh = GetParam().make();
  const BaseComplex bc = extract_base_complex(mesh);
  for (const Component& comp : bc.components) {
    for (int cell = 0; cell < comp.n_cells(); ++cell) {
      const int i = cell % comp.n[0], j = cell / comp.n[0] % comp.n[1],
                k = cell / (comp.n[0] * comp.n[1]);
      std::set<VertexHandle> expected, actual;
      for (const auto& x : kCornerCoords) {
        expected.insert(bc.vertex(comp, i + x[0], j + x[1], k + x[2]));
      }
      for (VertexHandle v : mesh.vertices(bc.cell(comp, i, j, k))) actual.insert(v);
      EXPECT_EQ(actual, expected);
      // Grid neighbours are joined by mesh edges.
      for (const auto& [a, b] : kEdgeCorners) {
        const auto &x = kCornerCoords[a], &y = kCornerCoords[b];
        EXPECT_TRUE(mesh.find_edge(bc.vertex(comp, i + x[0], j + x[1], k + x[2]),
                                   bc.vertex(comp, i + y[0], j + y[1], k + y[2]))
                        .valid());
      }
    }
  }
}

TEST_P(BaseComplexOfEveryFamily, CornersEdgesAndFacesOfComponentsBelongTogether) {
  const HexMesh mesh = GetParam().make();
  const BaseComplex bc = extract_base_complex(mesh);
  std::vector<int> uses(bc.faces.size(), 0);
  for (std::size_t id = 0; id < bc.components.size(); ++id) {
    const Component& comp = bc.components[id];
    for (int i = 0; i < 8; ++i) {
      const auto& x = kCornerCoords[i];
      EXPECT_EQ(bc.vertices[comp.corners[i]],
                bc.vertex(comp, x[0] * comp.n[0], x[1] * comp.n[1], x[2] * comp.n[2]));
    }
    for (int e = 0; e < 12; ++e) {
      const BaseEdge& edge = bc.edges[comp.edges[e]];
      EXPECT_EQ(edge.n, comp.n[edge_axis(e)]);
      const int a = comp.corners[kEdgeCorners[e][0]], b = comp.corners[kEdgeCorners[e][1]];
      EXPECT_TRUE((edge.ends == std::array{a, b}) || (edge.ends == std::array{b, a}));
    }
    for (int s = 0; s < 6; ++s) {
      const BaseFace& face = bc.faces[comp.faces[s]];
      EXPECT_TRUE(face.components[0] == int(id) || face.components[1] == int(id));
      std::multiset<int> actual(face.edges.begin(), face.edges.end()), expected;
      for (int e : kSideEdges[s]) expected.insert(comp.edges[e]);
      EXPECT_EQ(actual, expected);
      ++uses[comp.faces[s]];
    }
  }
  for (std::size_t f = 0; f < uses.size(); ++f) EXPECT_EQ(uses[f], bc.faces[f].boundary() ? 1 : 2);
}

TEST_P(BaseComplexOfEveryFamily, BaseEdgesAreChainsOfOneValence) {
  const HexMesh mesh = GetParam().make();
  const BaseComplex bc = extract_base_complex(mesh);
  int on_base_edges = 0;
  for (std::size_t id = 0; id < bc.edges.size(); ++id) {
    const BaseEdge& e = bc.edges[id];
    const auto chain = bc.chain(e);
    EXPECT_EQ(chain.front(), bc.vertices[e.ends[0]]);
    EXPECT_EQ(chain.back(), bc.vertices[e.ends[1]]);
    for (int i = 0; i < e.n; ++i) {
      const EdgeHandle on = mesh.find_edge(chain[i], chain[i + 1]);
      ASSERT_TRUE(on.valid());
      EXPECT_EQ(bc.base_edge_of_edge[on.idx], static_cast<int>(id));
      EXPECT_EQ(mesh.valence(on), e.valence);
      EXPECT_EQ(mesh.is_boundary(on), e.boundary);
      ++on_base_edges;
    }
  }
  int expected = 0;
  for (int id : bc.base_edge_of_edge) expected += id >= 0;
  EXPECT_EQ(on_base_edges, expected);
}

TEST_P(BaseComplexOfEveryFamily, EverySingularEdgeIsOnABaseEdge) {
  const HexMesh mesh = GetParam().make();
  const BaseComplex bc = extract_base_complex(mesh);
  for (EdgeHandle e : mesh.edges()) {
    EXPECT_TRUE(!bc.graph.singular_edge[e.idx] || bc.base_edge_of_edge[e.idx] >= 0);
  }
}

TEST_P(BaseComplexOfEveryFamily, HasTheEulerNumberOfTheMesh) {
  const HexMesh mesh = GetParam().make();
  const auto [v, e, f, c] = base_counts(mesh);
  EXPECT_EQ(v - e + f - c, euler_characteristic(mesh));
}

}  // namespace
}  // namespace hexweft
