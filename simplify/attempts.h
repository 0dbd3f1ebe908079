/// \file
/// Several runs from the same mesh, of which the best is taken. What a run ends with hangs on early
/// steps that no ranking can tell apart: other weights, however near, lead elsewhere.
#pragma once

#include <chrono>

#include "optimize/reference_surface.h"
#include "simplify/options.h"
#include "simplify/report.h"

namespace hexweft {

/// What one run has come to.
struct Outcome {
  HexMesh mesh;
  SimplifyReport report;
};

/// The weights of an attempt: as they are for the first (0), else each times a factor between 2/3 and
/// 3/2 that only depends on the number of the attempt.
RankingWeights weights_of_attempt(const RankingWeights& weights, int attempt);

/// The outcome of the fewest components of SimplifyOptions::attempts runs, of those the one of the
/// highest mean scaled Jacobian, of those the first. Where one reaches the target that the options set,
/// it is taken and no later one is begun. Runs SimplifyOptions::threads at a time; the outcome does not
/// depend on that unless the run is stopped or out of time.
/// \param mesh       as simplify() takes it, without inverted cells
/// \param reference  the surface of the input
/// \param start      from when on the time of all together counts
/// \throws InputError if the base complex of the mesh is not regular
Outcome best_of_attempts(
    const HexMesh& mesh, const ReferenceSurface& reference, const SimplifyOptions& options,
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now());

}  // namespace hexweft
