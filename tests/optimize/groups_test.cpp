// Values come back group by group.
#include "optimize/groups.h"

#include <array>
#include <vector>

#include <gtest/gtest.h>

#include "tests/random.h"

namespace hexweft {
namespace {

TEST(Groups, HoldWhatAListForEachWould) {
  Random random(2);
  constexpr int kGroups = 9;
  std::vector<std::vector<int>> lists(kGroups);
  std::vector<std::array<int, 2>> added;  // group and value
  std::vector<int> sizes(kGroups, 0);
  for (int i = 0; i < 100; ++i) {
    const int group = static_cast<int>(random.uniform(0, kGroups - 1));  // the last one stays empty
    added.push_back({group, i});
    ++sizes[group];
  }
  Groups<int> groups(sizes);
  for (const auto& [group, value] : added) {
    groups.add(group, value);
    lists[group].push_back(value);
    EXPECT_EQ(groups[group].back(), value);
  }
  for (int g = 0; g < kGroups; ++g) {
    EXPECT_EQ(std::vector<int>(groups[g].begin(), groups[g].end()), lists[g]);
  }
  EXPECT_TRUE(groups[kGroups - 1].empty());
}

}  // namespace
}  // namespace hexweft
