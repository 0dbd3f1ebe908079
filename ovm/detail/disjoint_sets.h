/// \file
/// Union-find over 0 .. n-1.
#pragma once

#include <numeric>
#include <utility>
#include <vector>

namespace hexweft::detail {

class DisjointSets {
 public:
  explicit DisjointSets(int n = 0) { reset(n); }
  void reset(int n) {
    parent_.resize(n);
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  int add() {
    parent_.push_back(static_cast<int>(parent_.size()));
    return parent_.back();
  }
  int size() const { return static_cast<int>(parent_.size()); }
  int find(int x) {
    while (parent_[x] != x) x = parent_[x] = parent_[parent_[x]];
    return x;
  }
  /// The lower root stays root, so that results do not depend on the order of joins.
  bool join(int a, int b) {
    a = find(a);
    b = find(b);
    if (a == b) return false;
    if (a > b) std::swap(a, b);
    parent_[b] = a;
    return true;
  }

  /// Makes x a set of its own again. \pre done for every member of its set
  void release(int x) { parent_[x] = x; }

 private:
  std::vector<int> parent_;
};

}  // namespace hexweft::detail
