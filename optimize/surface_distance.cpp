#include "optimize/surface_distance.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <Eigen/Geometry>

#include "ovm/errors.h"

namespace hexweft {
namespace {

QuadPoints points_of(const HexMesh& mesh, HalfFaceHandle hf) {
  QuadPoints quad;
  for (int i = 0; VertexHandle v : mesh.vertices(hf)) quad[i++] = mesh.point(v);
  return quad;
}

bool on_boundary(const HexMesh& mesh, int side) {
  return side < 6 * mesh.cell_slots() && mesh.is_live(CellHandle(side / 6)) &&
         mesh.is_boundary(HalfFaceHandle(side));
}

double area_of(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  return (b - a).cross(c - a).norm() / 2;
}

double mean_area(const ReferenceSurface& reference) {
  const auto& p = reference.points();
  double sum = 0;
  for (const auto& t : reference.triangles()) sum += area_of(p.col(t[0]), p.col(t[1]), p.col(t[2]));
  return sum / static_cast<double>(reference.triangles().size());
}

/// Calls `visit` with a triangle and the levels left below it, then with the parts of its subdivisions.
template <class F>
void for_each_part(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                   int levels, F&& visit) {
  visit(a, b, c, levels);
  if (levels == 0) return;
  const Eigen::Vector3d ab = (a + b) / 2, bc = (b + c) / 2, ca = (c + a) / 2;
  for_each_part(a, ab, ca, levels - 1, visit);
  for_each_part(ab, b, bc, levels - 1, visit);
  for_each_part(ca, bc, c, levels - 1, visit);
  for_each_part(ab, bc, ca, levels - 1, visit);
}

/// A grid over the reference's box with cells about the size of its triangles.
QuadGrid make_grid(const ReferenceSurface& reference) {
  const auto& p = reference.points();
  double sum = 0;
  for (const auto& t : reference.triangles()) sum += (p.col(t[1]) - p.col(t[0])).norm();
  const double edge = sum / static_cast<double>(reference.triangles().size());
  const double least = 1e-6 * reference.bounding_box_diagonal() + 1e-300;
  return QuadGrid(p.rowwise().minCoeff(), p.rowwise().maxCoeff(), std::max(1.5 * edge, least));
}

}  // namespace

SurfaceDistance::SurfaceDistance(const HexMesh& mesh, const ReferenceSurface& reference,
                                 const SurfaceDistanceOptions& options)
    : reference_(reference),
      options_(options),
      mean_area_(mean_area(reference)),
      grid_(make_grid(reference)) {
  if (options.mesh_levels < 0 || options.reference_levels < 0 || options.suspect_levels < 0) {
    throw InputError("a number of subdivisions is negative, expected >= 0");
  }
  if (!(options.negligible >= 0)) throw InputError("negligible is negative, expected >= 0");
  make_samples(options.reference_levels);
  after_change(mesh);
  commit();
}

void SurfaceDistance::make_samples(int levels) {
  const auto& points = reference_.points();
  const auto add = [&](const Eigen::Vector3d& p) { add_sample(p); };
  for (Eigen::Index v = 0; v < points.cols(); ++v) add(points.col(v));
  std::map<std::pair<int, int>, int> edges;
  for (const auto& t : reference_.triangles()) {
    TriangleSamples& own = samples_of_triangle_.emplace_back();
    for (int i = 0; i < 3; ++i) {
      const auto [a, b] = std::minmax(t[i], t[(i + 1) % 3]);
      const auto [edge, fresh] = edges.try_emplace({a, b}, static_cast<int>(samples_.size()));
      if (fresh) add((points.col(a) + points.col(b)) / 2);
      own.edges[i] = edge->second;
    }
    own.first_centroid = static_cast<int>(samples_.size());
    const Eigen::Vector3d a = points.col(t[0]), b = points.col(t[1]), c = points.col(t[2]);
    for_each_part(a, b, c, levels + levels_for(a, b, c),
                  [&](const auto& p, const auto& q, const auto& r, int) { add((p + q + r) / 3); });
    own.end = static_cast<int>(samples_.size());
  }
}

int SurfaceDistance::levels_for(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                const Eigen::Vector3d& c) const {
  constexpr int kMost = 4;
  int levels = 0;
  for (double area = area_of(a, b, c) / 4; area >= mean_area_ && levels < kMost; area /= 4)
    ++levels;
  return levels;
}

void SurfaceDistance::add_sample(const Eigen::Vector3d& p) {
  samples_.push_back(p);
  backward_.push_back(0);
  nearest_side_.add_sample();
  last_found_.push_back(-1);
}

double SurfaceDistance::forward() const {
  double d = 0;
  for (double f : forward_) d = std::max(d, f);
  return d;
}

double SurfaceDistance::backward() const {
  double d = 0;
  for (double b : backward_) d = std::max(d, b);
  return d;
}

std::vector<double> SurfaceDistance::distance_by_halfface() const {
  std::vector<double> d = forward_;
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const int side = nearest_side_.side(static_cast<int>(i));
    if (side >= 0) d[side] = std::max(d[side], backward_[i]);
  }
  return d;
}

