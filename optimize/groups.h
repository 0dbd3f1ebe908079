/// \file
/// Lists of values one behind the other in memory, for groups whose sizes are counted beforehand.
#pragma once

#include <span>
#include <vector>

namespace hexweft {

template <class T>
class Groups {
 public:
  Groups() = default;
  /// \param sizes  how many values each group is going to have
  explicit Groups(std::span<const int> sizes) {
    begin_.reserve(sizes.size());
    int n = 0;
    for (int size : sizes) {
      begin_.push_back(n);
      n += size;
    }
    end_ = begin_;
    values_.resize(n);
  }
  /// \pre the group has not got all its values yet
  void add(int group, const T& value) { values_[end_[group]++] = value; }

  /// In the order they were added.
  std::span<T> operator[](int group) { return {at(begin_[group]), at(end_[group])}; }
  std::span<const T> operator[](int group) const { return {at(begin_[group]), at(end_[group])}; }

 private:
  T* at(int i) { return values_.data() + i; }
  const T* at(int i) const { return values_.data() + i; }

  std::vector<int> begin_, end_;  // by group
  std::vector<T> values_;
};

}  // namespace hexweft
