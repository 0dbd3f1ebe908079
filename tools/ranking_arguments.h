/// \file
/// The options of the ranking, the same in every program that ranks.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "simplify/options.h"

namespace hexweft::cli {

/// --preset, --ranking, and a weight or constant of the ranking each.
class RankingArguments {
 public:
  RankingArguments() = default;
  RankingArguments(const RankingArguments&) = delete;  // the parser knows where it lies
  RankingArguments& operator=(const RankingArguments&) = delete;

  void add_to(CLI::App& app);          ///< all of them
  void add_weights_to(CLI::App& app);  ///< all but --ranking
  /// The weights of the preset, where no option says otherwise. \throws InputError on bad ones
  RankingWeights weights() const;
  Ranking ranking() const;

 private:
  std::string preset_ = "octree";
  std::string ranking_ = std::string(name(Ranking::weighted));
  std::vector<std::function<void(RankingWeights&)>> changes_;
};

/// The filters of candidates: chord deviation and add_valence_options().
void add_filter_options(CLI::App& app, SimplifyOptions& options);
/// The bounds on what a collapse may leave behind.
void add_valence_options(CLI::App& app, ValenceLimits& limits);

}  // namespace hexweft::cli
