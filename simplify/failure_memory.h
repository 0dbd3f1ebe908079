/// \file
/// What is known of earlier failures of the loop.
#pragma once

#include <cstddef>
#include <span>
#include <unordered_map>
#include <vector>

#include "simplify/collapse_plan.h"

namespace hexweft {

/// Remembers which collapses failed, and where. A collapse that failed waits for a growing number of
/// accepted steps before it is tried again, and after several failures until it has become another.
/// So does every other collapse that makes the same merges in the same surroundings as those that a
/// failure was put down to: a sheet that has changed at its far end fails where it failed before.
class FailureMemory {
 public:
  /// \param mesh  as it was when the plan was made
  bool should_wait(const HexMesh& mesh, const CollapsePlan& plan, int step, bool patient) const;
  /// \param cause  the groups of the plan round the place where it failed; none: the whole plan
  void failed(const HexMesh& mesh, const CollapsePlan& plan, std::span<const int> cause, int step);
  void forget_all();

 private:
  struct Failure {
    int step = 0, times = 0;
    bool should_wait(int now, bool patient) const;
    void again(int now);
  };
  struct Cause {
    std::vector<std::size_t> groups;    // hashes, ascending
    std::vector<VertexHandle> members;  // of these groups
    std::size_t surroundings;           // hash
    Failure failure;
  };

  std::unordered_map<std::size_t, Failure> failures_;           // by plan
  std::unordered_map<std::size_t, std::vector<Cause>> causes_;  // by the least of their groups
};

}  // namespace hexweft
