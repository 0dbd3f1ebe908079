/// \file
/// The fewest base faces that part some components of a base complex from others.
#pragma once

#include <span>
#include <vector>

#include "simplify/base_complex.h"

namespace hexweft {

struct ComponentCut {
  std::vector<char> inside;  ///< by component
  int n_faces = 0;           ///< base faces between inside and outside
};

/// A minimum cut, the one nearest to `inside` [Ford1956]. Cost O(#B_F * cut).
/// \param inside, outside  components that have to be there; disjoint
ComponentCut smallest_cut(const BaseComplex& bc, std::span<const int> inside,
                          std::span<const int> outside);

}  // namespace hexweft
