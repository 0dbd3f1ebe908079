#include "io/gmsh_tags.h"

#include <algorithm>

namespace hexweft::detail {

void GmshTags::add(std::int64_t tag, int index) {
  // Tags are at least 1, so that the difference does not overflow.
  if (!entries_.empty() && tag - entries_.back().first != 1) consecutive_ = false;
  entries_.emplace_back(tag, index);
}

int GmshTags::sort() {
  if (consecutive_) return -1;
  const auto less = [](const auto& a, const auto& b) { return a.first < b.first; };
  std::stable_sort(entries_.begin(), entries_.end(), less);
  const auto repeated =
      std::adjacent_find(entries_.begin(), entries_.end(),
                         [](const auto& a, const auto& b) { return a.first == b.first; });
  return repeated == entries_.end() ? -1 : (repeated + 1)->second;
}

int GmshTags::find(std::int64_t tag) const {
  if (entries_.empty() || tag < entries_.front().first || tag > entries_.back().first) return -1;
  if (consecutive_) return entries_[tag - entries_.front().first].second;
  const auto it = std::lower_bound(entries_.begin(), entries_.end(), tag,
                                   [](const auto& a, std::int64_t t) { return a.first < t; });
  return it->first == tag ? it->second : -1;
}

std::int64_t GmshTags::tag_of(int index) const {
  return std::find_if(entries_.begin(), entries_.end(),
                      [index](const auto& entry) { return entry.second == index; })
      ->first;
}

}  // namespace hexweft::detail
