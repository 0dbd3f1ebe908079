#include "tools/ranking_arguments.h"

#include <array>

#include "tools/cli.h"

namespace hexweft::cli {
namespace {

struct WeightArgument {
  const char* name;
  double RankingWeights::*weight;
  const char* help;
};

constexpr std::array kWeights = {
    WeightArgument{"--k-valence", &RankingWeights::k_valence, "Weight of the valence term, k_sv"},
    WeightArgument{"--k-width", &RankingWeights::k_width, "Weight of the width term, k_sd"},
    WeightArgument{"--k-distortion", &RankingWeights::k_distortion,
                   "Weight of the distortion and geometry terms, k_sq"},
    WeightArgument{"--beta", &RankingWeights::beta, "Factor of the valence terms"},
    WeightArgument{"--min-width", &RankingWeights::min_width,
                   "Share of the narrowest place in the thickness, alpha_a"},
    WeightArgument{"--mean-width", &RankingWeights::mean_width,
                   "Share of the mean width in the thickness, alpha_b"},
    WeightArgument{"--distortion-threshold", &RankingWeights::distortion_threshold,
                   "Second difference of the shape metric that counts as distortion"}};

}  // namespace

void RankingArguments::add_to(CLI::App& app) {
  app.add_option("--ranking", ranking_,
                 "Order of the candidates: weighted, or thickness (the thinnest first)")
      ->check(CLI::IsMember(
          {std::string(name(Ranking::weighted)), std::string(name(Ranking::thickness))}))
      ->capture_default_str();
  add_weights_to(app);
}

void RankingArguments::add_weights_to(CLI::App& app) {
  app.add_option("--preset", preset_, "Weights of the ranking: octree or polycube meshes")
      ->check(CLI::IsMember({"octree", "polycube"}))
      ->capture_default_str();
  for (const WeightArgument& a : kWeights) {
    const double octree = octree_weights().*a.weight, polycube = polycube_weights().*a.weight;
    std::string defaults = " (default: " + CLI::detail::to_string(octree);
    if (polycube != octree) defaults += ", polycube " + CLI::detail::to_string(polycube);
    app.add_option_function<double>(
           a.name,
           [this, &a](const double& value) {
             changes_.emplace_back([&a, value](RankingWeights& w) { w.*a.weight = value; });
           },
           a.help + defaults + ")")
        ->group("Ranking");
  }
}

RankingWeights RankingArguments::weights() const {
  RankingWeights weights = preset_ == "polycube" ? polycube_weights() : octree_weights();
  for (const auto& change : changes_) change(weights);
  validate(weights);
  return weights;
}

Ranking RankingArguments::ranking() const {
  return ranking_ == name(Ranking::thickness) ? Ranking::thickness : Ranking::weighted;
}

void add_filter_options(CLI::App& app, SimplifyOptions& options) {
  app.add_option("--max-chord-deviation", options.max_chord_deviation,
                 "Valence error D(c) / 3k that a chord may leave behind")
      ->capture_default_str()
      ->group("Filters");
  add_valence_options(app, options.valence);
}

void add_valence_options(CLI::App& app, ValenceLimits& limits) {
  app.add_option("--min-interior-valence", limits.min_interior, "Fewest hexahedra at an inner edge")
      ->check(in_range(1, 100))
      ->capture_default_str()
      ->group("Filters");
  app.add_option("--max-interior-valence", limits.max_interior,
                 "Most hexahedra at an inner edge that merges, unless it has more already")
      ->check(in_range(1, 100))
      ->capture_default_str()
      ->group("Filters");
  app.add_option("--max-boundary-valence", limits.max_boundary,
                 "Most hexahedra at an edge of the boundary that merges")
      ->check(in_range(1, 100))
      ->capture_default_str()
      ->group("Filters");
  app.add_option(
         "--max-boundary-angle", limits.max_angle_deg,
         "Widest angle in degrees, between sides on the boundary, that a single hexahedron may "
         "come to fill; 360 allows all")
      ->check(in_range(1, 360))
      ->capture_default_str()
      ->group("Filters");
}

}  // namespace hexweft::cli
