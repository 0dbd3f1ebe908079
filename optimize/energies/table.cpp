#include "optimize/energies/table.h"

#include <string>

#include "ovm/errors.h"

namespace hexweft {

#define HEXWEFT_COMPILE(Kind) template class EnergyModelOf<Kind>;
HEXWEFT_ENERGIES(HEXWEFT_COMPILE)
#undef HEXWEFT_COMPILE

std::vector<Energy> all_energies() {
#define HEXWEFT_DEFAULT(Kind) Kind{},
  return {HEXWEFT_ENERGIES(HEXWEFT_DEFAULT)};
#undef HEXWEFT_DEFAULT
}

Energy make_energy(std::string_view wanted) {
  std::string known;
  for (const Energy& e : all_energies()) {
    if (e.name() == wanted) return e;
    known += (known.empty() ? "" : ", ") + std::string(e.name());
  }
  throw InputError("energy \"" + std::string(wanted) + "\" is unknown, expected one of " + known);
}

}  // namespace hexweft
