#include "optimize/feature_assignment.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <memory>
#include <numeric>
#include <queue>
#include <tuple>
#include <utility>

#include <Eigen/Geometry>

#include "optimize/feature_curves.h"
#include "optimize/patch_graph.h"
#include "ovm/hex_mesh.h"

namespace hexweft {
namespace {

constexpr double kReach = 0.75;  // of a vertex's mean edge length: how far its lines may be

/// Whether the surface at a vertex of this normal can be that at the line: not across a gap or on the
/// other side of a thin part. On one of two faces that meet at the line it can be, whatever the angle.
bool faces_as(const Eigen::Vector3d& normal, const CurvePoint& on) {
  constexpr double kShare = 0.4;    // of what a vertex on one of the faces has
  constexpr double kFolded = 0.01;  // squared: two faces back to back have no side
  const double face = on.facing.squaredNorm();
  return face < kFolded || normal.isZero() || normal.dot(on.facing) > kShare * face;
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
        near_line_(curves.n_lines()),
        lines_at_corner_(curves.features().corners.size(), 0),
        vertex_of_corner_(curves.features().corners.size(), -1),
        reached_(points.cols()),
        labels_(points.cols()) {
    for (int line = 0; line < curves.n_lines(); ++line) {
      for (const int c : curves.ends(line)) {
        if (c >= 0) ++lines_at_corner_[c];
      }
    }
  }

  /// \param ids  what `known` knows the points by
  std::vector<FeatureLabel> run(std::span<const int> ids, NearLines& known);

 private:
  struct Reached {
    double cost = -1, length = 0;
    int before = -1;
    bool done = false;
  };

  bool find_near_lines(std::span<const int> ids, NearLines& known);
  std::vector<int> corners_near(int v) const;
  void claim_corners();
  const CurvePoint* near(int v, int line) const;
  bool follows(int v, int line) const;
  std::vector<Anchor> anchors(int line) const;
  void add_anchors_of_loop(int line, std::vector<Anchor>& anchors) const;
  void follow(int line);
  /// Arc length from one anchor on to the other, on a closed line past its first point if need be.
  double stretch(int line, const Anchor& from, const Anchor& to) const {
    return to.at - from.at + (to.at > from.at ? 0 : curves_.length(line));
  }
  bool is_between(int v, int line, const Anchor& from, const Anchor& to) const;
  double penalty(int line, int v, const PatchEdge& e) const;
  std::vector<int> path(int line, const Anchor& from, const Anchor& to);

  const Eigen::Matrix3Xd& points_;
  int n_free_;
  const FeatureCurves& curves_;
  PatchGraph graph_;
  std::vector<std::vector<CurvePoint>> near_;  // lines near each vertex
  std::vector<std::vector<int>> near_line_;    // vertices near each line, ascending
  std::vector<int> lines_at_corner_;           // how many end there
  std::vector<int> vertex_of_corner_;          // -1: not claimed
  std::vector<Reached> reached_;               // of a search; between searches as at the start
  std::vector<int> touched_;                   // by a search
  std::vector<FeatureLabel> labels_;
};

bool Assignment::find_near_lines(std::span<const int> ids, NearLines& known) {
  if (!ids.empty()) known.make_room(*std::max_element(ids.begin(), ids.end()) + 1);
  bool any = false;
  for (int v = 0; v < points_.cols(); ++v) {
    if (graph_.mean_length(v) == 0) continue;
    const auto lines = known.near(ids[v], points_.col(v), kReach * graph_.mean_length(v), curves_);
    std::copy_if(lines.begin(), lines.end(), std::back_inserter(near_[v]),
                 [&](const CurvePoint& c) { return faces_as(graph_.normal(v), c); });
    for (const CurvePoint& c : near_[v]) near_line_[c.line].push_back(v);
    any |= !near_[v].empty();
  }
  return any;
}

const CurvePoint* Assignment::near(int v, int line) const {
  const auto at = std::find_if(near_[v].begin(), near_[v].end(),
                               [&](const CurvePoint& c) { return c.line == line; });
  return at == near_[v].end() ? nullptr : std::to_address(at);
}

/// The corners within reach of whose lines the vertex may lie on more than half.
std::vector<int> Assignment::corners_near(int v) const {
  std::vector<int> ends;  // a corner within reach is an end of lines within it
  for (const CurvePoint& on : near_[v]) {
    for (const int c : curves_.ends(on.line)) {
      if (c >= 0) ends.push_back(c);
    }
  }
  std::sort(ends.begin(), ends.end());
  std::vector<int> corners;
  for (auto next = ends.begin(); next != ends.end();) {
    const int c = *next;
    const auto end = std::upper_bound(next, ends.end(), c);
    if (2 * (end - next) > lines_at_corner_[c]) corners.push_back(c);
    next = end;
  }
  return corners;
}

/// Nearest pairs first, each corner and each vertex once.
void Assignment::claim_corners() {
  std::vector<std::tuple<double, int, int>> pairs;  // distance, corner, vertex
  for (int v = 0; v < points_.cols(); ++v) {
    for (const int c : corners_near(v)) {
      const double d = (curves_.corner(c) - points_.col(v)).norm();
      if (d <= kReach * graph_.mean_length(v)) pairs.emplace_back(d, c, v);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  for (const auto& [distance, c, v] : pairs) {
    if (vertex_of_corner_[c] >= 0 || labels_[v].is_corner()) continue;
    vertex_of_corner_[c] = v;
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

/// On a line that comes round, without enough of them: the vertices nearest to three points of it.
void Assignment::add_anchors_of_loop(int line, std::vector<Anchor>& anchors) const {
  for (int k = 0; k < 3; ++k) {
    const double arc = curves_.length(line) * k / 3;
    const Eigen::Vector3d p = curves_.at(line, arc).point;
    int best = -1;
    double best_distance = 0;
    for (const int v : near_line_[line]) {
      if (labels_[v].is_any()) continue;
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
  for (int end = 0; end < 2; ++end) {
    const int corner = curves_.ends(line)[end];
    const int v = corner < 0 ? -1 : vertex_of_corner_[corner];
    if (v >= 0) result.push_back({end == 0 ? 0 : curves_.length(line), v});
  }
  const auto& nearby = near_line_[line];
  for (auto v = std::lower_bound(nearby.begin(), nearby.end(), n_free_); v != nearby.end(); ++v) {
    if (labels_[*v].is_any() || !follows(*v, line)) continue;
    const CurvePoint* on = near(*v, line);
    if (on->distance <= kOnLine * graph_.mean_length(*v)) result.push_back({on->at, *v});
  }
  const auto [first, last] = curves_.ends(line);  // one and the same corner, or none
  if (first == last && result.size() < 3) add_anchors_of_loop(line, result);
  std::sort(result.begin(), result.end());
  return result;
}

/// Whether a chain between the anchors may pass through the vertex.
bool Assignment::is_between(int v, int line, const Anchor& from, const Anchor& to) const {
  if (v == to.vertex) return true;
  const CurvePoint* on = near(v, line);
  if (!on || labels_[v].is_any()) return false;
  const double length = curves_.length(line), margin = graph_.mean_length(from.vertex);
  double beyond = on->at - from.at;
  if (curves_.closed(line)) beyond -= length * std::floor((beyond + margin) / length);
  return beyond >= -margin && beyond <= stretch(line, from, to) + margin;
}

/// How much worse than its length an edge is for a chain: off the line, and not bent.
double Assignment::penalty(int line, int v, const PatchEdge& e) const {
  constexpr double kOff = 10, kFlat = 3;
  double off = 0;
  for (int end : {v, e.to}) {
    const CurvePoint* on = near(end, line);
    const double d = (on ? on->distance : 0) / graph_.mean_length(end);
    off += d * d / 2;
  }
  return (1 + kOff * off) * (e.bent ? 1 : kFlat);
}

/// The vertices of the chain from one anchor to the next, by Dijkstra's algorithm; empty if there
/// is none that keeps to the line.
std::vector<int> Assignment::path(int line, const Anchor& from, const Anchor& to) {
  constexpr double kLongest = 1.5;  // of the line's stretch
  std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>>
      front;
  reached_[from.vertex].cost = 0;
  touched_.assign(1, from.vertex);
  front.emplace(0, from.vertex);
  while (!front.empty() && !reached_[to.vertex].done) {
    const int v = front.top().second;
    front.pop();
    if (reached_[v].done) continue;
    reached_[v].done = true;
    for (const PatchEdge& e : graph_.edges(v)) {
      Reached& next = reached_[e.to];
      if (next.done || !is_between(e.to, line, from, to)) continue;
      const double cost = reached_[v].cost + e.length * penalty(line, v, e);
      if (next.cost >= 0 && next.cost <= cost) continue;
      if (next.cost < 0) touched_.push_back(e.to);
      next = {cost, reached_[v].length + e.length, v, false};
      front.emplace(cost, e.to);
    }
  }
  const Reached end = reached_[to.vertex];
  const double most = kLongest * stretch(line, from, to) + graph_.mean_length(from.vertex);
  std::vector<int> vertices;
  if (end.done && from.vertex != to.vertex && end.length <= most) {
    for (int v = to.vertex; v >= 0; v = reached_[v].before) vertices.push_back(v);
  }
  for (const int v : touched_) reached_[v] = {};
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

std::vector<FeatureLabel> Assignment::run(std::span<const int> ids, NearLines& known) {
  if (!find_near_lines(ids, known)) return std::move(labels_);
  claim_corners();
  for (int line = 0; line < curves_.n_lines(); ++line) follow(line);
  return std::move(labels_);
}

}  // namespace

void NearLines::make_room(int n) {
  if (n > std::ssize(entries_)) entries_.resize(n);
}

std::span<const CurvePoint> NearLines::near(int v, const Eigen::Vector3d& point, double reach,
                                            const FeatureCurves& curves) {
  Entry& e = entries_[v];
  if (e.reach != reach || e.point != point) e = {point, reach, curves.within(point, reach)};
  return e.lines;
}

std::vector<FeatureLabel> assign_features(const Eigen::Matrix3Xd& points,
                                          std::span<const std::array<int, 4>> quads, int n_free,
                                          const ReferenceSurface& reference) {
  if (reference.curves().n_lines() == 0) return std::vector<FeatureLabel>(points.cols());
  std::vector<int> ids(points.cols());
  std::iota(ids.begin(), ids.end(), 0);
  NearLines unknown;
  return Assignment(points, quads, n_free, reference.curves()).run(ids, unknown);
}

std::vector<FeatureLabel> feature_of(const ReferenceSurface& reference, const HexMesh& mesh) {
  NearLines unknown;
  return feature_of(reference, mesh, unknown);
}

std::vector<FeatureLabel> feature_of(const ReferenceSurface& reference, const HexMesh& mesh,
                                     NearLines& known) {
  std::vector<FeatureLabel> result(mesh.vertex_slots());
  if (reference.curves().n_lines() == 0) return result;
  std::vector<int> local(mesh.vertex_slots(), -1);
  std::vector<int> vertices;  // by handle
  std::vector<std::array<int, 4>> quads;
  for (HalfFaceHandle hf : mesh.boundary_halffaces()) {
    std::array<int, 4>& quad = quads.emplace_back();
    for (int i = 0; VertexHandle v : mesh.vertices(hf)) {
      if (local[v.idx] < 0) {
        local[v.idx] = static_cast<int>(vertices.size());
        vertices.push_back(v.idx);
      }
      quad[i++] = local[v.idx];
    }
  }
  const auto n = static_cast<int>(vertices.size());
  Eigen::Matrix3Xd points(3, n);
  for (int i = 0; i < n; ++i) points.col(i) = mesh.point(VertexHandle(vertices[i]));
  const std::vector<FeatureLabel> labels =
      Assignment(points, quads, n, reference.curves()).run(vertices, known);
  for (int i = 0; i < n; ++i) result[vertices[i]] = labels[i];
  return result;
}

}  // namespace hexweft
