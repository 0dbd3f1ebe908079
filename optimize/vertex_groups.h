/// \file
/// Groups of vertices that share one place, as those that are about to be merged: one variable each.
#pragma once

#include <vector>

#include "optimize/relaxation.h"

namespace hexweft {

/// A problem in which every group is one vertex.
struct GroupedProblem {
  RelaxationProblem problem;   ///< without groups
  std::vector<int> merged_of;  ///< the vertex of `problem` each original vertex has become
};

/// A group starts at the mean of its members; one with a fixed member is fixed there. Groups that
/// share a vertex are one. Hexahedra that lose their volume by it are the caller's to leave out.
/// \throws InputError for a vertex that does not exist, or a group with fixed vertices in two places
GroupedProblem merge_groups(const RelaxationProblem& problem);

/// Writes the places found to all members. \param points  3 × #original vertices
void spread_groups(const GroupedProblem& grouped, Eigen::Matrix3Xd& points);

}  // namespace hexweft
