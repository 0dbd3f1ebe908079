// Ranking terms where they can be computed by hand.
#include <cmath>
#include <numbers>
#include <numeric>

#include <gmock/gmock.h>

#include "ovm/errors.h"
#include "simplify/candidates.h"
#include "tests/simplify/test_meshes.h"

namespace hexweft {
namespace {

constexpr double kE = std::numbers::e, kPi = std::numbers::pi;

struct Ranked {
  explicit Ranked(const HexMesh& mesh, const RankingWeights& weights = {})
      : bc(extract_base_complex(mesh)),
        sheets(extract_sheets(bc)),
        terms(rank_sheets(mesh, bc, sheets, weights)) {}
  BaseComplex bc;
  std::vector<Sheet> sheets;
  std::vector<SheetTerms> terms;
};

TEST(RankSheets, UnitCubeHasTermsKnownByHand) {
  const Ranked r(make_grid({1, 1, 1}));
  ASSERT_EQ(r.terms.size(), 3u);
  for (const SheetTerms& t : r.terms) {
    EXPECT_NEAR(t.width, 1, 1e-12);
    EXPECT_NEAR(t.distortion, 1, 1e-12);
    // Four edges of one cell go. Four pairs lose their last cell: from an error of 1 to one of 2,
    // which counts half. So the gain is 4 - 4 / 2, of DM = 4.
    EXPECT_NEAR(t.valence, (4 - 1.67 * 2) / 4, 1e-12);
  }
}

TEST(RankSheets, WidthIsTheCubeRootOfTheLayersOfAUnitGrid) {
  const Ranked r(make_grid({4, 3, 2}));
  for (std::size_t i = 0; i < r.terms.size(); ++i) {
    EXPECT_NEAR(r.terms[i].width, std::cbrt(r.sheets[i].width), 1e-12);
  }
}

TEST(RankSheets, WidthMixesTheNarrowestPlaceWithTheMean) {
  // One end of a row of unit cells is twice as high.
  HexMesh mesh = make_grid({1, 1, 1});
  for (int v : {4, 6})
    mesh.set_point(VertexHandle(v), mesh.point(VertexHandle(v)) + Eigen::Vector3d(0, 0, 1));
  const Ranked r(mesh);
  const double mean_edge = (4 + 2 * std::sqrt(2.0) + 2 + 2 * 1 + 2 * 2) / 12;
  int n = 0;
  for (std::size_t i = 0; i < r.terms.size(); ++i) {
    const BaseEdge& e = r.bc.edges[r.sheets[i].edges[0]];
    const Eigen::Vector3d along =
        mesh.point(r.bc.vertices[e.ends[1]]) - mesh.point(r.bc.vertices[e.ends[0]]);
    if (along.normalized().cwiseAbs().z() < 0.9) continue;
    ++n;
    EXPECT_NEAR(r.terms[i].width, std::cbrt((0.7 * 1 + 0.3 * 1.5) / mean_edge), 1e-12);
  }
  EXPECT_EQ(n, 1);
}

TEST(RankSheets, ThicknessIsTheMixOfLengthsInMeanEdges) {
  const Ranked r(make_grid({4, 3, 2}));
  for (std::size_t i = 0; i < r.terms.size(); ++i) {
    EXPECT_NEAR(r.terms[i].thickness, r.sheets[i].width, 1e-12);
    EXPECT_EQ(r.terms[i].cost(Ranking::thickness), r.terms[i].thickness);
    EXPECT_EQ(r.terms[i].cost(Ranking::weighted), r.terms[i].energy);
  }
  const Ranked least(make_grid({4, 3, 2}), {.min_width = 2, .mean_width = 0});
  EXPECT_NEAR(least.terms[0].thickness, 2 * r.terms[0].thickness, 1e-12);
}

TEST(RankSheets, ValenceTermOfAPillow) {
  const Ranked r(make_pillowed_grid(3));
  std::size_t most = 0;
  for (const Sheet& s : r.sheets) most = std::max(most, s.edges.size());
  EXPECT_EQ(most, 20u);  // through the middle: 16 of the grid and 4 of the core
  int n = 0;
  for (std::size_t i = 0; i < r.terms.size(); ++i) {
    if (r.sheets[i].kind != SheetKind::closed) continue;
    ++n;
    // 12 pairs of 5 and 3 cells become regular, and 8 edges of three cells go.
    EXPECT_NEAR(r.terms[i].valence, (20 - 1.67 * (12 + 8)) / 20, 1e-12);
  }
  EXPECT_EQ(n, 1);
}

TEST(RankSheets, EnergyIsTheWeightedSum) {
  for (const RankingWeights& w : {octree_weights(), polycube_weights()}) {
    for (const SheetTerms& t : Ranked(make_o_grid(), w).terms) {
      EXPECT_NEAR(t.energy,
                  w.k_valence * (1 - std::exp(-t.valence)) + w.k_width * (1 - std::exp(-t.width)) +
                      w.k_distortion * (1 - std::exp(-t.distortion)),
                  1e-12);
    }
  }
  EXPECT_EQ(octree_weights().k_valence, 0.4);
  EXPECT_EQ(octree_weights().k_width, 0.6);
  EXPECT_EQ(polycube_weights().k_valence, 0.3);
  EXPECT_EQ(polycube_weights().k_width, 0.7);
  EXPECT_EQ(polycube_weights().k_distortion, 0.2);
}

TEST(RankSheets, ThinnerGoesFirst) {
  const HexMesh mesh = make_grid({4, 3, 2});
  const BaseComplex bc = extract_base_complex(mesh);
  const CandidateQueues q = make_queues(mesh, bc, {});
  std::vector<int> widths;
  for (const Candidate& c : q.sheet_queue) widths.push_back(q.sheets[c.index].width);
  EXPECT_THAT(widths, testing::ElementsAre(2, 3, 4));
}

TEST(RankSheets, TiesGoByIndex) {
  const HexMesh mesh = make_grid({2, 2, 2});
  const CandidateQueues q = make_queues(mesh, extract_base_complex(mesh), {});
  std::vector<int> order;
  for (const Candidate& c : q.sheet_queue) {
    order.push_back(c.index);
    EXPECT_EQ(c.energy, q.sheet_queue[0].energy);
  }
  EXPECT_THAT(order, testing::ElementsAre(0, 1, 2));
}

// Three cubes in a row, the first drawn out to ten times its length.
HexMesh make_row_with_a_long_cell() {
  HexMesh mesh = make_grid({3, 1, 1});
  for (VertexHandle v : mesh.vertices()) {
    if (mesh.point(v).x() == 0) mesh.set_point(v, mesh.point(v) - Eigen::Vector3d(9, 0, 0));
  }
  return mesh;
}
// 24 / (8 * |A|^2 / det^(2/3)) with |A|^2 = 102, det = 10.
const double kLongShape = 3 * std::cbrt(100.0) / 102;

TEST(ShapeDifferences, SeesADistortedNeighbour) {
  const auto d = shape_differences(make_row_with_a_long_cell());
  EXPECT_THAT(d, testing::ElementsAre(0, testing::DoubleNear(1 - kLongShape, 1e-12), 0));
  EXPECT_THAT(shape_differences(make_grid({3, 3, 3})),
              testing::Each(testing::DoubleNear(0, 1e-12)));
}

TEST(ShapeDifferences, LowerTheEnergyAboveTheThreshold) {
  const HexMesh mesh = make_row_with_a_long_cell();
  ASSERT_GT(1 - kLongShape, 0.55);
  for (const SheetTerms& t : Ranked(mesh).terms) {
    EXPECT_NEAR(t.distortion, 1 / std::log(1 - kLongShape + kE), 1e-12);
  }
  RankingWeights blind;
  blind.distortion_threshold = 0.9;
  for (const SheetTerms& t : Ranked(mesh, blind).terms) EXPECT_NEAR(t.distortion, 1, 1e-12);
}

// Integral of the curvature: times the area it was divided by.
double total_curvature(const HexMesh& mesh) {
  const auto curvature = boundary_gaussian_curvature(mesh);
  double sum = 0;
  for (HalfFaceHandle hf : mesh.boundary_halffaces()) {
    const QuadVertices q = mesh.vertices(hf);
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector3d u = mesh.point(q[(i + 1) % 4]) - mesh.point(q[i]);
      const Eigen::Vector3d v = mesh.point(q[(i + 3) % 4]) - mesh.point(q[i]);
      sum += curvature[q[i].idx] * u.cross(v).norm() / 4;
    }
  }
  return sum;
}

TEST(GaussianCurvature, IsAnAngleDeficitOverAnArea) {
  const auto k = boundary_gaussian_curvature(make_grid({2, 2, 2}));
  EXPECT_NEAR(k[0], (kPi / 2) / 0.75, 1e-12);  // three quarters of a unit square
  EXPECT_NEAR(k[1], 0, 1e-12);                 // on an edge of the box
  EXPECT_EQ(k[13], 0);                         // inside
}

TEST(GaussianCurvature, SumsToTheEulerNumber) {
  const auto ball = [](int x, int y, int z) {
    return (Eigen::Vector3d(x, y, z) - Eigen::Vector3d(3, 3, 3)).norm() < 3.2;
  };
  EXPECT_NEAR(total_curvature(make_voxels(VoxelSet({7, 7, 7}, ball))), 4 * kPi, 1e-9);
  const auto ring = [](int x, int y, int) { return x != 1 || y != 1; };
  EXPECT_NEAR(total_curvature(make_voxels(VoxelSet({3, 3, 1}, ring))), 0, 1e-9);
  // The angles of a curved side sum to less than 2 pi.
  const double sphere = total_curvature(make_octree_like(Shape::sphere, 9));
  EXPECT_GE(sphere, 4 * kPi);
  EXPECT_LE(sphere, 1.2 * 4 * kPi);
}

TEST(RankChords, CubesChordsFoldEqualEdges) {
  const HexMesh mesh = make_grid({1, 1, 1});
  const BaseComplex bc = extract_base_complex(mesh);
  const auto terms =
      rank_chords(mesh, bc, extract_chords(bc), boundary_gaussian_curvature(mesh), {});
  ASSERT_EQ(terms.size(), 3u);
  for (const ChordTerms& t : terms) {
    // Either sub-diagonal edge has 0 cells left of 2, the pair 0 of 2.
    EXPECT_NEAR(t.deviation, (2 + 2 + 2) / 3.0, 1e-12);
    EXPECT_NEAR(t.valence, 1.67 * 2, 1e-12);
    EXPECT_NEAR(t.geometry, 0, 1e-9);  // the same curvature at all corners
    EXPECT_EQ(t.singular_groups, 4);
    EXPECT_EQ(t.diagonal, Diagonal::first);
    EXPECT_NEAR(t.energy, 0.4 * (1 - std::exp(-1.67 * 2)), 1e-9);
  }
}

TEST(RankChords, ThicknessIsTheLengthOfTheDiagonalsThatFold) {
  const HexMesh mesh = make_grid({1, 1, 1});
  const BaseComplex bc = extract_base_complex(mesh);
  for (const ChordTerms& t :
       rank_chords(mesh, bc, extract_chords(bc), boundary_gaussian_curvature(mesh), {})) {
    EXPECT_NEAR(t.thickness, std::sqrt(2.0), 1e-12);
    EXPECT_EQ(t.cost(Ranking::thickness), t.thickness);
    EXPECT_EQ(t.cost(Ranking::weighted), t.energy);
  }
}

TEST(RankingWeightsValidation, NamesTheWeight) {
  EXPECT_NO_THROW(validate(octree_weights()));
  EXPECT_NO_THROW(validate(polycube_weights()));
  RankingWeights w;
  w.k_width = -1;
  try {
    validate(w);
    FAIL() << "a negative weight passed";
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(), "k_width = -1, expected a finite number >= 0");
  }
  EXPECT_THROW(validate({.min_width = 0, .mean_width = 0}), InputError);
  EXPECT_THROW(validate({.beta = std::nan("")}), InputError);
}

