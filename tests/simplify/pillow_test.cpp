// Sheets collapsed with a pillow beside what is in their way.
#include "simplify/pillow.h"

#include <algorithm>

#include <gmock/gmock.h>

#include "ovm/transaction.h"
#include "simplify/pillow_search.h"
#include "simplify/pillowed_collapse.h"
#include "tests/mesh_families.h"
#include "tests/ovm/mesh_dump.h"
#include "tests/simplify/prediction.h"
#include "tests/simplify/test_meshes.h"
#include "tests/simplify/trial_bench.h"

namespace hexweft {
namespace {

TEST(Pillow, TakesTheWayFreeForASheetThatWouldLeaveTwoCellsAtAnEdge) {
  TrialBench b(make_blocked_sheet());
  const std::vector<Sheet> sheets = extract_sheets(b.bc);
  const std::vector<PillowedSheet> found = find_pillows(b.mesh, b.bc, sheets, {});
  ASSERT_FALSE(found.empty());
  for (const PillowedSheet& p : found) {
    const Sheet& sheet = sheets[p.sheet];
    EXPECT_EQ(check_plan(b.mesh, b.bc.graph, plan_sheet_collapse(b.mesh, b.bc, sheet)),
              Refusal::valence);
    EXPECT_EQ(p.gain, static_cast<int>(components_of(sheet).size()) - p.pillow.added);
    EXPECT_GE(p.gain, 2);
  }
  const PillowedSheet& best = found.front();
  const TrialResult result =
      try_pillowed_collapse(b.context, b.bc, sheets[best.sheet], best.pillow, {});
  ASSERT_TRUE(result.accepted()) << name(result.refusal);
  EXPECT_LE(result.base_complex.components.size(), b.bc.components.size() - best.gain);
  EXPECT_EQ(counts(extract_base_complex(b.mesh)), counts(result.base_complex));
  EXPECT_TRUE(is_good(b.mesh));
  EXPECT_LE(b.distance.distance(), b.context.distance_limit);
}

TEST(Pillow, OneThatLeavesPoorHexahedraIsTakenBackWithTheCollapse) {
  TrialBench b(make_blocked_sheet());
  const std::vector<Sheet> sheets = extract_sheets(b.bc);
  SimplifyOptions none_is_good_enough;
  none_is_good_enough.min_scaled_jacobian = 0.99;
  none_is_good_enough.mean_scaled_jacobian = 0.999;
  const std::vector<PillowedSheet> found = find_pillows(b.mesh, b.bc, sheets, {});
  ASSERT_FALSE(found.empty());
  const MeshDump before(b.mesh);
  std::vector<double> distance = b.distance.distance_by_halfface();
  for (const PillowedSheet& p : found) {
    b.context.distance_limit = b.context.final_limit = 1e-12;
    const TrialResult result =
        try_pillowed_collapse(b.context, b.bc, sheets[p.sheet], p.pillow, none_is_good_enough);
    EXPECT_FALSE(result.accepted());
    EXPECT_TRUE(result.base_complex.components.empty());
    EXPECT_TRUE(MeshDump(b.mesh) == before);
    // Of half-faces that there were for a while it knows nothing.
    const std::vector<double> now = b.distance.distance_by_halfface();
    distance.resize(now.size(), 0);
    EXPECT_EQ(now, distance);
  }
}

// A poor hexahedron far away is no leave to make more of them.
TEST(Pillow, FloorsAreThoseOfItsSurroundings) {
  SimplifyOptions options;
  options.min_scaled_jacobian = 0.69;
  for (const bool is_spoilt : {false, true}) {
    HexMesh mesh = make_blocked_sheet();
    if (is_spoilt) {
      CellVertices poor;
      for (int i = 0; i < 8; ++i) {
        const double x = i % 4 == 1 || i % 4 == 2 ? 1 : 0, y = i % 4 >= 2 ? 1 : 0, z = i / 4;
        poor[i] = mesh.add_vertex({30 + x + 3 * z, y, z});
      }
      mesh.add_cell(poor);
      ASSERT_LT(min_scaled_jacobian(mesh), 0.4);
    }
    TrialBench b(std::move(mesh));
    const std::vector<Sheet> sheets = extract_sheets(b.bc);
    const std::vector<PillowedSheet> found = find_pillows(b.mesh, b.bc, sheets, {});
    ASSERT_FALSE(found.empty());
    for (const PillowedSheet& p : found) {
      const TrialResult result =
          try_pillowed_collapse(b.context, b.bc, sheets[p.sheet], p.pillow, options);
      EXPECT_EQ(result.refusal, Refusal::quality) << name(result.refusal);
      if (result.accepted()) break;
    }
  }
}

class PillowsOfEveryFamily : public testing::TestWithParam<MeshFamily> {};

TEST_P(PillowsOfEveryFamily, TheSidesOfASheetAreTheEndsOfItsEdges) {
  const HexMesh mesh = GetParam().make();
  const BaseComplex bc = extract_base_complex(mesh);
  for (const Sheet& sheet : extract_sheets(bc)) {
    if (sheet.kind == SheetKind::moebius) continue;
    const std::vector<char> sides = sides_of_sheet(mesh, bc, sheet);
    for (std::size_t i = 0; i < sheet.edges.size(); ++i) {
      const auto chain = bc.chain(bc.edges[sheet.edges[i]]);
      const auto [first, second] = sheet.against[i] ? std::pair(chain.back(), chain.front())
                                                    : std::pair(chain.front(), chain.back());
      EXPECT_TRUE(sides[first.idx] & 1);
      EXPECT_TRUE(sides[second.idx] & 2);
      if (sheet.kind == SheetKind::tangent || sheet.kind == SheetKind::intersecting) continue;
      EXPECT_EQ(sides[first.idx], 1);
      EXPECT_EQ(sides[second.idx], 2);
      for (std::size_t j = 1; j + 1 < chain.size(); ++j) EXPECT_EQ(sides[chain[j].idx], 0);
    }
  }
}

TEST_P(PillowsOfEveryFamily, AnInsertedOneAddsItsComponentsAndLeavesTheSheetItsCells) {
  HexMesh mesh = GetParam().make();
  const BaseComplex bc = extract_base_complex(mesh);
  const std::vector<Sheet> sheets = extract_sheets(bc);
  int inserted_ones = 0;
  for (std::size_t i = 0; i < sheets.size() && inserted_ones < 4; ++i) {
    const CollapsePlan plan = plan_sheet_collapse(mesh, bc, sheets[i]);
    const int groups[] = {plan.n_groups() / 2};
    for (int side = 0; side < 2; ++side) {
      const auto pillow = smallest_pillow(mesh, bc, sheets[i], plan, groups, side);
      if (!pillow) continue;
      const MeshDump before(mesh);
      {
        Transaction look(mesh);
        const auto inserted = insert_pillow(mesh, bc, sheets[i], plan, *pillow);
        if (inserted) {
          ++inserted_ones;
          std::vector<CellHandle> as_before = inserted->plan.removed;
          for (CellHandle& c : as_before) {
            for (const auto& r : inserted->layer.replaced) c = r.after == c ? r.before : c;
          }
          EXPECT_THAT(as_before, testing::UnorderedElementsAreArray(plan.removed));
          // Where a singular edge has become regular, components of the pillow may be one with others.
          EXPECT_LE(inserted->base_complex.components.size(), bc.components.size() + pillow->added);
          EXPECT_TRUE(is_valid(mesh));
        }
      }
      EXPECT_TRUE(MeshDump(mesh) == before);
    }
  }
  RecordProperty("inserted", inserted_ones);
}

TEST_P(PillowsOfEveryFamily, ATrialThatIsRefusedLeavesEverythingAsItWas) {
  TrialBench b(GetParam().make());
  const std::vector<Sheet> sheets = extract_sheets(b.bc);
  const MeshDump before(b.mesh);
  const std::vector<PillowedSheet> found = find_pillows(b.mesh, b.bc, sheets, {.max_interior = 8});
  EXPECT_TRUE(MeshDump(b.mesh) == before);
  EXPECT_TRUE(std::is_sorted(found.begin(), found.end(),
                             [](const auto& x, const auto& y) { return x.gain > y.gain; }));
  SimplifyOptions none_is_good_enough;
  none_is_good_enough.mean_scaled_jacobian = 0.999;
  none_is_good_enough.min_scaled_jacobian = 0.99;
  b.context.distance_limit = b.context.final_limit = 1e-12;
  for (const PillowedSheet& p : found) {
    const double distance = b.distance.distance();
    const TrialResult result =
        try_pillowed_collapse(b.context, b.bc, sheets[p.sheet], p.pillow, none_is_good_enough);
    if (result.accepted()) break;
    EXPECT_TRUE(result.base_complex.components.empty());
    EXPECT_TRUE(MeshDump(b.mesh) == before);
    EXPECT_EQ(b.distance.distance(), distance);
  }
}

TEST_P(PillowsOfEveryFamily, AskedForSomeTheFirstOfAllAreFound) {
  HexMesh mesh = GetParam().make();
  const BaseComplex bc = extract_base_complex(mesh);
  const std::vector<Sheet> sheets = extract_sheets(bc);
  const std::vector<PillowedSheet> all = find_pillows(mesh, bc, sheets, {.max_interior = 8});
  for (const int most : {1, 2, 3, 5, 8}) {
    const auto some = find_pillows(mesh, bc, sheets, {.max_interior = 8}, most);
    ASSERT_EQ(some.size(), std::min<std::size_t>(most, all.size()));
    for (std::size_t i = 0; i < some.size(); ++i) {
      EXPECT_EQ(some[i].sheet, all[i].sheet);
      EXPECT_EQ(some[i].gain, all[i].gain);
      EXPECT_EQ(some[i].pillow.inside, all[i].pillow.inside);
    }
  }
}

TEST(Pillow, SomeFamiliesHaveThem) {
  int found = 0, inserted = 0;
  for (const MeshFamily& family : mesh_families()) {
    HexMesh mesh = family.make();
    const BaseComplex bc = extract_base_complex(mesh);
    const std::vector<Sheet> sheets = extract_sheets(bc);
    for (const PillowedSheet& p : find_pillows(mesh, bc, sheets, {.max_interior = 8})) {
      ++found;
      Transaction look(mesh);
      const CollapsePlan plan = plan_sheet_collapse(mesh, bc, sheets[p.sheet]);
      inserted += insert_pillow(mesh, bc, sheets[p.sheet], plan, p.pillow).has_value();
    }
  }
  EXPECT_GT(found, 0);
  EXPECT_GT(inserted, 0);
}

INSTANTIATE_TEST_SUITE_P(, PillowsOfEveryFamily, testing::ValuesIn(mesh_families()), family_name);

// A block is one component: it has nothing that a pillow could go round.
TEST(Pillow, AGridHasNone) {
  HexMesh mesh = make_grid({3, 3, 3});
  const BaseComplex bc = extract_base_complex(mesh);
  EXPECT_TRUE(find_pillows(mesh, bc, extract_sheets(bc), {}).empty());
}

}  // namespace
}  // namespace hexweft
