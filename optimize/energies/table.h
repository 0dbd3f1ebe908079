/// \file
/// Every distortion energy, one row each. A new one is a header in this folder and a row here.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "optimize/energies/foldover_free.h"
#include "optimize/energies/symmetric_dirichlet.h"
#include "ovm/errors.h"

namespace hexweft {

using Energy = std::variant<SymmetricDirichlet,  //
                            FoldoverFree>;

inline std::string_view name(const Energy& energy) {
  return std::visit([](const auto& e) { return e.name; }, energy);
}

/// One of each, in the order of the table, with its default parameters.
template <std::size_t I = 0>
std::vector<Energy> all_energies() {
  if constexpr (I == std::variant_size_v<Energy>) {
    return {};
  } else {
    std::vector<Energy> rest = all_energies<I + 1>();
    rest.insert(rest.begin(), Energy(std::in_place_index<I>));
    return rest;
  }
}

/// \throws InputError if no energy has this name; the message lists those there are.
inline Energy make_energy(std::string_view wanted) {
  std::string known;
  for (const Energy& e : all_energies()) {
    if (name(e) == wanted) return e;
    known += (known.empty() ? "" : ", ") + std::string(name(e));
  }
  throw InputError("energy \"" + std::string(wanted) + "\" is unknown, expected one of " + known);
}

}  // namespace hexweft
