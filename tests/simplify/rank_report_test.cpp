// The list of candidates with their terms and refusals.
#include "simplify/rank_report.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "simplify/feature_targets.h"
#include "tests/simplify/test_meshes.h"

namespace hexweft {
namespace {

RankReport report_of(const HexMesh& mesh, Ranking ranking = Ranking::weighted) {
  const BaseComplex bc = extract_base_complex(mesh);
  const auto labels = feature_of(make_reference_surface(mesh), mesh);
  return report_ranking(mesh, bc, base_edges_on_features(bc, labels), {}, ranking);
}

template <class Ranked>
void expect_passing_first_and_sorted(const std::vector<Ranked>& list, Ranking ranking) {
  for (std::size_t i = 1; i < list.size(); ++i) {
    const bool passes = list[i].refusal == Refusal::none;
    const bool before = list[i - 1].refusal == Refusal::none;
    EXPECT_LE(passes, before);
    if (passes == before) {
      EXPECT_LE(list[i - 1].terms.cost(ranking), list[i].terms.cost(ranking));
    }
  }
}

TEST(RankReport, ListsEverySheetAndChordInOrder) {
  const HexMesh mesh = make_octree_like(Shape::blob, 8, 2);
  const BaseComplex bc = extract_base_complex(mesh);
  for (const Ranking ranking : {Ranking::weighted, Ranking::thickness}) {
    const RankReport r = report_of(mesh, ranking);
    EXPECT_EQ(r.sheets.size(), extract_sheets(bc).size());
    EXPECT_EQ(r.chords.size(), extract_chords(bc).size());
    expect_passing_first_and_sorted(r.sheets, ranking);
    expect_passing_first_and_sorted(r.chords, ranking);
    EXPECT_EQ(r.sheets[0].refusal, Refusal::none);
  }
}

TEST(RankReport, SaysWhyAGridCannotBeCollapsed) {
  // Nothing would be left of a single cell.
  const HexMesh mesh = make_grid({1, 1, 1});
  const RankReport r = report_of(mesh);
  ASSERT_EQ(r.sheets.size(), 3u);
  for (const RankedSheet& s : r.sheets) {
    EXPECT_NE(s.refusal, Refusal::none);
    EXPECT_EQ(s.cells, 1);
    EXPECT_EQ(s.width, 1);
  }
}

TEST(RankReport, JsonAndTableSayTheSame) {
  const HexMesh mesh = make_pillowed_grid(3);
  const RankReport r = report_of(mesh);
  const auto j = r.json();
  EXPECT_EQ(j["ranking"], "weighted");
  ASSERT_EQ(j["sheets"].size(), r.sheets.size());
  EXPECT_EQ(j["sheets"][0]["id"], r.sheets[0].id);
  EXPECT_EQ(j["sheets"][0]["kind"], name(r.sheets[0].kind));
  EXPECT_EQ(j["sheets"][0]["refusal"], "none");
  const auto is_closed = [](const auto& s) { return s["kind"] == "closed"; };
  EXPECT_EQ(std::count_if(j["sheets"].begin(), j["sheets"].end(), is_closed), 1);
  const std::string table = r.table(2);
  EXPECT_THAT(table, testing::HasSubstr("10 sheets, "));
  EXPECT_THAT(table, testing::HasSubstr("and 8 more"));
}

TEST(RankReport, ListsWhatCanBeTakenOffFaces) {
  const RankReport r = report_of(make_padded_cube(3));
  const auto j = r.json();
  ASSERT_EQ(r.peels.size(), 6u);
  ASSERT_EQ(j["peels"].size(), 6u);
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(r.peels[i].cells, 9);
    EXPECT_EQ(r.peels[i].components, 1);
    EXPECT_EQ(j["peels"][i]["id"], r.peels[i].id);
    EXPECT_EQ(j["peels"][i]["refusal"], "none");
  }
  EXPECT_THAT(r.table(2), testing::AllOf(testing::HasSubstr("6 peels, 6 of them pass"),
                                         testing::HasSubstr("and 4 more")));
}

TEST(RankReport, ListsPillowsThatTakeTheWayFree) {
  const RankReport r = report_of(make_blocked_sheet());
  const auto j = r.json();
  ASSERT_FALSE(r.pillows.empty());
  ASSERT_EQ(j["pillows"].size(), r.pillows.size());
  for (std::size_t i = 0; i < r.pillows.size(); ++i) {
    const RankedPillow& p = r.pillows[i];
    EXPECT_EQ(j["pillows"][i]["sheet"], p.sheet);
    EXPECT_EQ(j["pillows"][i]["gain"], p.gain);
    const auto sheet = std::find_if(r.sheets.begin(), r.sheets.end(),
                                    [&](const RankedSheet& s) { return s.id == p.sheet; });
    ASSERT_NE(sheet, r.sheets.end());
    EXPECT_EQ(sheet->refusal, Refusal::valence);
    EXPECT_EQ(sheet->width, p.width);
  }
  EXPECT_THAT(r.table(20), testing::HasSubstr(" pillows that take the way free for a sheet"));
}

}  // namespace
}  // namespace hexweft
