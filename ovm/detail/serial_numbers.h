/// \file
/// Numbers of elements that compaction leaves as they are.
#pragma once

#include <vector>

namespace hexweft::detail {

/// The number of a slot is its place as if no gap had ever been closed.
class SerialNumbers {
 public:
  int operator[](int slot) const {
    return slot < static_cast<int>(kept_.size()) ? kept_[slot] : slot + shift_;
  }
  /// \param n_old  slots before
  void keep(const std::vector<int>& old_of_new, int n_old) {
    std::vector<int> kept;
    kept.reserve(old_of_new.size());
    for (int old : old_of_new) kept.push_back((*this)[old]);
    shift_ += n_old - static_cast<int>(kept.size());
    kept_ = std::move(kept);
  }

 private:
  std::vector<int> kept_;  // of the slots that there were at the last compaction
  int shift_ = 0;          // of the others
};

}  // namespace hexweft::detail
