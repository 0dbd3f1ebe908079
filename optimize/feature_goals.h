/// \file
/// Where vertices that stand for a feature go: corners to theirs, chains of edges to their line.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "optimize/feature_assignment.h"
#include "optimize/region.h"
#include "optimize/surface_constraint.h"

namespace hexweft {

/// The goal of a vertex at p. \pre label.is_any()
SurfaceGoal goal_on_feature(const FeatureCurves& curves, const FeatureLabel& label, int vertex,
                            const Eigen::Vector3d& p);

/// Takes the vertices on curved lines half way to where the line is between them, so that the chain
/// of edges errs as much outward at its vertices as inward at its middles.
/// \param labels  of the region's vertices
/// \param goals   of goal_on_feature() where a vertex stands for a feature
void fit_lines(const Region& region, const FeatureCurves& curves,
               const std::vector<FeatureLabel>& labels, std::vector<SurfaceGoal>& goals);

}  // namespace hexweft
