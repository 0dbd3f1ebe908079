/// \file
/// The option --energy, the same in every program that moves vertices.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "optimize/energies/table.h"

namespace hexweft::cli {

/// \param energy  a name of the energy table; what it is before is the default
inline void add_energy_option(CLI::App& app, std::string& energy, const char* help) {
  std::vector<std::string> names;
  for (const Energy& e : all_energies()) names.emplace_back(name(e));
  app.add_option("--energy", energy, help)->check(CLI::IsMember(names))->capture_default_str();
}

}  // namespace hexweft::cli
