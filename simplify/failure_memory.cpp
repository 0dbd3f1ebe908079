#include "simplify/failure_memory.h"

#include <algorithm>

namespace hexweft {
namespace {

// What failed so often, each time after others had changed, is let go.
constexpr int kMostTries = 3;

// FNV-1a.
class Hash {
 public:
  void take(int x) { h_ = (h_ ^ static_cast<unsigned>(x)) * 1099511628211ull; }
  std::size_t value() const { return h_; }

 private:
  std::size_t h_ = 1469598103934665603ull;
};

std::size_t hash_of_group(const CollapsePlan& plan, int group) {
  Hash h;
  for (VertexHandle v : plan.group(group)) h.take(v.idx);
  return h.value();
}

// Of all groups: the two diagonals of a chord remove the same cells.
std::size_t hash_of(const CollapsePlan& plan, const std::vector<std::size_t>& groups) {
  Hash h;
  for (CellHandle c : plan.removed) h.take(c.idx);
  for (std::size_t g : groups) h.take(static_cast<int>(g ^ g >> 32));
  return h.value();
}

std::vector<std::size_t> hashes_of_groups(const CollapsePlan& plan) {
  std::vector<std::size_t> hashes(plan.n_groups());
  for (int g = 0; g < plan.n_groups(); ++g) hashes[g] = hash_of_group(plan, g);
  std::sort(hashes.begin(), hashes.end());
  return hashes;
}

// Of the cells at the vertices. An edit makes new cells or takes some away.
std::size_t hash_of_surroundings(const HexMesh& mesh, std::span<const VertexHandle> vertices) {
  std::vector<CellHandle> cells;
  for (VertexHandle v : vertices) {
    const auto at_vertex = mesh.cells(v);
    cells.insert(cells.end(), at_vertex.begin(), at_vertex.end());
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  Hash h;
  for (CellHandle c : cells) {
    h.take(c.idx);
    for (VertexHandle v : mesh.vertices(c)) h.take(v.idx);
  }
  return h.value();
}

}  // namespace

bool FailureMemory::Failure::should_wait(int now, bool patient) const {
  if (times >= kMostTries) return true;
  return now - step < (patient ? 1 << 2 * times : 1);
}

void FailureMemory::Failure::again(int now) {
  step = now;
  ++times;
}

bool FailureMemory::should_wait(const HexMesh& mesh, const CollapsePlan& plan, int step,
                                bool patient) const {
  if (failures_.empty()) return false;
  const std::vector<std::size_t> groups = hashes_of_groups(plan);
  const auto same = failures_.find(hash_of(plan, groups));
  if (same != failures_.end() && same->second.should_wait(step, patient)) return true;
  if (causes_.empty()) return false;
  const auto holds = [&](const Cause& c) {
    return c.failure.should_wait(step, patient) &&
           std::includes(groups.begin(), groups.end(), c.groups.begin(), c.groups.end()) &&
           hash_of_surroundings(mesh, c.members) == c.surroundings;
  };
  return std::any_of(groups.begin(), groups.end(), [&](std::size_t g) {
    const auto with_group = causes_.find(g);
    return with_group != causes_.end() &&
           std::any_of(with_group->second.begin(), with_group->second.end(), holds);
  });
}

void FailureMemory::failed(const HexMesh& mesh, const CollapsePlan& plan,
                           std::span<const int> cause, int step) {
  failures_[hash_of(plan, hashes_of_groups(plan))].again(step);
  if (cause.empty()) return;
  Cause c;
  for (int g : cause) {
    c.groups.push_back(hash_of_group(plan, g));
    const auto members = plan.group(g);
    c.members.insert(c.members.end(), members.begin(), members.end());
  }
  std::sort(c.groups.begin(), c.groups.end());
  c.surroundings = hash_of_surroundings(mesh, c.members);
  std::vector<Cause>& known = causes_[c.groups.front()];
  const auto same = std::find_if(known.begin(), known.end(),
                                 [&](const Cause& k) { return k.groups == c.groups; });
  Cause& kept = same != known.end() ? *same : known.emplace_back(std::move(c));
  if (same != known.end() && kept.surroundings != c.surroundings) {
    kept.surroundings = c.surroundings;
    kept.failure = {};
  }
  kept.failure.again(step);
}

void FailureMemory::forget_all() {
  failures_.clear();
  causes_.clear();
}

}  // namespace hexweft