TEST(RankChords, TakesTheDiagonalThatLeavesTheSmallerError) {
  const HexMesh mesh = make_octree_like(Shape::sphere, 7);
  const BaseComplex bc = extract_base_complex(mesh);
  const auto chords = extract_chords(bc);
  const auto terms = rank_chords(mesh, bc, chords, boundary_gaussian_curvature(mesh), {});
  for (std::size_t i = 0; i < chords.size(); ++i) {
    std::array<double, 2> sum = {0, 0};
    for (const ChordLink& l : chords[i].links) {
      for (int d : {0, 1}) {
        const LinkEdges x = link_edges(bc, l, static_cast<Diagonal>(d));
        const BaseEdge &a = bc.edges[x.a], &b = bc.edges[x.b];
        for (int e : {x.c, x.d}) {
          sum[d] += std::abs(bc.edges[e].valence - 1 - bc.edges[e].regular_valence());
        }
        const int q = a.boundary || b.boundary ? 2 : 4;
        sum[d] += std::abs(a.valence + b.valence - 2 - q);
      }
    }
    const double k = 3.0 * static_cast<double>(chords[i].links.size());
    EXPECT_NEAR(terms[i].deviation, std::min(sum[0], sum[1]) / k, 1e-12);
    EXPECT_EQ(terms[i].diagonal, sum[1] < sum[0] ? Diagonal::second : Diagonal::first);
  }
}

}  // namespace
}  // namespace hexweft