double SurfaceDistance::distance_at(HalfFaceHandle hf) const {
  double d = forward_[hf.idx];
  nearest_side_.for_each(hf.idx, [&](int sample) { d = std::max(d, backward_[sample]); });
  return d;
}

double SurfaceDistance::forward_distance(const HexMesh& mesh, int side, const QuadPoints& q,
                                         double limit) {
  const HalfFaceHandle hf(side);
  const auto vertices = mesh.vertices(hf);
  const auto edges = mesh.edges(hf);
  double d = 0;
  const auto enough = [&] { return std::max(d, options_.negligible); };
  const auto look_at = [&](const Eigen::Vector3d& p) {
    d = std::max(d, reference_.distance(p, near_[side], enough()));
  };
  look_at((q[0] + q[2]) / 2);
  for (int i = 0; i < 4; ++i) {
    d = std::max(d, of_vertices_.distance(reference_, vertices[i].idx, q[i], enough()));
    const Eigen::Vector3d middle = (q[i] + q[(i + 1) % 4]) / 2;
    d = std::max(d, of_edges_.distance(reference_, edges[i].idx, middle, enough()));
  }
  const auto look_at_part = [&](const auto& a, const auto& b, const auto& c, int levels) {
    look_at((a + b + c) / 3);
    if (levels == 0) return;
    look_at((a + b) / 2);
    look_at((b + c) / 2);
    look_at((c + a) / 2);
  };
  const auto look_at_parts = [&](int levels) {
    const int first = levels + levels_for(q[0], q[1], q[2]),
              second = levels + levels_for(q[2], q[3], q[0]);
    for_each_part(q[0], q[1], q[2], first, look_at_part);
    for_each_part(q[2], q[3], q[0], second, look_at_part);
  };
  look_at_parts(options_.mesh_levels);
  const bool suspect = d > options_.suspect_rel * limit && d <= limit;
  if (suspect && options_.suspect_levels > 0)
    look_at_parts(options_.mesh_levels + options_.suspect_levels);
  return d > options_.negligible ? d : 0;
}

/// The grid is left as it is.
void SurfaceDistance::note_if_changed(const HexMesh& mesh, int side,
                                      std::vector<ChangedSide>& changed) {
  const bool before = grid_.contains(side), now = on_boundary(mesh, side);
  if (!before && !now) return;
  QuadPoints points{};
  if (now) points = points_of(mesh, HalfFaceHandle(side));
  if (before && now && points == grid_.points(side)) return;
  side_undo_.push_back({side, before, before ? grid_.points(side) : QuadPoints{}, forward_[side]});
  forward_[side] = 0;
  changed.push_back({side, now, points});
}

void SurfaceDistance::update_grid(const std::vector<ChangedSide>& changed) {
  for (const ChangedSide& c : changed) {
    if (grid_.contains(c.side)) grid_.remove(c.side);
    if (c.present) grid_.insert(c.side, c.points);
  }
  n_in_grid_ = side_undo_.size();
}

void SurfaceDistance::make_room(int n_sides) {
  if (n_sides <= static_cast<int>(forward_.size())) return;
  forward_.resize(n_sides, 0);
  near_.resize(n_sides, -1);
  nearest_side_.resize(n_sides);
}

double SurfaceDistance::after_change(const HexMesh& mesh, double limit) {
  const int n = std::max<int>(6 * mesh.cell_slots(), static_cast<int>(forward_.size()));
  make_room(n);
  std::vector<ChangedSide> changed;
  for (int side = 0; side < n; ++side) note_if_changed(mesh, side, changed);
  return update(mesh, changed, limit);
}

