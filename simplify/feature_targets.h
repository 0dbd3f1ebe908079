/// \file
/// What sharp features of the surface mean to a collapse: where merged vertices go, which base edges
/// are on them.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "optimize/feature_assignment.h"
#include "simplify/collapse_plan.h"

namespace hexweft {

/// As default_targets(), but a group with a corner goes to the corner, one with vertices on a
/// feature line to the line.
/// \param labels  of the vertices before the collapse, by handle; feature_of()
/// \return empty if a group has two corners, two lines, or a corner and a line that does not end
///         there: such a collapse would do away with a feature (spec, "Collapse")
std::optional<std::vector<Eigen::Vector3d>> feature_targets(const HexMesh& mesh,
                                                            const SingularityGraph& graph,
                                                            const CollapsePlan& plan,
                                                            std::span<const FeatureLabel> labels,
                                                            const FeatureCurves& curves);

/// By base edge, whether it runs along a feature line.
/// \param labels  by vertex handle; feature_of()
std::vector<char> base_edges_on_features(const BaseComplex& bc,
                                         std::span<const FeatureLabel> labels);

}  // namespace hexweft
