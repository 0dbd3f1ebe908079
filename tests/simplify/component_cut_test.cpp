// Minimum cuts between components.
#include "simplify/component_cut.h"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "tests/mesh_families.h"

namespace hexweft {
namespace {

int n_faces_between(const BaseComplex& bc, const std::vector<char>& inside) {
  int n = 0;
  for (const BaseFace& f : bc.faces) {
    if (!f.boundary()) n += inside[f.components[0]] != inside[f.components[1]];
  }
  return n;
}

class ComponentCutOfEveryFamily : public testing::TestWithParam<MeshFamily> {};

TEST_P(ComponentCutOfEveryFamily, PartsWhatItIsAskedToByTheFacesItCounts) {
  const HexMesh mesh = GetParam().make();
  const BaseComplex bc = extract_base_complex(mesh);
  const int n = static_cast<int>(bc.components.size());
  for (int a = 0; a < n; a += 1 + n / 5) {
    for (int b = n - 1; b > a; b -= 1 + n / 7) {
      const int inside[] = {a}, outside[] = {b};
      const ComponentCut cut = smallest_cut(bc, inside, outside);
      EXPECT_TRUE(cut.inside[a]);
      EXPECT_FALSE(cut.inside[b]);
      EXPECT_EQ(n_faces_between(bc, cut.inside), cut.n_faces);
      // The other way round it is another one of the same size.
      EXPECT_EQ(smallest_cut(bc, outside, inside).n_faces, cut.n_faces);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, ComponentCutOfEveryFamily, testing::ValuesIn(mesh_families()),
                         family_name);

TEST(ComponentCut, ThereIsNoSmallerOne) {
  for (const MeshFamily& family : mesh_families()) {
    const HexMesh mesh = family.make();
    const BaseComplex bc = extract_base_complex(mesh);
    const int n = static_cast<int>(bc.components.size());
    if (n < 3 || n > 12) continue;
    const int inside[] = {0, 1}, outside[] = {n - 1};
    int least = std::numeric_limits<int>::max();
    std::vector<char> some(n);
    for (unsigned bits = 0; bits < 1u << n; ++bits) {
      for (int c = 0; c < n; ++c) some[c] = static_cast<char>(bits >> c & 1);
      if (some[0] && some[1] && !some[n - 1]) least = std::min(least, n_faces_between(bc, some));
    }
    EXPECT_EQ(smallest_cut(bc, inside, outside).n_faces, least) << family;
  }
}

TEST(ComponentCut, BetweenPartsThereIsNone) {
  const HexMesh mesh = make_two_boxes();
  const BaseComplex bc = extract_base_complex(mesh);
  ASSERT_EQ(bc.components.size(), 2u);
  const int inside[] = {1}, outside[] = {0};
  const ComponentCut cut = smallest_cut(bc, inside, outside);
  EXPECT_EQ(cut.n_faces, 0);
  EXPECT_EQ(cut.inside, (std::vector<char>{0, 1}));
}

}  // namespace
}  // namespace hexweft
