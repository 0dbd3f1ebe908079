#include "ovm/quality.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gmock/gmock.h>

#include "tests/mesh_families.h"

namespace hexweft {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

HexPoints transformed_cube(const Matrix3d& m) {
  HexPoints p;
  for (int i = 0; i < kCorners; ++i) {
    p[i] = m * Vector3d(kCornerCoords[i][0], kCornerCoords[i][1], kCornerCoords[i][2]);
  }
  return p;
}

TEST(Quality, OfACubeIsOne) {
  const HexPoints p = transformed_cube(Matrix3d::Identity());
  EXPECT_DOUBLE_EQ(scaled_jacobian(p), 1);
  EXPECT_DOUBLE_EQ(shape_metric(p), 1);
  EXPECT_DOUBLE_EQ(volume(p), 1);
}

TEST(Quality, OfABoxDependsOnItsProportionsInShapeOnly) {
  const HexPoints p = transformed_cube(Vector3d(1, 2, 3).asDiagonal());
  EXPECT_DOUBLE_EQ(scaled_jacobian(p), 1);
  EXPECT_NEAR(volume(p), 6, 1e-14);
  EXPECT_NEAR(shape_metric(p), 3 * std::cbrt(36.0) / 14, 1e-14);
}

TEST(Quality, OfAShearedCubeIsTheSineOfItsAngle) {
  Matrix3d shear = Matrix3d::Identity();
  shear(0, 1) = 0.75;
  const HexPoints p = transformed_cube(shear);
  EXPECT_NEAR(scaled_jacobian(p), 1 / std::sqrt(1 + 0.75 * 0.75), 1e-14);
  EXPECT_NEAR(volume(p), 1, 1e-14);
  EXPECT_NEAR(shape_metric(p), 3 / (3 + 0.75 * 0.75), 1e-14);
}

TEST(Quality, IsBlindToPositionRotationAndScale) {
  HexPoints p = transformed_cube(Matrix3d::Identity());
  p[6] += Vector3d(0.2, -0.3, 0.1);
  const Matrix3d rotation = Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()).matrix();
  HexPoints q;
  for (int i = 0; i < kCorners; ++i) q[i] = 5 * (rotation * p[i]) + Vector3d(3, 1, -2);
  EXPECT_NEAR(scaled_jacobian(q), scaled_jacobian(p), 1e-13);
  EXPECT_NEAR(shape_metric(q), shape_metric(p), 1e-13);
  EXPECT_NEAR(volume(q), 125 * volume(p), 1e-11);
}

TEST(Quality, OfACornerPulledThroughIsNegative) {
  HexPoints p = transformed_cube(Matrix3d::Identity());
  p[6] = Vector3d(0.2, 0.2, 0.2);
  // The edges at corner 6 are (-0.2, 0.8, 0.8) and its like: a circulant matrix of determinant
  // (0.8 + 0.2)^2 (2 * 0.8 - 0.2), which is negative the way that corner is oriented.
  EXPECT_NEAR(scaled_jacobian(p), -1.4 / std::pow(2 * 0.64 + 0.04, 1.5), 1e-12);
  EXPECT_EQ(shape_metric(p), 0);
}

TEST(Quality, OfMirroredAndFlatCells) {
  EXPECT_DOUBLE_EQ(scaled_jacobian(transformed_cube(Vector3d(1, 1, -1).asDiagonal())), -1);
  EXPECT_DOUBLE_EQ(volume(transformed_cube(Vector3d(1, 1, -1).asDiagonal())), -1);
  EXPECT_DOUBLE_EQ(scaled_jacobian(transformed_cube(Vector3d(1, 1, 0).asDiagonal())), -1);
  EXPECT_EQ(shape_metric(transformed_cube(Vector3d(1, 1, 0).asDiagonal())), 0);
}

TEST(Quality, VolumeDeviationComparesFaceNeighbors) {
  HexMesh mesh = make_grid({3, 1, 1});
  for (VertexHandle v : mesh.vertices()) {  // cells of length 1, 1 and 4
    if (mesh.point(v).x() == 3) mesh.set_point(v, mesh.point(v) + Vector3d(3, 0, 0));
  }
  const QualitySummary q = summarize_quality(mesh);
  EXPECT_NEAR(q.total_volume, 6, 1e-14);
  // Over the mean volume 2: the cells deviate by 0, sqrt((0 + 9) / 2) / 2 and 3 / 2.
  EXPECT_NEAR(q.mean_volume_deviation, (0 + std::sqrt(4.5) / 2 + 1.5) / 3, 1e-14);
  EXPECT_NEAR(q.max_volume_deviation, 1.5, 1e-14);
  EXPECT_NEAR(q.mean_edge_length, (4 * 6 + 8 + 8) / 28.0, 1e-14);
}

TEST(Quality, SummaryListsTheWorstFirst) {
  HexMesh mesh = make_grid({4, 1, 1});
  mesh.set_point(mesh.vertices(CellHandle(3))[6], Vector3d(3.1, 0.1, 0.1));
  mesh.set_point(mesh.vertices(CellHandle(0))[7], Vector3d(0, 1, 1.5));
  const QualitySummary q = summarize_quality(mesh, 2);
  EXPECT_EQ(q.n_inverted, 1);
  EXPECT_THAT(q.worst_cells, testing::ElementsAre(CellHandle(3), CellHandle(0)));
  EXPECT_EQ(q.min_scaled_jacobian, scaled_jacobian(mesh, CellHandle(3)));
  EXPECT_EQ(q.min_scaled_jacobian, min_scaled_jacobian(mesh));
  EXPECT_THAT(summarize_quality(mesh, 0).worst_cells, testing::IsEmpty());
}

class EveryMeshFamily : public testing::TestWithParam<MeshFamily> {};
INSTANTIATE_TEST_SUITE_P(, EveryMeshFamily, testing::ValuesIn(mesh_families()), family_name);

TEST_P(EveryMeshFamily, SummaryIsTheStatisticsOfItsCells) {
  const HexMesh mesh = GetParam().make();
  const QualitySummary q = summarize_quality(mesh);
  double sum = 0, squares = 0;
  for (CellHandle c : mesh.cells()) {
    const double sj = scaled_jacobian(mesh, c);
    EXPECT_GE(sj, q.min_scaled_jacobian);
    EXPECT_GT(shape_metric(mesh, c), 0);
    EXPECT_LE(shape_metric(mesh, c), 1 + 1e-12);
    sum += sj;
    squares += std::pow(sj - q.mean_scaled_jacobian, 2);
  }
  EXPECT_NEAR(q.mean_scaled_jacobian, sum / mesh.n_cells(), 1e-12);
  EXPECT_NEAR(q.std_scaled_jacobian, std::sqrt(squares / mesh.n_cells()), 1e-7);
  EXPECT_GT(q.min_scaled_jacobian, 0);
  EXPECT_EQ(q.n_inverted, 0);
}

TEST(Quality, OfNoCellsIsNeutral) {
  const QualitySummary q = summarize_quality(HexMesh());
  EXPECT_EQ(q.min_scaled_jacobian, 1);
  EXPECT_EQ(q.mean_edge_length, 0);
}

}  // namespace
}  // namespace hexweft
