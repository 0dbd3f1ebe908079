/// \file
/// The tags under which a Gmsh file knows its nodes and elements. They come in any order and with
/// gaps of any size, so they are sorted, not tabled.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace hexweft::detail {

class GmshTags {
 public:
  void reserve(std::size_t n) { entries_.reserve(n); }
  void add(std::int64_t tag, int index);
  /// To be called after the last add(). \return  the index of an entry whose tag an earlier one
  /// has, or -1; find() gives the earlier one
  int sort();
  /// The index, or -1 if there is no such tag. \pre sort()
  int find(std::int64_t tag) const;
  /// The first tag of the index; for messages, as it searches. \pre the index was added
  std::int64_t tag_of(int index) const;

 private:
  std::vector<std::pair<std::int64_t, int>> entries_;
  bool consecutive_ = true;  // the tags so far ascend by one: the usual case needs no search
};

}  // namespace hexweft::detail
