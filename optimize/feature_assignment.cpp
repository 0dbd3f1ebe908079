#include "optimize/feature_assignment.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>
#include <tuple>
#include <utility>

#include <Eigen/Geometry>

#include "optimize/feature_curves.h"
#include "ovm/hex_mesh.h"

namespace hexweft {
namespace {

constexpr double kReach = 0.75;  // of a vertex's mean edge length: how far its lines may be

struct PatchEdge {
  int to;
  double length;
  bool bent;  // the quads at it differ in direction
};

/// The edges of a set of quads, by vertex.
class PatchGraph {
 public:
  PatchGraph(const Eigen::Matrix3Xd& points, std::span<const std::array<int, 4>> quads);
  std::span<const PatchEdge> edges(int v) const {
    return {edges_.data() + first_[v], edges_.data() + first_[v + 1]};
  }
  double mean_length(int v) const { return mean_[v]; }  ///< 0 for a vertex of no quad

 private:
  std::vector<int> first_;
  std::vector<PatchEdge> edges_;
  std::vector<double> mean_;
};

PatchGraph::PatchGraph(const Eigen::Matrix3Xd& points, std::span<const std::array<int, 4>> quads)
    : first_(points.cols() + 1, 0), mean_(points.cols(), 0) {
  const double bent = std::cos(25 * std::numbers::pi / 180);
  std::vector<std::tuple<int, int, int>> sides;  // from, to, quad; both ways
  std::vector<Eigen::Vector3d> normals;
  for (const auto& q : quads) {
    const auto id = static_cast<int>(normals.size());
    const Eigen::Vector3d d1 = points.col(q[2]) - points.col(q[0]);
    const Eigen::Vector3d d2 = points.col(q[3]) - points.col(q[1]);
    normals.push_back(d1.cross(d2).normalized());
    for (int k = 0; k < 4; ++k) {
      sides.emplace_back(q[k], q[(k + 1) % 4], id);
      sides.emplace_back(q[(k + 1) % 4], q[k], id);
    }
  }
  std::sort(sides.begin(), sides.end());
  for (std::size_t i = 0, next = 0; i < sides.size(); i = next) {
    const auto& [from, to, quad] = sides[i];
    for (next = i + 1; next < sides.size() && std::get<0>(sides[next]) == from;) {
      if (std::get<1>(sides[next]) != to) break;
      ++next;
    }
    const bool pair = next == i + 2;
    const double length = (points.col(to) - points.col(from)).norm();
    edges_.push_back(
        {to, length, pair && normals[quad].dot(normals[std::get<2>(sides[i + 1])]) < bent});
    mean_[from] += length;
    ++first_[from + 1];
  }
  for (std::size_t v = 0; v + 1 < first_.size(); ++v) {
    if (first_[v + 1] > 0) mean_[v] /= first_[v + 1];
    first_[v + 1] += first_[v];
  }
}

/// A vertex a line is sure to pass through.
struct Anchor {
  double at;  // arc length
  int vertex;
  friend auto operator<=>(const Anchor&, const Anchor&) = default;
};

class Assignment {
 public:
  Assignment(const Eigen::Matrix3Xd& points, std::span<const std::array<int, 4>> quads, int n_free,
             const FeatureCurves& curves)
      : points_(points),
        n_free_(n_free),
        curves_(curves),
        graph_(points, quads),
        near_(points.cols()),
        labels_(points.cols()) {}

  std::vector<FeatureLabel> run();

 private:
  bool find_near_lines();
  void claim_corners();
  const CurvePoint* near(int v, int line) const;
  bool follows(int v, int line) const;
  std::vector<Anchor> anchors(int line) const;
  void add_anchors_of_loop(int line, std::vector<Anchor>& anchors) const;
  void follow(int line);
  std::vector<int> path(int line, const Anchor& from, const Anchor& to) const;

