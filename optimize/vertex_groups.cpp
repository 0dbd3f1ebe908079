#include "optimize/vertex_groups.h"

#include <string>

#include "ovm/detail/disjoint_sets.h"
#include "ovm/errors.h"

namespace hexweft {
namespace {

/// The least member of every vertex's group.
std::vector<int> group_leaders(const RelaxationProblem& problem) {
  const int n = static_cast<int>(problem.points.cols());
  detail::DisjointSets sets(n);
  for (const std::vector<int>& group : problem.groups) {
    for (int v : group) {
      if (v < 0 || v >= n)
        throw InputError("vertex " + std::to_string(v) + " of a group is unknown");
      sets.join(group[0], v);
    }
  }
  std::vector<int> leader;
  for (int v = 0; v < n; ++v) leader.push_back(sets.find(v));
  return leader;
}

/// Mean place of every group, or the place of its fixed members, in the column of its leader.
Eigen::Matrix3Xd group_places(const RelaxationProblem& problem, const std::vector<int>& leader,
                              std::vector<bool>& fixed) {
  const Eigen::Index n = problem.points.cols();
  Eigen::Matrix3Xd places = Eigen::Matrix3Xd::Zero(3, n);
  std::vector<int> members(n, 0);
  for (Eigen::Index v = 0; v < n; ++v) {
    places.col(leader[v]) += problem.points.col(v);
    ++members[leader[v]];
  }
  for (Eigen::Index v = 0; v < n; ++v) {
    if (members[v] > 1) places.col(v) /= members[v];
  }
  for (Eigen::Index v = problem.n_free; v < n; ++v) {
    const int g = leader[v];
    if (fixed[g] && places.col(g) != problem.points.col(v)) {
      throw InputError("a group has fixed vertices in two places");
    }
    places.col(g) = problem.points.col(v);
    fixed[g] = true;
  }
  return places;
}

}  // namespace

GroupedProblem merge_groups(const RelaxationProblem& problem) {
  const std::vector<int> leader = group_leaders(problem);
  const int n = static_cast<int>(problem.points.cols());
  std::vector<bool> fixed(n, false);
  const Eigen::Matrix3Xd places = group_places(problem, leader, fixed);
  GroupedProblem grouped;
  std::vector<int> leaders, number(n, -1);  // free ones first
  for (const bool want_fixed : {false, true}) {
    for (int v = 0; v < n; ++v) {
      if (leader[v] != v || fixed[v] != want_fixed) continue;
      number[v] = static_cast<int>(leaders.size());
      leaders.push_back(v);
    }
    if (!want_fixed) grouped.problem.n_free = static_cast<int>(leaders.size());
  }
  RelaxationProblem& merged = grouped.problem;
  merged.points.resize(3, static_cast<Eigen::Index>(leaders.size()));
  for (std::size_t i = 0; i < leaders.size(); ++i) {
    merged.points.col(static_cast<Eigen::Index>(i)) = places.col(leaders[i]);
  }
  for (int v = 0; v < n; ++v) grouped.merged_of.push_back(number[leader[v]]);
  merged.hexes = problem.hexes;
  for (HexCorners& hex : merged.hexes) {
    for (int& v : hex) v = grouped.merged_of[v];
  }
  merged.targets = problem.targets;
  merged.stay_valid = problem.stay_valid;
  for (VertexPull pull : problem.pulls) {
    pull.vertex = grouped.merged_of[pull.vertex];
    if (pull.vertex < merged.n_free) merged.pulls.push_back(pull);
  }
  return grouped;
}

void spread_groups(const GroupedProblem& grouped, Eigen::Matrix3Xd& points) {
  for (std::size_t v = 0; v < grouped.merged_of.size(); ++v) {
    points.col(static_cast<Eigen::Index>(v)) = grouped.problem.points.col(grouped.merged_of[v]);
  }
}

}  // namespace hexweft
