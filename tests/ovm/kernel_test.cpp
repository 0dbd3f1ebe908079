// The kernel's incidences against those found by looking at every cell.
#include <limits>
#include <set>

#include <gmock/gmock.h>

#include "ovm/errors.h"
#include "ovm/hex_mesh.h"
#include "ovm/neighborhood.h"
#include "tests/mesh_families.h"
#include "tests/ovm/brute_force.h"

namespace hexweft {
namespace {

template <class Range>
auto as_set(const Range& range) {
  using Element = std::decay_t<decltype(*range.begin())>;
  std::set<Element> result;
  for (const Element& x : range) EXPECT_TRUE(result.insert(x).second) << "listed twice";
  return result;
}

class EveryMeshFamily : public testing::TestWithParam<MeshFamily> {
 protected:
  const HexMesh mesh_ = GetParam().make();
  const BruteForce expected_{mesh_};
};
INSTANTIATE_TEST_SUITE_P(, EveryMeshFamily, testing::ValuesIn(mesh_families()), family_name);

TEST_P(EveryMeshFamily, CountsAreThoseOfItsCells) {
  EXPECT_EQ(mesh_.n_vertices(), static_cast<int>(expected_.cells_of_vertex.size()));
  EXPECT_EQ(mesh_.n_edges(), static_cast<int>(expected_.cells_of_edge.size()));
  EXPECT_EQ(mesh_.n_faces(), static_cast<int>(expected_.cells_of_face.size()));
  EXPECT_EQ(static_cast<int>(as_set(mesh_.vertices()).size()), mesh_.n_vertices());
  EXPECT_EQ(static_cast<int>(as_set(mesh_.edges()).size()), mesh_.n_edges());
  EXPECT_EQ(static_cast<int>(as_set(mesh_.faces()).size()), mesh_.n_faces());
  EXPECT_EQ(static_cast<int>(as_set(mesh_.cells()).size()), mesh_.n_cells());
}

TEST_P(EveryMeshFamily, VertexIncidencesAreComplete) {
  for (VertexHandle v : mesh_.vertices()) {
    EXPECT_EQ(as_set(mesh_.cells(v)), expected_.cells_of_vertex.at(v));
    EXPECT_EQ(as_set(neighbors(mesh_, v)), expected_.neighbors_of_vertex.at(v));
    EXPECT_EQ(mesh_.is_boundary(v), expected_.boundary_vertices.contains(v));
    for (HalfEdgeHandle h : mesh_.halfedges(v)) EXPECT_EQ(mesh_.from(h), v);
    for (FaceHandle f : faces(mesh_, v)) EXPECT_THAT(mesh_.vertices(f), testing::Contains(v));
  }
}

TEST_P(EveryMeshFamily, EdgeIncidencesAreComplete) {
  for (EdgeHandle e : mesh_.edges()) {
    const auto ends = BruteForce::sorted(mesh_.vertices(e));
    EXPECT_EQ(as_set(mesh_.cells(e)), expected_.cells_of_edge.at(ends));
    EXPECT_EQ(mesh_.valence(e), static_cast<int>(expected_.cells_of_edge.at(ends).size()));
    EXPECT_EQ(mesh_.is_boundary(e), expected_.boundary_edges.contains(ends));
    std::set<BruteForce::Quad> quads;
    for (FaceHandle f : mesh_.faces(e)) quads.insert(BruteForce::sorted(mesh_.vertices(f)));
    EXPECT_EQ(quads, expected_.faces_of_edge.at(ends));
  }
}

TEST_P(EveryMeshFamily, OrderedCellsTurnRoundTheEdge) {
  for (EdgeHandle e : mesh_.edges()) {
    const auto ring = mesh_.ordered_cells(e);
    ASSERT_EQ(as_set(ring), as_set(mesh_.cells(e)));
    const std::size_t n_steps = mesh_.is_boundary(e) ? ring.size() - 1 : ring.size();
    for (std::size_t i = 0; i < n_steps; ++i) {
      EXPECT_THAT(neighbors(mesh_, ring[i]), testing::Contains(ring[(i + 1) % ring.size()]));
    }
  }
}

TEST_P(EveryMeshFamily, HalfFacesAreGluedWithOppositeOrientation) {
  for (CellHandle c : mesh_.cells()) {
    for (HalfFaceHandle hf : mesh_.halffaces(c)) {
      EXPECT_EQ(mesh_.cell(hf), c);
      const auto quad = mesh_.vertices(hf);
      const auto& cells = expected_.cells_of_face.at(BruteForce::sorted(quad));
      const HalfFaceHandle other = mesh_.opposite(hf);
      EXPECT_EQ(other.valid(), cells.size() == 2);
      EXPECT_EQ(mesh_.is_boundary(hf), cells.size() == 1);
      if (!other.valid()) continue;
      EXPECT_EQ(mesh_.opposite(other), hf);
      EXPECT_EQ(mesh_.face(other), mesh_.face(hf));
      EXPECT_TRUE(cells.contains(mesh_.cell(other)));
      auto back = mesh_.vertices(other);
      std::reverse(back.begin(), back.end());
      std::rotate(back.begin(), std::find(back.begin(), back.end(), quad[0]), back.end());
      EXPECT_EQ(back, quad);
    }
  }
}

TEST_P(EveryMeshFamily, FacesKnowTheirSides) {
  int n_boundary = 0;
  for (FaceHandle f : mesh_.faces()) {
    EXPECT_EQ(mesh_.face(mesh_.halfface(f)), f);
    const auto [first, second] = mesh_.cells(f);
    const auto& cells = expected_.cells_of_face.at(BruteForce::sorted(mesh_.vertices(f)));
    EXPECT_TRUE(cells.contains(first));
    EXPECT_EQ(second.valid(), cells.size() == 2);
    EXPECT_EQ(mesh_.is_boundary(f), cells.size() == 1);
    n_boundary += mesh_.is_boundary(f);
  }
  EXPECT_EQ(static_cast<int>(mesh_.boundary_halffaces().size()), n_boundary);
}

TEST_P(EveryMeshFamily, EdgesOfSidesAndCellsJoinTheirCorners) {
  for (CellHandle c : mesh_.cells()) {
    const auto& v = mesh_.vertices(c);
    for (int k = 0; k < kHexEdges; ++k) {
      const BruteForce::Pair ends{v[kEdgeCorners[k][0]], v[kEdgeCorners[k][1]]};
      EXPECT_EQ(BruteForce::sorted(mesh_.vertices(mesh_.edges(c)[k])), BruteForce::sorted(ends));
    }
    for (HalfFaceHandle hf : mesh_.halffaces(c)) {
      const auto quad = mesh_.vertices(hf);
      const auto round = halfedges(mesh_, hf);
      for (int i = 0; i < 4; ++i) {
        EXPECT_EQ(mesh_.from(round[i]), quad[i]);
        EXPECT_EQ(mesh_.to(round[i]), quad[(i + 1) % 4]);
        EXPECT_EQ(mesh_.edge(round[i]), mesh_.edges(hf)[i]);
      }
    }
  }
}

TEST_P(EveryMeshFamily, SearchFindsWhatIsThere) {
  for (EdgeHandle e : mesh_.edges()) {
    const auto [a, b] = mesh_.vertices(e);
    EXPECT_EQ(mesh_.find_edge(a, b), e);
    EXPECT_EQ(mesh_.find_edge(b, a), e);
    EXPECT_EQ(mesh_.from(mesh_.find_halfedge(b, a)), b);
    EXPECT_EQ(mesh_.other_end(e, a), b);
  }
  for (FaceHandle f : mesh_.faces()) {
    auto quad = mesh_.vertices(f);
    std::sort(quad.begin(), quad.end());
    do {
      EXPECT_EQ(mesh_.face(mesh_.find_halfface(quad)), f);
    } while (std::next_permutation(quad.begin(), quad.end()));
  }
}

TEST_P(EveryMeshFamily, SearchDoesNotFindWhatIsNotThere) {
  for (CellHandle c : mesh_.cells()) {
    const auto& v = mesh_.vertices(c);
    EXPECT_EQ(mesh_.corner_of(c, v[5]), 5);
    EXPECT_FALSE(mesh_.find_edge(v[0], v[6]).valid()) << "the diagonal of a cell is no edge";
    EXPECT_FALSE(mesh_.find_halfface({v[0], v[1], v[6], v[7]}).valid()) << "it cuts through";
    EXPECT_FALSE(find_halfface_in_cell(mesh_, c, {v[0], v[1], v[6], v[7]}).valid());
    EXPECT_EQ(find_halfface_in_cell(mesh_, c, {v[5], v[4], v[7], v[6]}), mesh_.halfface(c, 5));
  }
}

TEST_P(EveryMeshFamily, BoundaryIsAClosedSurface) {
  for (HalfFaceHandle hf : mesh_.boundary_halffaces()) {
    EXPECT_TRUE(mesh_.is_boundary(mesh_.cell(hf)));
    for (EdgeHandle e : mesh_.edges(hf)) {
      const HalfFaceHandle next = mesh_.adjacent_on_boundary(hf, e);
      ASSERT_TRUE(next.valid() && mesh_.is_boundary(next));
      EXPECT_NE(next, hf);
      EXPECT_EQ(mesh_.adjacent_on_boundary(next, e), hf);
    }
  }
}

TEST_P(EveryMeshFamily, CopyAndCompactionKeepEveryCellInPlace) {
  HexMesh copy = mesh_;
  copy.collect_garbage();
  EXPECT_EQ(copy.vertex_slots(), mesh_.n_vertices());
  EXPECT_EQ(copy.edge_slots(), mesh_.n_edges());
  EXPECT_EQ(copy.face_slots(), mesh_.n_faces());
  ASSERT_EQ(copy.cell_slots(), mesh_.n_cells());
  int i = 0;
  for (CellHandle c : mesh_.cells()) {
    for (int k = 0; k < kCorners; ++k) {
      EXPECT_EQ(copy.point(copy.vertices(CellHandle(i))[k]), mesh_.point(mesh_.vertices(c)[k]));
    }
    ++i;
  }
  EXPECT_EQ(BruteForce(copy).boundary_edges.size(), expected_.boundary_edges.size());
  for (EdgeHandle e : copy.edges()) {
    EXPECT_EQ(static_cast<int>(copy.ordered_cells(e).size()), copy.valence(e));
  }
}

TEST(Numbering, SidesOfTheUnitCubeLookOutwards) {
  const HexMesh mesh = make_grid({1, 1, 1});
  const CellHandle c(0);
  for (int axis = 0; axis < 3; ++axis) {
    for (int end = 0; end < 2; ++end) {
      const auto quad = mesh.vertices(side_at(c, axis, end));
      const Eigen::Vector3d u = mesh.point(quad[1]) - mesh.point(quad[0]);
      const Eigen::Vector3d v = mesh.point(quad[3]) - mesh.point(quad[0]);
      EXPECT_EQ(u.cross(v), Eigen::Vector3d((end == 0 ? -1 : 1) * Eigen::Vector3d::Unit(axis)));
      EXPECT_EQ(opposite_in_cell(side_at(c, axis, end)), side_at(c, axis, 1 - end));
    }
  }
}

TEST(Neighborhood, SheetOfAGridIsALayer) {
  const HexMesh mesh = make_grid({4, 3, 2});
  const CellHandle c(0);
  EXPECT_EQ(cells_on_sheet(mesh, c, 0).size(), 6u);
  EXPECT_EQ(cells_on_sheet(mesh, c, 1).size(), 8u);
  EXPECT_EQ(cells_on_sheet(mesh, c, 2).size(), 12u);
  const auto side = halffaces_on_sheet(mesh, side_at(c, 2, 1));
  EXPECT_EQ(side.size(), 12u);
  for (HalfFaceHandle hf : side) {
    for (VertexHandle v : mesh.vertices(hf)) EXPECT_EQ(mesh.point(v).z(), 1.0);
  }
  EXPECT_FALSE(adjacent_on_sheet(mesh, side_at(c, 2, 1), mesh.edges(c)[2]).valid());
}

TEST(Search, FindsAFaceWhoseDiagonalIsAnEdgeElsewhere) {
  HexMesh mesh = make_grid({1, 1, 1});
  const HalfFaceHandle hf = mesh.halfface(CellHandle(0), 0);
  QuadVertices quad = mesh.vertices(hf);
  CellVertices elsewhere;
  elsewhere[0] = quad[0];
  elsewhere[1] = quad[2];
  for (int i = 2; i < kCorners; ++i) elsewhere[i] = mesh.add_vertex({5.0 + i, 1, 2});
  mesh.add_cell(elsewhere);
  std::sort(quad.begin(), quad.end());
  do {
    EXPECT_EQ(mesh.find_halfface(quad), hf);
  } while (std::next_permutation(quad.begin(), quad.end()));
}

TEST(AddCell, RefusesWhatIsNoHexahedron) {
  HexMesh mesh = make_grid({1, 1, 1});
  CellVertices v = mesh.vertices(CellHandle(0));
  v[7] = v[0];
  EXPECT_THROW(mesh.add_cell(v), InputError);
  v[7] = VertexHandle(8);
  EXPECT_THROW(mesh.add_cell(v), InputError);
  v[7] = VertexHandle();
  EXPECT_THROW(mesh.add_cell(v), InputError);
  EXPECT_EQ(mesh.n_cells(), 1);
  EXPECT_THROW(mesh.delete_vertex(VertexHandle(3)), InputError);
}

TEST(Reserve, RefusesMoreCellsThanThereAreNumbersForTheirEdges) {
  HexMesh mesh;
  EXPECT_THROW(mesh.reserve(0, std::numeric_limits<int>::max() / kHexEdges + 1), InputError);
}

}  // namespace
}  // namespace hexweft
