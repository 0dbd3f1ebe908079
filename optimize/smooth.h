/// \file
/// Improves the geometry of a whole mesh without leaving the surface.
///
///     const SmoothingReport report = smooth(mesh, reference);
#pragma once

#include <optional>
#include <stop_token>

#include "optimize/local_parametrization.h"

namespace hexweft {

struct SmoothingOptions {
  double hausdorff_limit_rel = 0.01;  ///< > 0, fraction of the reference's bounding-box diagonal
  int cycles = 2;          ///< > 0, of all the passes below; the next only if the last gained
  int global_rounds = 3;   ///< ≥ 0, passes over the whole mesh for the least scaled Jacobian
  int mean_rounds = 2;     ///< ≥ 0, passes over the whole mesh for the mean
  int local_trials = 200;  ///< ≥ 0, passes over the neighborhood of a worst cell
  double enough_scaled_jacobian =
      0.7;  ///< [0, 1], cells at least this good are not worked on one by one
  /// (0, 1], the share of the surface's weight that is left where the surface gives way for the worst
  /// cells: more keeps the mesh nearer to it, with less they get better
  double giving_way = 0.03;
  ParametrizationOptions parametrization = {.surface = {.treatment = SurfaceTreatment::fit}};
  /// ≥ 0, what the distance at the start is known not to be over, as hausdorff_limit_rel; unset: it is
  /// measured, which takes a tenth of the time
  std::optional<double> initial_hausdorff_rel = {};
  std::stop_token stop = {};  ///< ends after the pass at hand
};
void validate(const SmoothingOptions& options);  ///< \throws InputError

struct SmoothingReport {
  double initial_min_scaled_jacobian = 1, min_scaled_jacobian = 1;
  double initial_mean_scaled_jacobian = 1, mean_scaled_jacobian = 1;
  double initial_hausdorff_rel = 0;  ///< hausdorff_ratio() for the limit, or as it was given
  double hausdorff_rel = 0;          ///< hausdorff_ratio() for the limit
  int accepted_global = 0, accepted_local = 0, trials = 0;
};

/// First the whole mesh is relaxed, then the neighborhoods of its worst cells, worst first, then the
/// whole mesh for the mean; that is a cycle. The default energy is taken in a sharper form over the
/// whole mesh. Of a pass is kept what lowers no hexahedron below the least scaled Jacobian (of the
/// mesh; of the neighborhood for a local one), and no part of the surface over the Hausdorff limit or
/// over what the distance was if that is more; a pass that then gains nothing is undone. Ends when
/// nothing gains; no pass for the mean is begun where the gains of the last two, extended, are too
/// small. An inverted mesh is untangled if it can be.
SmoothingReport smooth(HexMesh& mesh, const ReferenceSurface& reference,
                       const SmoothingOptions& options = {});

}  // namespace hexweft
