// One planted case for each refusal that needs no geometry.
#include <algorithm>
#include <set>

#include <gmock/gmock.h>

#include "simplify/plan_check.h"
#include "tests/mesh_families.h"
#include "tests/simplify/prediction.h"
#include "tests/simplify/test_meshes.h"

namespace hexweft {
namespace {

// The sheet of the mesh edge between two vertices.
Refusal refusal_of_sheet(const HexMesh& mesh, VertexHandle a, VertexHandle b) {
  const BaseComplex bc = extract_base_complex(mesh);
  const int edge = bc.base_edge_of_edge[mesh.find_edge(a, b).idx];
  for (const Sheet& s : extract_sheets(bc)) {
    if (!std::binary_search(s.edges.begin(), s.edges.end(), edge)) continue;
    return check_plan(mesh, bc.graph, plan_sheet_collapse(mesh, bc, s));
  }
  ADD_FAILURE() << "no sheet";
  return Refusal::none;
}

// Of a grid of unit cells with something missing.
VertexHandle vertex_at(const HexMesh& mesh, double x, double y, double z) {
  for (VertexHandle v : mesh.vertices()) {
    if ((mesh.point(v) - Eigen::Vector3d(x, y, z)).norm() < 1e-9) return v;
  }
  return VertexHandle();
}

Refusal refusal_of_sheet(const HexMesh& mesh, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return refusal_of_sheet(mesh, vertex_at(mesh, a.x(), a.y(), a.z()),
                          vertex_at(mesh, b.x(), b.y(), b.z()));
}

TEST(Refusal, IsOfConnectivityOrOfGeometryOrNeither) {
  int of_shape = 0;
  for (int i = 0; i < kRefusals; ++i) {
    const auto r = static_cast<Refusal>(i);
    EXPECT_FALSE(is_of_connectivity(r) && is_geometric(r)) << name(r);
    EXPECT_TRUE(!is_of_shape(r) || is_geometric(r)) << name(r);
    of_shape += is_of_shape(r);
  }
  EXPECT_EQ(of_shape, 2);
  EXPECT_FALSE(is_of_shape(Refusal::hausdorff));  // more cells may help
}

TEST(Refusal, NothingLeftIsVanishing) {
  EXPECT_EQ(refusal_of_sheet(make_grid({2, 2, 2}), {0, 0, 0}, {1, 0, 0}), Refusal::vanishing);
}

TEST(Refusal, OneOfTwoPartsIsVanishing) {
  EXPECT_EQ(refusal_of_sheet(make_two_boxes(), {0, 0, 0}, {1, 0, 0}), Refusal::vanishing);
}

TEST(Refusal, ThinPlateBetweenTwoBlocksIsVanishing) {
  // The plate is one cell thick; its sheet takes the middle layer of both blocks along.
  const HexMesh mesh =
      make_voxels(VoxelSet({7, 3, 3}, [](int x, int, int z) { return x < 2 || x > 4 || z == 1; }));
  EXPECT_EQ(refusal_of_sheet(mesh, {2, 0, 1}, {2, 0, 2}), Refusal::vanishing);
}

TEST(Refusal, ThinWallOfACavityIsBoundary) {
  EXPECT_EQ(refusal_of_sheet(make_hollow_box(), {0, 0, 0}, {1, 0, 0}), Refusal::boundary);
}

TEST(Refusal, MergingTwoCurvesOfValenceThreeIsValence) {
  // 3 + 3 - 4 = 2 cells round the merged edge.
  const HexMesh mesh = make_o_grid({.n_core = 1});
  const BaseComplex bc = extract_base_complex(mesh);
  int n = 0;
  for (const Sheet& s : extract_sheets(bc)) {
    const bool through_core = s.crossings.size() == 3;
    if (!through_core) continue;
    ++n;
    EXPECT_EQ(check_plan(mesh, bc.graph, plan_sheet_collapse(mesh, bc, s)), Refusal::valence);
  }
  EXPECT_EQ(n, 2);
}

TEST(Refusal, ValenceLimitsAreOptions) {
  // Without the pillow every edge round it has four cells.
  const HexMesh mesh = make_pillowed_grid(3);
  const BaseComplex bc = extract_base_complex(mesh);
  for (const Sheet& s : extract_sheets(bc)) {
    if (s.kind != SheetKind::closed) continue;
    const CollapsePlan plan = plan_sheet_collapse(mesh, bc, s);
    EXPECT_EQ(check_plan(mesh, bc.graph, plan), Refusal::none);
    EXPECT_EQ(check_plan(mesh, bc.graph, plan, {.min_interior = 5}), Refusal::valence);
    // What is no worse than before may exceed the upper limit.
    EXPECT_EQ(check_plan(mesh, bc.graph, plan, {.max_interior = 3}), Refusal::none);
  }
}

// The edges on the diagonal that is not collapsed lose a cell each.
TEST(Refusal, TheLeastValenceHoldsOnBothDiagonalsOfAChord) {
  const ValenceLimits limits = {.min_interior = 4};
  int refused_for_it = 0;
  for (HexMesh mesh : {make_octree_like(Shape::sphere, 6), make_octree_like(Shape::torus, 8),
                       make_pillowed_grid(3)}) {
    const BaseComplex bc = extract_base_complex(mesh);
    const std::vector<Sheet> sheets = extract_sheets(bc);
    for (const Chord& chord : extract_chords(bc)) {
      for (const Diagonal diagonal : {Diagonal::first, Diagonal::second}) {
        const CollapsePlan plan = plan_chord_collapse(mesh, bc, chord, diagonal, sheets);
        const Refusal refusal = check_plan(mesh, bc.graph, plan, limits);
        refused_for_it += refusal == Refusal::valence &&
                          groups_out_of_limits(mesh, bc.graph, plan, limits).empty();
        if (refusal != Refusal::none) continue;
        std::vector<VertexHandle> corners;
        for (CellHandle c : plan.removed) {
          for (VertexHandle v : mesh.vertices(c)) corners.push_back(v);
        }
        const auto before = facts(mesh, corners);
        Transaction look(mesh);
        apply_plan(mesh, plan, default_targets(mesh, bc.graph, plan));
        std::erase_if(corners, [&](VertexHandle v) { return !mesh.is_live(v); });
        for (const auto& [ends, now] : facts(mesh, corners)) {
          const auto [valence, is_boundary] = now;
          const auto old = before.find(ends);
          const bool fell = old != before.end() && valence < old->second.first;
          if (fell && !is_boundary) {
            EXPECT_GE(valence, limits.min_interior);
          }
        }
      }
    }
  }
  EXPECT_GT(refused_for_it, 0);
}

// Of the ring of cells round the core of a cylinder.
Refusal refusal_of_ring(int n_core, const ValenceLimits& limits) {
  const HexMesh mesh = make_o_grid({.n_core = n_core});
  const BaseComplex bc = extract_base_complex(mesh);
  for (const Sheet& s : extract_sheets(bc)) {
    if (s.crossings.size() != 4) continue;
    return check_plan(mesh, bc.graph, plan_sheet_collapse(mesh, bc, s), limits);
  }
  ADD_FAILURE() << "no ring";
  return Refusal::none;
}

TEST(Refusal, LoneCellsInAWideAngleOfTheBoundaryAreAngle) {
  // Without the ring the core's four edges lie on the outline alone, where its sides, 4 n_core of
  // them, turn by 360 / (4 n_core) degrees.
  EXPECT_EQ(refusal_of_ring(4, {}), Refusal::angle);
  EXPECT_EQ(refusal_of_ring(4, {.max_angle_deg = 157}), Refusal::angle);
  EXPECT_EQ(refusal_of_ring(4, {.max_angle_deg = 158}), Refusal::none);
  EXPECT_EQ(refusal_of_ring(4, {.max_angle_deg = 360}), Refusal::none);
  EXPECT_EQ(refusal_of_ring(1, {}), Refusal::none);
}

TEST(Refusal, CellWithTwoVerticesOfAGroupIsDegenerate) {
  // Cell 1 goes, and cell 0 has both vertices that become one as opposite corners.
  const HexMesh mesh = make_folded_ring();
  EXPECT_EQ(refusal_of_sheet(mesh, VertexHandle(0), VertexHandle(1)), Refusal::degenerate_cell);
}

TEST(Refusal, ChordOfUnequalSidesNeedsASimpleSheetToShortenIt) {
  // Its section is 4 cells of a one-sided sheet by 2 of an open one.
  const HexMesh mesh =
      make_torus({.n_core = 4, .n_around = 6, .round_section = false, .n_quarter_turns = 1});
  const BaseComplex bc = extract_base_complex(mesh);
  int n = 0;
  for (const Chord& c : extract_chords(bc)) {
    if (!c.closed) n += can_plan(bc, c, extract_sheets(bc)) == Refusal::unequal_sides;
  }
  EXPECT_EQ(n, 6);
  const BaseComplex grid = extract_base_complex(make_grid({4, 3, 2}));
  for (const Chord& c : extract_chords(grid)) {
    EXPECT_EQ(can_plan(grid, c, extract_sheets(grid)), Refusal::none);
  }
}

TEST(Refusal, ChordWhoseDiagonalsFallTogetherIsTwisted) {
  const BaseComplex bc =
      extract_base_complex(make_torus({.round_section = false, .n_quarter_turns = 1}));
  int n = 0;
  for (const Chord& c : extract_chords(bc)) {
    if (!c.closed) continue;
    ++n;
    EXPECT_EQ(can_plan(bc, c, extract_sheets(bc)), Refusal::twisted);
  }
  EXPECT_EQ(n, 1);
}

TEST(Refusal, ChordThatCrossesItselfIsTwisted) {
  const BaseComplex bc = extract_base_complex(make_crossing_ribbon());
  int n = 0;
  for (const Chord& c : extract_chords(bc)) {
    if (!c.self_crossing) continue;
    ++n;
    EXPECT_EQ(can_plan(bc, c, extract_sheets(bc)), Refusal::twisted);
  }
  EXPECT_EQ(n, 1);
}

TEST(Refusal, EachHasAName) {
  std::set<std::string_view> names;
  for (int i = 0; i < kRefusals; ++i) names.insert(name(static_cast<Refusal>(i)));
  EXPECT_EQ(names.size(), static_cast<std::size_t>(kRefusals));
  EXPECT_EQ(names.count(""), 0u);
}

}  // namespace
}  // namespace hexweft
