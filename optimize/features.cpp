#include "optimize/features.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <Eigen/Geometry>

#include "optimize/bent_edges.h"
#include "ovm/errors.h"

namespace hexweft {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// Voxel-based meshers leave steps on smooth parts that are bent this much here and there, but not
// the lines they make on average.
constexpr double kAutomaticAngle = 40 * kDegree, kAutomaticMean = 60 * kDegree;

struct FeatureChain {
  FeatureLine line;
  std::vector<int> edges;
};

/// The feature edges as a graph, while it is being cleaned.
class FeatureGraph {
 public:
  FeatureGraph(const Eigen::Matrix3Xd& points, std::vector<BentEdge> edges, double angle)
      : points_(points), edges_(std::move(edges)), angle_(angle), at_(points.cols()) {
    for (int e = 0; e < static_cast<int>(edges_.size()); ++e) {
      for (int v : edges_[e].ends) at_[v].push_back(e);
      feature_.push_back(edges_[e].angle >= angle ? 1 : 0);
    }
  }

  void bridge_gaps();
  /// \param mean_angle  lines less bent than this on average are noise, rad
  void drop_noise(double mean_angle);
  SurfaceFeatures trace() const;

 private:
  int other_end(int e, int v) const {
    return edges_[e].ends[0] == v ? edges_[e].ends[1] : edges_[e].ends[0];
  }
  Eigen::Vector3d direction(int from, int to) const {
    return (points_.col(to) - points_.col(from)).normalized();
  }
  int degree(int v) const {
    return static_cast<int>(
        std::count_if(at_[v].begin(), at_[v].end(), [&](int e) { return feature_[e] != 0; }));
  }
  int next_feature(int v, int before) const {
    for (int e : at_[v]) {
      if (feature_[e] && e != before) return e;
    }
    return -1;
  }
  std::vector<int> chain_from(int v, int e) const;
  std::vector<int> way_on(int v, int e) const;
  void drop_weak(double mean_angle);
  bool drop_stubs();
  void drop_patches();
  bool is_corner(int v) const;
  std::vector<FeatureChain> chains(const std::vector<char>& end) const;

