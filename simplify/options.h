/// \file
/// The options of the simplification: the only home of its defaults.
#pragma once

#include <functional>
#include <optional>
#include <stop_token>

#include "optimize/local_parametrization.h"
#include "simplify/plan_check.h"
#include "simplify/progress.h"
#include "simplify/rank.h"

namespace hexweft {

struct RunState;  // checkpoint.h

/// Before any ordinary trial these are made, with higher floors of quality: poor hexahedra early on
/// lock up what could go later.
struct CarefulTrials {
  bool wanted = true;
  double min_scaled_jacobian = 0.2;   ///< as in SimplifyOptions, where that is not higher
  double mean_scaled_jacobian = 0.8;  ///< as in SimplifyOptions, where that is not higher
};

/// Where no ordinary trial succeeds, bold ones are made: the ValenceLimits are wider, and sheets are
/// split within the trial where the surface is left too far away.
struct BoldTrials {
  bool wanted = true;
  double max_angle_deg = 360;    ///< as in ValenceLimits
  int max_interior_valence = 8;  ///< > 2, as in ValenceLimits; what it unlocks may lower it again
  int splits_per_trial = 12;     ///< as in SimplifyOptions
  double merged_give_up_factor = 4;  ///< as in SimplifyOptions
  double max_chord_deviation = 1.2;  ///< as in SimplifyOptions, where that is not higher
};

/// When to stop simplifying and what to preserve.
struct SimplifyOptions {
  Ranking ranking = Ranking::weighted;  ///< by what the candidates are ordered
  RankingWeights weights = octree_weights();
  bool chords = true;  ///< collapse chords between sheets
  bool coarsen =
      true;  ///< first take layers out of sheets that have several and do without (coarsen.h);
             ///< where that made it short of cells, the loop goes on when they are back
  bool peels = true;  ///< take sheets off single faces where no sheet or chord can be collapsed
  bool pillows =
      true;  ///< then collapse sheets with pillows beside what is in their way (pillow.h)

  double hausdorff_limit_rel = 0.01;  ///< (0, 1], of the input's bounding-box diagonal, both ways
  double min_scaled_jacobian = 0.1;   ///< [0, 1); a step may not leave its region below both this
                                      ///< and what it found there
  double mean_scaled_jacobian = 0.7;  ///< [0, 1); the same for the mean over the region
  double target_hexahedra_rel =
      1.0;  ///< (0, 1000], of the input's count; below it sheets are refined
  /// > 0, rings of cells that move round the collapse of a layer; round that of several two more
  int rings = 3;
  /// > 0, runs from the input, of which the outcome of the fewest components is taken (attempts.h)
  int attempts = 1;
  /// > 0, attempts at a time; a single one uses two, for the two directions of distance checks at
  /// full sampling
  int threads = 1;
  bool smooth = true;  ///< global smoothing at the end, from which the loop may go on
  int smoothing_trials =
      400;  ///< >= 0, passes over the neighbourhoods of the worst cells then, in each of two cycles
  /// > 0, candidates whose trials succeed and of which the one goes first that is worth most: components
  /// gone for the distance and the quality spent
  int compare = 1;
  double give_up_factor = 1.5;       ///< >= 1; half relaxed and so many limits away, a trial ends
  double merged_give_up_factor = 2;  ///< >= 1; the same before anything has moved
  /// >= 0, sheets that a collapse may split where it leaves the surface too far away, two a layer and
  /// two more at most; H stays under 1.1 times the target, or what it was before the collapse. Trials
  /// that may split are also given more iterations to reach the floors of quality
  int splits_per_trial = 0;
  double max_chord_deviation = 0.9;  ///< > 0, D(c) / 3k of a chord that is tried
  ValenceLimits valence = {};
  CarefulTrials careful = {};
  BoldTrials bold = {};
  FeatureOptions features = {};  ///< sharp edges and corners of the input's surface that are held
  ParametrizationOptions parametrization = {.max_iterations = 4,
                                            .surface = {.treatment = SurfaceTreatment::fit}};

  int max_failed_trials = 60;  ///< > 0, stop after so many parametrizations failed in a row
  std::optional<double> target_rate = {};     ///< [0, 1], stop at R = 1 - BC / BC_in
  std::optional<int> target_components = {};  ///< > 0, stop at so many
  /// > 0; after so long nothing more is begun, the smoothing at the end neither
  std::optional<double> max_seconds = {};
  std::stop_token stop =
      {};  ///< ends the run within a step, as max_seconds does; the mesh is valid
  /// Called after every accepted change. What it is told takes a pass over the mesh.
  std::function<void(const SimplifyProgress&)> observer = {};
  /// Called now and then, and when the loop has ended, with what resume_simplify() needs.
  std::function<void(const HexMesh&, const RunState&)> checkpoint = {};
  double checkpoint_every_s = 5;  ///< >= 0, not more often than that
};

/// \throws InputError, one sentence that names the option, its value and what was expected
void validate(const SimplifyOptions& options);

}  // namespace hexweft