  const Eigen::Matrix3Xd& points_;
  int n_free_;
  const FeatureCurves& curves_;
  PatchGraph graph_;
  std::vector<std::vector<CurvePoint>> near_;  // lines near each vertex
  std::vector<FeatureLabel> labels_;
};

bool Assignment::find_near_lines() {
  bool any = false;
  for (int v = 0; v < points_.cols(); ++v) {
    if (graph_.mean_length(v) == 0) continue;
    near_[v] = curves_.within(points_.col(v), kReach * graph_.mean_length(v));
    any |= !near_[v].empty();
  }
  return any;
}

const CurvePoint* Assignment::near(int v, int line) const {
  const auto at = std::find_if(near_[v].begin(), near_[v].end(),
                               [&](const CurvePoint& c) { return c.line == line; });
  return at == near_[v].end() ? nullptr : &*at;
}

/// Nearest pairs first, each corner and each vertex once.
void Assignment::claim_corners() {
  const auto n = static_cast<int>(curves_.features().corners.size());
  std::vector<std::tuple<double, int, int>> pairs;  // distance, corner, vertex
  for (int v = 0; v < points_.cols(); ++v) {
    if (near_[v].empty()) continue;
    for (int c = 0; c < n; ++c) {
      const double d = (curves_.corner(c) - points_.col(v)).norm();
      if (d <= kReach * graph_.mean_length(v)) pairs.emplace_back(d, c, v);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  std::vector<char> claimed(n, 0);
  for (const auto& [distance, c, v] : pairs) {
    if (claimed[c] || labels_[v].is_corner()) continue;
    claimed[c] = 1;
    labels_[v].corner = c;
  }
}

/// Whether a bent edge at the vertex runs along the line.
bool Assignment::follows(int v, int line) const {
  constexpr double kAlong = 0.7;
  const CurvePoint* here = near(v, line);
  if (!here) return false;
  for (const PatchEdge& e : graph_.edges(v)) {
    if (!e.bent || !near(e.to, line)) continue;
    const Eigen::Vector3d along = points_.col(e.to) - points_.col(v);
    if (std::abs(along.dot(here->tangent)) >= kAlong * e.length) return true;
  }
  return false;
}

/// On a closed line without enough of them: the vertices nearest to three points of it.
void Assignment::add_anchors_of_loop(int line, std::vector<Anchor>& anchors) const {
  for (int k = 0; k < 3; ++k) {
    const double arc = curves_.length(line) * k / 3;
    const Eigen::Vector3d p = curves_.at(line, arc).point;
    int best = -1;
    double best_distance = 0;
    for (int v = 0; v < points_.cols(); ++v) {
      if (labels_[v].is_any() || !near(v, line)) continue;
      const double d = (points_.col(v) - p).norm();
      if (d > graph_.mean_length(v) || (best >= 0 && d >= best_distance)) continue;
      if (near(v, line)->distance > 0.5 * kReach * graph_.mean_length(v) || !follows(v, line))
        continue;
      best = v;
      best_distance = d;
    }
    if (best >= 0) anchors.push_back({near(best, line)->at, best});
  }
}

std::vector<Anchor> Assignment::anchors(int line) const {
  constexpr double kOnLine = 0.3;  // of an edge length
  std::vector<Anchor> result;
  const FeatureLine& l = curves_.features().lines[line];
  const auto& corners = curves_.features().corners;
  for (int v = 0; v < points_.cols(); ++v) {
    if (labels_[v].is_corner() && !l.closed) {
      const int point = corners[labels_[v].corner];
      if (point == l.points.front()) result.push_back({0, v});
      if (point == l.points.back()) result.push_back({curves_.length(line), v});
    } else if (v >= n_free_ && !labels_[v].is_any() && follows(v, line)) {
      const CurvePoint* on = near(v, line);
      if (on->distance <= kOnLine * graph_.mean_length(v)) result.push_back({on->at, v});
    }
  }
  if (l.closed && result.size() < 3) add_anchors_of_loop(line, result);
  std::sort(result.begin(), result.end());
  return result;
}

/// The vertices of the chain from one anchor to the next, by Dijkstra's algorithm; empty if there
/// is none that keeps to the line.
std::vector<int> Assignment::path(int line, const Anchor& from, const Anchor& to) const {
  constexpr double kOff = 10, kFlat = 3;  // how much worse a chain is a length off, and not bent
  constexpr double kLongest = 1.5;        // of the line's stretch
  const double length = curves_.length(line);
  double stretch = to.at - from.at;
  if (stretch <= 0) stretch += length;
  const double margin = graph_.mean_length(from.vertex);
  const auto usable = [&](int v) {
    if (v == to.vertex) return true;
    const CurvePoint* on = near(v, line);
    if (!on || labels_[v].is_any()) return false;
    double beyond = on->at - from.at;
    if (curves_.closed(line)) beyond -= length * std::floor((beyond + margin) / length);
    return beyond >= -margin && beyond <= stretch + margin;
  };
  const auto off = [&](int v) {
    const CurvePoint* on = near(v, line);
    const double d = (on ? on->distance : 0) / graph_.mean_length(v);
    return d * d;
  };
  struct Reached {
    double cost, length;
    int before;
    bool done;
  };
  std::vector<Reached> reached(points_.cols(), {-1, 0, -1, false});
  std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>>
      front;
  reached[from.vertex].cost = 0;
  front.emplace(0, from.vertex);
  while (!front.empty()) {
    const int v = front.top().second;
    front.pop();
    if (reached[v].done) continue;
    reached[v].done = true;
    if (v == to.vertex) break;
    for (const PatchEdge& e : graph_.edges(v)) {
      if (reached[e.to].done || !usable(e.to)) continue;
      const double cost =
          reached[v].cost + e.length * (1 + kOff * (off(v) + off(e.to)) / 2) * (e.bent ? 1 : kFlat);
      if (reached[e.to].cost >= 0 && reached[e.to].cost <= cost) continue;
      reached[e.to] = {cost, reached[v].length + e.length, v, false};
      front.emplace(cost, e.to);
    }
  }
  const Reached& end = reached[to.vertex];
  if (!end.done || from.vertex == to.vertex || end.length > kLongest * stretch + margin) return {};
  std::vector<int> vertices;
  for (int v = to.vertex; v >= 0; v = reached[v].before) vertices.push_back(v);
  return vertices;
}

void Assignment::follow(int line) {
  const std::vector<Anchor> all = anchors(line);
  const std::size_t n = all.size();
  if (n < 2) return;
  for (std::size_t i = 0; i < (curves_.closed(line) ? n : n - 1); ++i) {
    for (int v : path(line, all[i], all[(i + 1) % n])) {
      if (!labels_[v].is_any()) labels_[v].line = line;
    }
  }
}

std::vector<FeatureLabel> Assignment::run() {
  if (!find_near_lines()) return std::move(labels_);
  claim_corners();
  for (int line = 0; line < curves_.n_lines(); ++line) follow(line);
  return std::move(labels_);
}

}  // namespace

std::vector<FeatureLabel> assign_features(const Eigen::Matrix3Xd& points,
                                          std::span<const std::array<int, 4>> quads, int n_free,
                                          const ReferenceSurface& reference) {
  if (reference.curves().n_lines() == 0) return std::vector<FeatureLabel>(points.cols());
  return Assignment(points, quads, n_free, reference.curves()).run();
}

std::vector<FeatureLabel> feature_of(const ReferenceSurface& reference, const HexMesh& mesh) {
  std::vector<FeatureLabel> result(mesh.vertex_slots());
  if (reference.curves().n_lines() == 0) return result;
  std::vector<int> local(mesh.vertex_slots(), -1);
  std::vector<VertexHandle> vertices;
  std::vector<std::array<int, 4>> quads;
  for (HalfFaceHandle hf : mesh.boundary_halffaces()) {
    std::array<int, 4>& quad = quads.emplace_back();
    for (int i = 0; VertexHandle v : mesh.vertices(hf)) {
      if (local[v.idx] < 0) {
        local[v.idx] = static_cast<int>(vertices.size());
        vertices.push_back(v);
      }
      quad[i++] = local[v.idx];
    }
  }
  Eigen::Matrix3Xd points(3, vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) points.col(i) = mesh.point(vertices[i]);
  const auto labels = assign_features(points, quads, static_cast<int>(points.cols()), reference);
  for (std::size_t i = 0; i < vertices.size(); ++i) result[vertices[i].idx] = labels[i];
  return result;
}

}  // namespace hexweft
