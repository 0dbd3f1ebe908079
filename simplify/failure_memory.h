/// \file
/// What is known of earlier failures of the loop.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <unordered_map>
#include <vector>

#include "simplify/candidate_key.h"
#include "simplify/collapse_plan.h"
#include "simplify/trial.h"

namespace hexweft {

/// Remembers which collapses failed, and where. A collapse that failed waits for a growing number of
/// accepted steps before it is tried again, and after several failures until it has become another.
/// So does every other collapse that makes the same merges in the same surroundings as those that a
/// failure was put down to: a sheet that has changed at its far end fails where it failed before.
class FailureMemory {
 public:
  /// Where the connectivity was at fault and still is the same, another failure is taken for granted.
  bool should_wait(const CandidateKey& key, int step, bool patient);
  void failed(const CandidateKey& key, Refusal refusal, int step);

  /// \param mesh   as it was when the plan was made
  /// \param cause  the groups of the plan round the place where it failed
  void failed_at(const HexMesh& mesh, const CollapsePlan& plan, std::span<const int> cause,
                 int step);
  /// Whether the plan has the cause of a failure that waits.
  bool has_cause(const HexMesh& mesh, const CollapsePlan& plan, int step, bool patient) const;

  /// \param outlook  of a trial that failed for its geometry
  void failed_with(const Outlook& outlook, Refusal refusal);
  /// What a trial failed by whose outlook was all but the same, or Refusal::none. It was of the same
  /// merge: where sheets were split beside it, its key has changed and its chances have not.
  Refusal refusal_with(const Outlook& outlook) const;

  /// After HexMesh::collect_garbage(). What vertices that are gone had a part in cannot come again.
  void renumber(const Renumbering& now);
  void forget_all();

 private:
  struct Waiting {
    int step = 0, times = 0;
    bool is_over(int now, bool patient) const;
    void again(int now);
  };
  struct Failure {
    bool of_connectivity = false;
    std::size_t surroundings = 0;
    Waiting waiting;
  };
  struct Cause {
    std::vector<std::size_t> groups;    // hashes, ascending
    std::vector<VertexHandle> members;  // of these groups
    std::size_t surroundings;           // hash
    Waiting waiting;
  };

  struct Outcome {
    double least;
    Refusal refusal;
  };

  std::multimap<double, Outcome> outcomes_;                     // by Outlook::distance_rel
  std::unordered_map<std::size_t, Failure> failures_;           // by CandidateKey::itself
  std::unordered_map<std::size_t, std::vector<Cause>> causes_;  // by the least of their groups
};

}  // namespace hexweft
