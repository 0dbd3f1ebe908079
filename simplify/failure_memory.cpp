#include "simplify/failure_memory.h"

#include <algorithm>
#include <cmath>

#include "simplify/hash.h"

namespace hexweft {
namespace {

// What failed so often, each time after others had changed, is let go.
constexpr int kMostTries = 3;

std::size_t hash_of_group(const HexMesh& mesh, const CollapsePlan& plan, int group) {
  Hash h;
  for (VertexHandle v : plan.group(group)) h.take(mesh.serial(v));
  return h.value();
}

std::vector<std::size_t> hashes_of_groups(const HexMesh& mesh, const CollapsePlan& plan) {
  std::vector<std::size_t> hashes(plan.n_groups());
  for (int g = 0; g < plan.n_groups(); ++g) hashes[g] = hash_of_group(mesh, plan, g);
  std::sort(hashes.begin(), hashes.end());
  return hashes;
}

// Of the cells at the vertices.
std::size_t hash_of_surroundings(const HexMesh& mesh, std::span<const VertexHandle> vertices) {
  std::size_t sum = 0;
  for (VertexHandle v : vertices) {
    for (CellHandle c : mesh.cells(v)) sum += hash_of_cell(mesh, c);
  }
  return sum;
}

}  // namespace

bool FailureMemory::Waiting::is_over(int now, bool patient) const {
  return times < kMostTries && now - step >= (patient ? 1 << 2 * times : 1);
}

void FailureMemory::Waiting::again(int now) {
  step = now;
  ++times;
}

bool FailureMemory::should_wait(const CandidateKey& key, int step, bool patient) {
  const auto known = failures_.find(key.itself);
  if (known == failures_.end()) return false;
  Failure& f = known->second;
  if (!f.waiting.is_over(step, patient)) return true;
  if (!f.of_connectivity || f.surroundings != key.surroundings) return false;
  f.waiting.again(step);
  return true;
}

void FailureMemory::failed(const CandidateKey& key, Refusal refusal, int step) {
  Failure& f = failures_[key.itself];
  f.of_connectivity = is_of_connectivity(refusal);
  f.surroundings = key.surroundings;
  f.waiting.again(step);
}

void FailureMemory::failed_at(const HexMesh& mesh, const CollapsePlan& plan,
                              std::span<const int> cause, int step) {
  if (cause.empty()) return;
  Cause c;
  for (int g : cause) {
    c.groups.push_back(hash_of_group(mesh, plan, g));
    const auto members = plan.group(g);
    c.members.insert(c.members.end(), members.begin(), members.end());
  }
  std::sort(c.groups.begin(), c.groups.end());
  c.surroundings = hash_of_surroundings(mesh, c.members);
  std::vector<Cause>& known = causes_[c.groups.front()];
  const auto same = std::find_if(known.begin(), known.end(),
                                 [&](const Cause& k) { return k.groups == c.groups; });
  if (same == known.end()) {
    known.push_back(std::move(c));
    known.back().waiting.again(step);
    return;
  }
  if (same->surroundings != c.surroundings) same->waiting = {};
  same->surroundings = c.surroundings;
  same->waiting.again(step);
}

bool FailureMemory::has_cause(const HexMesh& mesh, const CollapsePlan& plan, int step,
                              bool patient) const {
  if (causes_.empty()) return false;
  const std::vector<std::size_t> groups = hashes_of_groups(mesh, plan);
  const auto holds = [&](const Cause& c) {
    return !c.waiting.is_over(step, patient) &&
           std::includes(groups.begin(), groups.end(), c.groups.begin(), c.groups.end()) &&
           hash_of_surroundings(mesh, c.members) == c.surroundings;
  };
  return std::any_of(groups.begin(), groups.end(), [&](std::size_t g) {
    const auto with_group = causes_.find(g);
    return with_group != causes_.end() &&
           std::any_of(with_group->second.begin(), with_group->second.end(), holds);
  });
}

void FailureMemory::failed_with(const Outlook& outlook, Refusal refusal) {
  // What is negligible counts as 0, wherever it is.
  if (outlook.distance_rel > 0 && is_geometric(refusal))
    outcomes_.insert({outlook.distance_rel, {outlook.least, refusal}});
}

Refusal FailureMemory::refusal_with(const Outlook& outlook) const {
  constexpr double kSame = 1e-4;
  const double d = outlook.distance_rel;
  for (auto it = outcomes_.lower_bound(d - kSame); it != outcomes_.end() && it->first <= d + kSame;
       ++it) {
    if (std::abs(it->second.least - outlook.least) <= kSame) return it->second.refusal;
  }
  return Refusal::none;
}

void FailureMemory::renumber(const Renumbering& now) {
  const auto lost_a_member = [](const Cause& c) {
    return std::any_of(c.members.begin(), c.members.end(),
                       [](VertexHandle v) { return !v.valid(); });
  };
  for (auto& [group, causes] : causes_) {
    for (Cause& c : causes) {
      for (VertexHandle& v : c.members) v = now[v];
    }
    std::erase_if(causes, lost_a_member);
  }
  std::erase_if(causes_, [](const auto& known) { return known.second.empty(); });
}

void FailureMemory::forget_all() {
  outcomes_.clear();
  failures_.clear();
  causes_.clear();
}

}  // namespace hexweft
