/// \file
/// The order in which sheets and chords are looked at: low energy goes first. Source [Xu2021, §5]
/// with the corrections of spec.md.
#pragma once

#include <string_view>
#include <vector>

#include "simplify/chord.h"
#include "simplify/sheet.h"

namespace hexweft {

/// By what candidates are ordered.
enum class Ranking {
  weighted,  ///< the weighted sum of valence, width and distortion [Xu2021]
  thickness  ///< how thick they are, the thinnest first: the order of [Gao2017]
};
constexpr std::string_view name(Ranking ranking) {
  return ranking == Ranking::weighted ? "weighted" : "thickness";
}

/// Weights and constants of the ranking terms.
struct RankingWeights {
  double k_valence = 0.4;              ///< k_sv
  double k_width = 0.6;                ///< k_sd
  double k_distortion = 0.2;           ///< k_sq
  double beta = 1.67;                  ///< of the valence terms
  double min_width = 0.7;              ///< alpha_a, share of the narrowest place in the thickness
  double mean_width = 0.3;             ///< alpha_b, share of the mean thickness
  double distortion_threshold = 0.55;  ///< second difference of the shape metric that counts
};
inline RankingWeights octree_weights() { return {}; }
inline RankingWeights polycube_weights() { return {.k_valence = 0.3, .k_width = 0.7}; }

/// The terms of E_s(s); all dimensionless.
struct SheetTerms {
  double thickness = 0;   ///< alpha_a least + alpha_b mean length across, in mean edge lengths
  double valence = 0;     ///< E_sv <= 1, smaller the more singular edges would go
  double width = 0;       ///< E_sd > 0, the cube root of the thickness
  double distortion = 1;  ///< E_sq in (0, 1]
  double energy = 0;      ///< E_s
  double cost(Ranking ranking) const { return ranking == Ranking::weighted ? energy : thickness; }
};

/// The terms of E_c(c).
struct ChordTerms {
  /// alpha_a least + alpha_b mean length of the diagonals that fold, in mean edge lengths
  double thickness = 0;
  double valence = 0;    ///< E_cv >= 0
  double geometry = 0;   ///< E_cq >= 0
  double energy = 0;     ///< E_c
  double deviation = 0;  ///< D(c) / 3k, the mean valence error of what would be left
  Diagonal diagonal = Diagonal::first;
  int singular_groups =
      0;  ///< of the four groups of parallel base edges, those with singular edges
  double cost(Ranking ranking) const { return ranking == Ranking::weighted ? energy : thickness; }
};

/// Per cell: the largest second difference of the shape metric along the three directions (Eq. 9).
/// Indexed by cell handle. Cost O(#cells).
std::vector<double> shape_differences(const HexMesh& mesh);

/// One entry a sheet. Cost O(#cells + #B_E).
std::vector<SheetTerms> rank_sheets(const HexMesh& mesh, const BaseComplex& bc,
                                    const std::vector<Sheet>& sheets,
                                    const RankingWeights& weights);

/// \param curvature  Gaussian curvature by vertex handle (0 inside)
std::vector<ChordTerms> rank_chords(const HexMesh& mesh, const BaseComplex& bc,
                                    const std::vector<Chord>& chords,
                                    const std::vector<double>& curvature,
                                    const RankingWeights& weights);

/// \throws InputError, one sentence, unless every weight is finite and at least 0 and the shares of
/// the thickness are not both 0
void validate(const RankingWeights& weights);

/// Angle deficit over a quarter of the area of the surrounding boundary quadrilaterals, by vertex
/// handle; 0 inside. Unit 1 / length². Cost O(#cells).
std::vector<double> boundary_gaussian_curvature(const HexMesh& mesh);

}  // namespace hexweft
