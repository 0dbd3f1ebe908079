// Published figures of real meshes, where they are at hand.
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include <gmock/gmock.h>

#include "io/hex_mesh_io.h"
#include "simplify/report.h"
#include "tests/simplify/prediction.h"
#include "tests/simplify/test_meshes.h"

namespace hexweft {
namespace {

namespace fs = std::filesystem;
const fs::path kData = HEXWEFT_SHARED_DATA;

using Row = std::map<std::string, std::string>;  // by column

std::vector<Row> published_rows() {
  std::ifstream in(kData / "published.csv");
  std::vector<std::string> columns;
  std::vector<Row> rows;
  for (std::string line; std::getline(in, line);) {
    std::istringstream cells(line);
    std::vector<std::string> values;
    for (std::string value; std::getline(cells, value, ',');) values.push_back(value);
    if (columns.empty()) {
      columns = values;
      continue;
    }
    Row row;
    for (std::size_t i = 0; i < columns.size() && i < values.size(); ++i) {
      row[columns[i]] = values[i];
    }
    rows.push_back(row);
  }
  return rows;
}

// The figures are printed with four digits after the point.
void expect_printed(double value, const std::string& printed) {
  EXPECT_NEAR(value, std::stod(printed), 0.51e-4);
}

TEST(RealMeshes, InputsHaveThePublishedFigures) {
  const auto rows = published_rows();
  if (rows.empty()) GTEST_SKIP() << kData << " is not there";
  int n = 0;
  for (const Row& row : rows) {
    const fs::path path = kData / row.at("corpus") / (row.at("mesh") + ".vtk");
    if (!fs::exists(path)) continue;
    SCOPED_TRACE(path.string());
    const MeshFigures f = measure_mesh(read_hex_mesh(path));
    EXPECT_EQ(f.hexahedra, std::stoi(row.at("H_in")));
    EXPECT_EQ(f.components, std::stoi(row.at("BC_in")));
    expect_printed(f.min_scaled_jacobian, row.at("MSJ_in"));
    expect_printed(f.mean_scaled_jacobian, row.at("ASJ_in"));
    ++n;
  }
  EXPECT_GT(n, 0);
}

// The published genus is 1 - chi / 2 of the whole boundary, so that a cavity lowers it by one.
void expect_published_genus(bool (*is_looked_at)(const TopologySummary&)) {
  const auto rows = published_rows();
  if (rows.empty()) GTEST_SKIP() << kData << " is not there";
  for (const Row& row : rows) {
    const fs::path path = kData / row.at("corpus") / (row.at("mesh") + ".vtk");
    if (!fs::exists(path)) continue;
    const HexMesh mesh = read_hex_mesh(path);
    const TopologySummary t = summarize_topology(mesh);
    const int chi = t.n_boundary_vertices - t.n_boundary_edges + t.n_boundary_faces;
    EXPECT_EQ(1 - chi / 2, std::stoi(row.at("genus"))) << path;
    EXPECT_TRUE(!is_looked_at(t) || t.genus == std::stoi(row.at("genus"))) << path;
  }
}

TEST(RealMeshes, InputsWithoutCavityHaveThePublishedGenus) {
  expect_published_genus([](const TopologySummary& t) { return t.n_boundary_components == 1; });
}

// polycube/hollow-eight has a cavity of genus 2: published as 3, a sum of 4.
TEST(RealMeshes, AllInputsHaveThePublishedGenus) {
  expect_published_genus([](const TopologySummary&) { return true; });
}

TEST(RealMeshes, PublishedOutputsHaveThePublishedBaseComplex) {
  const auto rows = published_rows();
  if (rows.empty()) GTEST_SKIP() << kData << " is not there";
  int n = 0;
  for (const Row& row : rows) {
    const fs::path path = kData / "published" / (row.at("corpus") + "_" + row.at("mesh") + ".vtk");
    if (!fs::exists(path)) continue;
    SCOPED_TRACE(path.string());
    const HexMesh mesh = read_hex_mesh(path);
    const BaseComplex bc = extract_base_complex(mesh);
    EXPECT_EQ(bc.irregular, 0);
    EXPECT_EQ(mesh.n_cells(), std::stoi(row.at("weighted_H")));
    const BaseCounts expected = {std::stoi(row.at("weighted_BV")), std::stoi(row.at("weighted_BE")),
                                 std::stoi(row.at("weighted_BF")),
                                 std::stoi(row.at("weighted_BC"))};
    EXPECT_EQ(counts(bc), expected);
    ++n;
  }
  EXPECT_GT(n, 0);
}

TEST(RealMeshes, AllAreCutIntoGridsOnly) {
  if (!fs::exists(kData)) GTEST_SKIP() << kData << " is not there";
  for (const char* folder : {"octree", "polycube", "published"}) {
    for (const auto& entry : fs::directory_iterator(kData / folder)) {
      if (entry.path().extension() != ".vtk") continue;
      SCOPED_TRACE(entry.path().string());
      const HexMesh mesh = read_hex_mesh(entry.path());
      const BaseComplex bc = extract_base_complex(mesh);
      EXPECT_EQ(bc.irregular, 0);
      int cells = 0;
      for (const Component& c : bc.components) cells += c.n_cells();
      EXPECT_EQ(cells, mesh.n_cells());
      const auto [v, e, f, c] = counts(bc);
      EXPECT_EQ(v - e + f - c, euler_characteristic(mesh));
    }
  }
}

class RealMesh : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(, RealMesh,
                         testing::Values("octree/dancer.vtk", "octree/bone.vtk", "octree/block.vtk",
                                         "polycube/fancy_ring.vtk", "polycube/fertility_small.vtk",
                                         "published/octree_eight.vtk"),
                         [](const auto& mesh) {
                           std::string name = mesh.param;
                           for (char& c : name) c = std::isalnum(c) ? c : '_';
                           return name;
                         });

TEST_P(RealMesh, CollapsesHaveThePredictedEdges) {
  const fs::path path = kData / GetParam();
  if (!fs::exists(path)) GTEST_SKIP() << path << " is not there";
  HexMesh mesh = read_hex_mesh(path);
  const BaseComplex bc = extract_base_complex(mesh);
  const auto plans = all_plans(mesh, bc, bc.components.size() / 100 + 1);
  PlanTally tally;
  for (std::size_t i = 0; i < plans.size(); ++i) {
    try_plan(mesh, bc, plans[i], tally, i % (plans.size() / 3 + 1) == 0);
  }
  EXPECT_GT(tally.as_predicted, 0);
}

}  // namespace
}  // namespace hexweft
