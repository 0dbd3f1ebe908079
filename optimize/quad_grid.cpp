#include "optimize/quad_grid.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "optimize/closest_point.h"

namespace hexweft {

double squared_distance(const Eigen::Vector3d& p, const QuadPoints& q) {
  return std::min((closest_point(p, q[0], q[1], q[2]).point - p).squaredNorm(),
                  (closest_point(p, q[2], q[3], q[0]).point - p).squaredNorm());
}

QuadGrid::QuadGrid(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper, double cell_size)
    : lower_(lower), cell_size_(cell_size) {
  constexpr double kMostCells = 4e6;
  const Eigen::Vector3d extent = upper - lower;
  const auto count = [&](int k) { return std::floor(extent[k] / cell_size_) + 1; };
  while (count(0) * count(1) * count(2) > kMostCells) cell_size_ *= 1.26;
  for (int k = 0; k < 3; ++k) size_[k] = static_cast<int>(count(k));
  cells_.resize(static_cast<std::size_t>(size_[0]) * size_[1] * size_[2]);
}

/// The cell of the point's projection onto the box. The projection brings no two points farther
/// apart, so distances between cells stay lower bounds for quads outside.
QuadGrid::Index QuadGrid::index_of(const Eigen::Vector3d& p) const {
  Index index;
  for (int k = 0; k < 3; ++k) {
    const double i = std::floor((p[k] - lower_[k]) / cell_size_);
    index[k] = static_cast<int>(std::clamp(i, 0.0, size_[k] - 1.0));
  }
  return index;
}

template <class F>
void QuadGrid::for_each_cell(const Quad& quad, F&& visit) {
  const Index from = index_of(quad.box.lower), to = index_of(quad.box.upper);
  for (int z = from[2]; z <= to[2]; ++z) {
    for (int y = from[1]; y <= to[1]; ++y) {
      for (int x = from[0]; x <= to[0]; ++x) visit(cell(x, y, z));
    }
  }
}

void QuadGrid::insert(int id, const QuadPoints& points) {
  assert(!contains(id));
  if (id >= static_cast<int>(slot_of_.size()))
    slot_of_.resize(std::max<std::size_t>(id + 1, 2 * slot_of_.size()), -1);
  if (free_.empty()) {
    free_.push_back(static_cast<int>(quads_.size()));
    quads_.emplace_back();
  }
  const int slot = slot_of_[id] = free_.back();
  free_.pop_back();
  quads_[slot] = {points, box_of(points), id};
  for_each_cell(quads_[slot], [slot](std::vector<int>& c) { c.push_back(slot); });
}

void QuadGrid::remove(int id) {
  assert(contains(id));
  const int slot = std::exchange(slot_of_[id], -1);
  for_each_cell(quads_[slot], [slot](std::vector<int>& c) {
    *std::find(c.begin(), c.end(), slot) = c.back(), c.pop_back();
  });
  free_.push_back(slot);
}

void QuadGrid::look_into(int x, int y, int z, const Eigen::Vector3d& p, Nearest& best) {
  for (int slot : cell(x, y, z)) {
    Quad& quad = quads_[slot];
    if (quad.visited == query_) continue;
    quad.visited = query_;
    if (quad.box.squared_distance(p) > best.squared_distance) continue;
    const double d = squared_distance(p, quad.points);
    if (d < best.squared_distance || (d == best.squared_distance && quad.id < best.id))
      best = {d, quad.id};
  }
}

QuadGrid::Nearest QuadGrid::nearest(const Eigen::Vector3d& p, int guess, double enough) {
  Nearest best{std::numeric_limits<double>::infinity(), -1};
  if (free_.size() == quads_.size()) return best;
  ++query_;
  const auto is_enough = [&] { return enough > 0 && best.squared_distance <= enough * enough; };
  if (guess >= 0) best = {squared_distance(p, this->points(guess)), guess};
  const Index at = index_of(p);
  double margin = cell_size_;  // from p to the nearest wall of its cell
  for (int k = 0; k < 3; ++k) {
    const double in_cell = p[k] - lower_[k] - at[k] * cell_size_;
    margin = std::max(0.0, std::min({margin, in_cell, cell_size_ - in_cell}));
  }
  const int rings = std::max({size_[0], size_[1], size_[2]});
  for (int ring = 0; ring < rings; ++ring) {
    const double bound = ring == 0 ? 0 : (ring - 1) * cell_size_ + margin;
    if (bound * bound > best.squared_distance || is_enough()) break;
    for (int z = std::max(0, at[2] - ring); z <= std::min(size_[2] - 1, at[2] + ring); ++z) {
      for (int y = std::max(0, at[1] - ring); y <= std::min(size_[1] - 1, at[1] + ring); ++y) {
        const bool shell = std::abs(z - at[2]) == ring || std::abs(y - at[1]) == ring;
        const int step = shell || ring == 0 ? 1 : 2 * ring;
        for (int x = at[0] - ring; x <= at[0] + ring; x += step) {
          if (x >= 0 && x < size_[0]) look_into(x, y, z, p, best);
        }
      }
    }
  }
  return best;
}

}  // namespace hexweft
