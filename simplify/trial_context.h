/// \file
/// What the trials of a run share: the mesh, its surface and how far it is, and the limits.
#pragma once

#include <optional>
#include <vector>

#include "optimize/feature_assignment.h"
#include "optimize/reference_surface.h"
#include "optimize/surface_distance.h"
#include "ovm/topology_summary.h"
#include "ovm/transaction.h"
#include "simplify/profile.h"

namespace hexweft {

/// Of the distance limit: what is below that counts as none where a run can do without the difference.
inline constexpr double kNegligible = 0.2;

/// What the trials of a run share. The mesh and its distance always belong together.
struct TrialContext {
  HexMesh& mesh;
  const ReferenceSurface& reference;
  SurfaceDistance& distance;
  TopologySummary shape;  ///< of the input: genus and parts that every state must have
  double distance_limit;  ///< model units, at the sampling of `distance`
  double final_limit;     ///< model units, at full sampling
  /// Up to so many cells trials may split sheets, and up to what there was before the collapse.
  int most_cells = 0;
  StageClock* clock = nullptr;  ///< told of the stages of a trial, if any
  /// Features of the mesh's vertices, once they have been asked for. Like the graph that
  /// try_collapse_locally() is given they may be out of date where the mesh has changed since. To be
  /// reset after edits that add vertices, and after HexMesh::collect_garbage(); try_refine() does so.
  std::optional<std::vector<FeatureLabel>> labels = {};
  NearLines near_lines = {};  ///< where the features were asked for
  const std::vector<FeatureLabel>& feature_labels();
};

/// Makes an accepted change of the mesh and its distance final.
void commit(TrialContext& context, Transaction& change);

}  // namespace hexweft