double SurfaceDistance::after_change(const HexMesh& mesh, std::span<const CellHandle> touched,
                                     double limit) {
  make_room(6 * mesh.cell_slots());
  std::vector<ChangedSide> changed;
  for (CellHandle c : touched) {
    for (int side = 6 * c.idx; side < 6 * c.idx + 6; ++side) note_if_changed(mesh, side, changed);
  }
  return update(mesh, changed, limit);
}

double SurfaceDistance::update(const HexMesh& mesh, const std::vector<ChangedSide>& changed,
                               double limit) {
  too_far_at_.reset();
  of_vertices_.begin_look();
  of_edges_.begin_look();
  for (const auto& [side, present, q] : changed) {
    if (!present) continue;
    forward_[side] = forward_distance(mesh, side, q, limit);
    if (forward_[side] > limit) {
      given_up_ = true;
      too_far_at_ = centre_of(q);
      return forward_[side];
    }
  }
  update_grid(changed);  // after the look that ends most of those that are given up
  const double worst = update_samples(changed, limit);
  return given_up_ ? worst : distance_of_change();
}

double SurfaceDistance::update_samples(const std::vector<ChangedSide>& changed, double limit) {
  std::vector<int> stale;
  const auto take = [&](int sample) { stale.push_back(sample); };
  nearest_side_.for_each(-1, take);
  for (const ChangedSide& c : changed) nearest_side_.for_each(c.side, take);
  std::sort(stale.begin(), stale.end());  // neighbors follow each other
  int beside = -1;                        // what was found for the one before
  for (int sample : stale) {
    const int side = nearest_side_.side(sample);
    const auto is_there = [&](int s) { return s >= 0 && grid_.contains(s); };
    int& last = last_found_[sample];
    const int guess = is_there(side) ? side : is_there(last) ? last : beside;
    const QuadGrid::Nearest nearest = grid_.nearest(samples_[sample], guess, options_.negligible);
    last = beside = nearest.id;
    sample_undo_.push_back({sample, side, backward_[sample]});
    nearest_side_.move(sample, nearest.id);
    const double d = std::sqrt(nearest.squared_distance);
    backward_[sample] = d > options_.negligible ? d : 0;
    if (backward_[sample] > limit) {
      given_up_ = true;
      too_far_at_ = samples_[sample];
      return backward_[sample];
    }
  }
  return 0;
}

double SurfaceDistance::distance_of_change() const {
  double d = 0;
  for (const SideUndo& u : side_undo_) d = std::max(d, forward_[u.side]);
  for (const SampleUndo& u : sample_undo_) d = std::max(d, backward_[u.sample]);
  return d;
}

void SurfaceDistance::commit() {
  if (given_up_)
    throw InputError("a change whose distance was not computed to the end was committed");
  side_undo_.clear();
  sample_undo_.clear();
  n_in_grid_ = 0;
}

void SurfaceDistance::renumber(const Renumbering& now) {
  if (!side_undo_.empty() || !sample_undo_.empty())
    throw InputError("sides were renumbered amid a change");
  // There may have been more sides for a while, before a rollback.
  const int n_old = 6 * static_cast<int>(now.cells.size());
  const auto new_side = [&](int side) { return side < n_old ? now[HalfFaceHandle(side)].idx : -1; };
  std::vector<double> forward;
  std::vector<int> near;
  for (std::size_t side = 0; side < forward_.size(); ++side) {
    if (new_side(static_cast<int>(side)) < 0) continue;
    forward.push_back(forward_[side]);
    near.push_back(near_[side]);
  }
  forward_ = std::move(forward);
  near_ = std::move(near);
  nearest_side_.renumber(static_cast<int>(forward_.size()), new_side);
  for (int& side : last_found_) side = new_side(side);
  grid_.renumber(new_side);
  of_vertices_ = of_edges_ = {};
}

void SurfaceDistance::rollback() {
  for (std::size_t i = side_undo_.size(); i-- > 0;) {
    const SideUndo& undo = side_undo_[i];
    forward_[undo.side] = undo.forward;
    if (i >= n_in_grid_) continue;
    if (grid_.contains(undo.side)) grid_.remove(undo.side);
    if (undo.present) grid_.insert(undo.side, undo.points);
  }
  n_in_grid_ = 0;
  for (auto it = sample_undo_.rbegin(); it != sample_undo_.rend(); ++it) {
    nearest_side_.move(it->sample, it->side);
    backward_[it->sample] = it->distance;
  }
  side_undo_.clear();
  sample_undo_.clear();
  given_up_ = false;
}

}  // namespace hexweft