  const Eigen::Matrix3Xd& points_;
  std::vector<BentEdge> edges_;
  double angle_;
  std::vector<std::vector<int>> at_;  // edges at each point
  std::vector<char> feature_;         // by edge
};

/// The edges of a chain that starts with edge e at v, up to a point that is not on two feature
/// edges, or round to v.
std::vector<int> FeatureGraph::chain_from(int v, int e) const {
  std::vector<int> chain = {e};
  for (int w = other_end(e, v); w != v && degree(w) == 2; w = other_end(e, w)) {
    e = next_feature(w, e);
    chain.push_back(e);
  }
  return chain;
}

/// The edges by which the line that ends at v with edge e goes on to another line; empty if it
/// plainly does not.
std::vector<int> FeatureGraph::way_on(int v, int e) const {
  constexpr int kLongest = 4;
  constexpr double kWeak = 0.4;  // of the angle
  const double straight = std::cos(50 * kDegree);
  std::vector<int> way;
  Eigen::Vector3d along = direction(other_end(e, v), v);
  while (static_cast<int>(way.size()) < kLongest) {
    int best = -1;
    double best_score = 0;
    for (int next : at_[v]) {
      const double turn = along.dot(direction(v, other_end(next, v)));
      if (feature_[next] || edges_[next].angle < kWeak * angle_ || turn < straight) continue;
      if (const double score = turn * edges_[next].angle; score > best_score) {
        best = next;
        best_score = score;
      }
    }
    if (best < 0) return {};
    way.push_back(best);
    const int w = other_end(best, v);
    along = (along + direction(v, w)).normalized();
    v = w;
    if (degree(v) > 0) return way;
  }
  return {};
}

void FeatureGraph::bridge_gaps() {
  std::vector<int> found;
  for (int v = 0; v < static_cast<int>(at_.size()); ++v) {
    if (degree(v) != 1) continue;
    const std::vector<int> way = way_on(v, next_feature(v, -1));
    found.insert(found.end(), way.begin(), way.end());
  }
  for (int e : found) feature_[e] = 1;
}

/// Chains of a few edges that lead nowhere. \return whether there were any
bool FeatureGraph::drop_stubs() {
  constexpr std::size_t kShort = 4;
  bool dropped = false;
  for (int v = 0; v < static_cast<int>(at_.size()); ++v) {
    if (degree(v) != 1) continue;
    const std::vector<int> chain = chain_from(v, next_feature(v, -1));
    if (chain.size() >= kShort) continue;
    for (int e : chain) feature_[e] = 0;
    dropped = true;
  }
  return dropped;
}

/// Connected sets of a few edges; closed lines may be shorter.
void FeatureGraph::drop_patches() {
  constexpr std::size_t kSmall = 12, kSmallRing = 6;
  std::vector<char> seen(edges_.size(), 0);
  for (int first = 0; first < static_cast<int>(edges_.size()); ++first) {
    if (!feature_[first] || seen[first]) continue;
    std::vector<int> patch = {first};
    seen[first] = 1;
    for (std::size_t i = 0; i < patch.size(); ++i) {
      for (int v : edges_[patch[i]].ends) {
        for (int e : at_[v]) {
          if (!feature_[e] || seen[e]) continue;
          seen[e] = 1;
          patch.push_back(e);
        }
      }
    }
    const bool ring = std::all_of(patch.begin(), patch.end(), [&](int e) {
      return degree(edges_[e].ends[0]) == 2 && degree(edges_[e].ends[1]) == 2;
    });
    if (patch.size() >= (ring ? kSmallRing : kSmall)) continue;
    for (int e : patch) feature_[e] = 0;
  }
}

/// Chains between points where others meet, or that turn sharply.
void FeatureGraph::drop_weak(double mean_angle) {
  std::vector<char> end(at_.size(), 0), weak(edges_.size(), 0);
  for (int v = 0; v < static_cast<int>(at_.size()); ++v) end[v] = is_corner(v) ? 1 : 0;
  for (const FeatureChain& chain : chains(end)) {
    double sum = 0;
    for (int e : chain.edges) sum += edges_[e].angle;
    if (sum >= mean_angle * static_cast<double>(chain.edges.size())) continue;
    for (int e : chain.edges) weak[e] = 1;
  }
  for (std::size_t e = 0; e < edges_.size(); ++e) feature_[e] = feature_[e] && !weak[e] ? 1 : 0;
}

void FeatureGraph::drop_noise(double mean_angle) {
  const auto count = [&] { return std::count(feature_.begin(), feature_.end(), 1); };
  for (auto before = count() + 1; before > count();) {
    before = count();
    drop_weak(mean_angle);
    while (drop_stubs()) {
    }
  }
  drop_patches();
}

/// Where lines meet or end, or a line turns sharply, seen over two edges each way.
bool FeatureGraph::is_corner(int v) const {
  const double sharp = std::cos(50 * kDegree), at_all = std::cos(30 * kDegree);
  const int n = degree(v);
  if (n != 2) return n > 0;
  std::array<Eigen::Vector3d, 2> near, far;
  int e = -1;
  for (int k = 0; k < 2; ++k) {
    e = next_feature(v, e);
    const int w = other_end(e, v);
    near[k] = far[k] = direction(v, w);
    if (degree(w) != 2) continue;
    far[k] = direction(v, other_end(next_feature(w, e), w));
  }
  return -near[0].dot(near[1]) < at_all && -far[0].dot(far[1]) < sharp;
}

/// The feature edges cut at the marked points.
std::vector<FeatureChain> FeatureGraph::chains(const std::vector<char>& end) const {
  std::vector<FeatureChain> result;
  std::vector<char> used(edges_.size(), 0);
  const auto follow = [&](int start, int e) {
    FeatureChain chain;
    chain.line.points.push_back(start);
    for (int v = start;;) {
      used[e] = 1;
      chain.edges.push_back(e);
      v = other_end(e, v);
      if (v == start && !end[v]) break;
      chain.line.points.push_back(v);
      if (end[v]) break;
      e = next_feature(v, e);
    }
    chain.line.closed = !end[start];
    result.push_back(std::move(chain));
  };
  for (int v = 0; v < static_cast<int>(at_.size()); ++v) {
    if (!end[v]) continue;
    for (int e : at_[v]) {
      if (feature_[e] && !used[e]) follow(v, e);
    }
  }
  for (int e = 0; e < static_cast<int>(edges_.size()); ++e) {
    if (feature_[e] && !used[e]) follow(edges_[e].ends[0], e);
  }
  return result;
}

SurfaceFeatures FeatureGraph::trace() const {
  SurfaceFeatures features;
  std::vector<char> corner(at_.size(), 0);
  for (int v = 0; v < static_cast<int>(at_.size()); ++v) {
    corner[v] = is_corner(v) ? 1 : 0;
    if (corner[v]) features.corners.push_back(v);
  }
  for (FeatureChain& chain : chains(corner)) features.lines.push_back(std::move(chain.line));
  return features;
}

}  // namespace

void validate(const FeatureOptions& options) {
  if (!(options.angle_deg > 0 && options.angle_deg <= 180)) {
    throw InputError("angle_deg = " + std::to_string(options.angle_deg) + ", expected (0, 180]");
  }
}

SurfaceFeatures find_features(const Eigen::Matrix3Xd& points,
                              const std::vector<std::array<int, 3>>& triangles,
                              const FeatureOptions& options) {
  validate(options);
  if (options.mode == FeatureMode::off) return {};
  const bool automatic = options.mode == FeatureMode::automatic;
  const double angle = automatic ? kAutomaticAngle : options.angle_deg * kDegree;
  FeatureGraph graph(points, bent_edges(points, triangles), angle);
  graph.bridge_gaps();
  graph.drop_noise(automatic ? kAutomaticMean : 0);
  return graph.trace();
}

}  // namespace hexweft
