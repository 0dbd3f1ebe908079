/// \file
/// Sorted, each once.
#pragma once

#include <algorithm>
#include <vector>

namespace hexweft::detail {

template <class T>
void sort_unique(std::vector<T>& some) {
  std::sort(some.begin(), some.end());
  some.erase(std::unique(some.begin(), some.end()), some.end());
}

}  // namespace hexweft::detail
