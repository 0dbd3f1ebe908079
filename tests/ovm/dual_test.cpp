#include "ovm/dual.h"

#include <map>
#include <set>

#include <gmock/gmock.h>

#include "ovm/edit/insert_sheet.h"
#include "tests/mesh_families.h"

namespace hexweft {
namespace {

class EveryMeshFamily : public testing::TestWithParam<MeshFamily> {
 protected:
  const HexMesh mesh_ = GetParam().make();
};
INSTANTIATE_TEST_SUITE_P(, EveryMeshFamily, testing::ValuesIn(mesh_families()), family_name);

TEST_P(EveryMeshFamily, SheetsPartitionTheEdges) {
  const DualSheets sheets = extract_dual_sheets(mesh_);
  int n_seen = 0;
  for (int e = 0; e < mesh_.edge_slots(); ++e) {
    const int sheet = sheets[EdgeHandle(e)];
    EXPECT_EQ(sheet >= 0, mesh_.is_live(EdgeHandle(e)));
    EXPECT_LE(sheet, n_seen) << "numbered in order of the lowest edge";
    n_seen = std::max(n_seen, sheet + 1);
  }
  EXPECT_EQ(n_seen, sheets.n_sheets);
  for (CellHandle c : mesh_.cells()) {
    for (int k = 0; k < kHexEdges; ++k) {
      EXPECT_EQ(sheets[mesh_.edges(c)[k]], sheets[mesh_.edges(c)[4 * edge_axis(k)]]);
    }
  }
}

TEST_P(EveryMeshFamily, OneSheetAtATimeGivesTheSameLists) {
  const auto lists = list_dual_sheets(mesh_);
  std::size_t n_crossings = 0;
  for (const DualSheet& expected : lists) {
    const DualSheet sheet = dual_sheet(mesh_, expected.edges.back());
    EXPECT_EQ(sheet.edges, expected.edges);
    EXPECT_EQ(sheet.crossings, expected.crossings);
    EXPECT_EQ(sheet.crosses_itself(), sheet.cells().size() < sheet.crossings.size());
    n_crossings += sheet.crossings.size();
  }
  EXPECT_EQ(n_crossings, 3u * mesh_.n_cells());
}

TEST_P(EveryMeshFamily, ChordsPartitionTheFaces) {
  const DualChords chords = extract_dual_chords(mesh_);
  std::map<int, std::set<FaceHandle>> faces;
  for (FaceHandle f : mesh_.faces()) faces[chords[f]].insert(f);
  EXPECT_EQ(static_cast<int>(faces.size()), chords.n_chords);
  std::size_t n_crossings = 0;
  for (const auto& [id, expected] : faces) {
    EXPECT_GE(id, 0);
    const DualChord chord = dual_chord(mesh_, *expected.rbegin());
    EXPECT_EQ(std::set(chord.faces.begin(), chord.faces.end()), expected);
    EXPECT_EQ(chord.faces.size(), expected.size()) << "no face twice";
    ASSERT_EQ(chord.crossings.size() + (chord.closed ? 0 : 1), chord.faces.size());
    EXPECT_EQ(mesh_.is_boundary(chord.faces.front()), !chord.closed);
    for (std::size_t i = 0; i < chord.crossings.size(); ++i) {
      const auto [c, axis] = chord.crossings[i];
      const std::set sides{mesh_.face(mesh_.halfface(c, 2 * axis)),
                           mesh_.face(mesh_.halfface(c, 2 * axis + 1))};
      EXPECT_TRUE(sides.contains(chord.faces[i]));
      EXPECT_TRUE(sides.contains(chord.faces[(i + 1) % chord.faces.size()]));
    }
    n_crossings += chord.crossings.size();
  }
  EXPECT_EQ(n_crossings, 3u * mesh_.n_cells());
}

TEST(Sheets, OfAGridAreItsLayers) {
  const HexMesh mesh = make_grid({4, 3, 2});
  EXPECT_EQ(extract_dual_sheets(mesh).n_sheets, 4 + 3 + 2);
  EXPECT_EQ(extract_dual_chords(mesh).n_chords, 4 * 3 + 4 * 2 + 3 * 2);
  const DualSheet sheet = dual_sheet(mesh, mesh.edges(CellHandle(0))[0]);
  EXPECT_EQ(sheet.edges.size(), 4u * 3);
  EXPECT_EQ(sheet.cells().size(), 3u * 2);
  EXPECT_FALSE(sheet.crosses_itself());
}

TEST(Chords, OfATorusClose) {
  const HexMesh mesh = make_torus({.n_core = 2, .n_around = 9, .round_section = false});
  int n_closed = 0;
  for (FaceHandle f : mesh.faces()) n_closed += dual_chord(mesh, f).closed;
  EXPECT_EQ(n_closed, 4 * 9) << "four cells in the section, each with a chord of nine faces";
  EXPECT_EQ(extract_dual_sheets(mesh).n_sheets, 2 + 2 + 9);
}

TEST(Sheets, APillowIsOne) {
  HexMesh mesh = make_grid({4, 4, 4});
  const auto pillow = insert_sheet(mesh, std::array{CellHandle(21), CellHandle(22)});
  ASSERT_EQ(pillow.refusal, InsertRefusal::none);
  EXPECT_EQ(pillow.layer.size(), 10u);
  const auto& copy = pillow.copies.front();
  const DualSheet sheet = dual_sheet(mesh, mesh.find_edge(copy.outer, copy.inner));
  std::vector<CellHandle> layer = pillow.layer;
  std::sort(layer.begin(), layer.end());
  EXPECT_EQ(sheet.cells(), layer);
  EXPECT_EQ(sheet.edges.size(), 12u);
}

}  // namespace
}  // namespace hexweft
