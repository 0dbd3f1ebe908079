/// \file
/// The geometry of one collapse, after the edit: relaxing what lies round it until the elements are
/// good and the surface is met, or it is clear that they will not be.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "simplify/trial.h"

namespace hexweft {

struct RegionResult {
  Refusal refusal = Refusal::none;
  std::optional<Eigen::Vector3d> failed_at = {};  ///< if it is due to a single place
  Quality quality = {};                           ///< of the region, if it succeeded
};

/// That of the options, with little untangling: a trial that needs more hardly ever succeeds.
ParametrizationOptions trial_parametrization(const SimplifyOptions& options);

/// How many rings of cells move round what is collapsed.
int rings_round(const CollapsePlan& plan, const SimplifyOptions& options);

/// Parametrizes the cells round the merged vertices within the open transaction of a trial. A step
/// may lower the quality of its region to the floors of the options, but where it was under them
/// already, not any further. Where only the distance is too large and
/// SimplifyOptions::splits_per_trial allows it, sheets are split across the place that is farthest.
/// The distance of the context is then that of the new mesh, to be committed or rolled back; on a
/// refusal it is as before.
/// \param merged  the vertices that are left of those merged, and others round which it is to move
/// \param gone    cells that were removed
/// \param old     quality of the region before the edit
/// \param outlook what the edit has left
RegionResult relax_region(TrialContext& context, const CollapsePlan& plan,
                          std::span<const VertexHandle> merged, std::span<const CellHandle> gone,
                          const Quality& old, const Outlook& outlook,
                          const SimplifyOptions& options);

}  // namespace hexweft
