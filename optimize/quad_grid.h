/// \file
/// A uniform grid over quads that come and go, for closest-point distances to a boundary being
/// edited.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "optimize/box.h"

namespace hexweft {

/// A side of a hexahedron as the two triangles (0,1,2) and (2,3,0).
using QuadPoints = std::array<Eigen::Vector3d, 4>;

inline Eigen::Vector3d centre_of(const QuadPoints& q) { return (q[0] + q[1] + q[2] + q[3]) / 4; }
double squared_distance(const Eigen::Vector3d& p, const QuadPoints& quad);

/// Quads are known by the id the caller gives them.
class QuadGrid {
 public:
  /// \param lower, upper  box of the query points; quads may lie outside
  /// \param cell_size     > 0, about the size of a quad, model units; enlarged if the box is huge
  QuadGrid(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper, double cell_size);

  /// \param id  ≥ 0, not in the grid
  void insert(int id, const QuadPoints& quad);
  void remove(int id);
  /// \param new_id  of an old one in the grid, in the same order
  template <class F>
  void renumber(F&& new_id) {
    std::vector<int> slot_of;
    for (std::size_t i = 0; i < slot_of_.size(); ++i) {
      if (slot_of_[i] < 0) continue;
      const int id = quads_[slot_of_[i]].id = new_id(static_cast<int>(i));
      slot_of.resize(id + 1, -1);
      slot_of[id] = slot_of_[i];
    }
    slot_of_ = std::move(slot_of);
  }
  bool contains(int id) const {
    return id < static_cast<int>(slot_of_.size()) && slot_of_[id] >= 0;
  }
  const QuadPoints& points(int id) const { return quads_[slot_of_[id]].points; }

  struct Nearest {
    double squared_distance;  ///< infinite if the grid is empty
    int id;                   ///< -1 if the grid is empty
  };
  /// The nearest quad, or as soon as one is known that is no farther than `enough`, that one.
  /// \param p       inside the box
  /// \param guess   a quad of the grid thought to be near, or -1
  /// \param enough  ≥ 0, model units
  Nearest nearest(const Eigen::Vector3d& p, int guess = -1, double enough = 0);

 private:
  struct Quad {
    QuadPoints points;
    Box3 box;
    int id = -1;
    std::int64_t visited = 0;  // number of the last query that looked at it
  };
  using Index = std::array<int, 3>;
  Index index_of(const Eigen::Vector3d& p) const;
  std::vector<int>& cell(int x, int y, int z) {
    return cells_[(static_cast<std::size_t>(z) * size_[1] + y) * size_[0] + x];
  }
  template <class F>
  void for_each_cell(const Quad& quad, F&& visit);
  void look_into(int x, int y, int z, const Eigen::Vector3d& p, Nearest& best);

  Eigen::Vector3d lower_;
  double cell_size_;
  Index size_;
  std::vector<std::vector<int>> cells_;  // slots
  // Few of the ids that a caller uses are in the grid at a time: what is, lies close together.
  std::vector<int> slot_of_;  // by id, -1 if not in the grid
  std::vector<Quad> quads_;   // by slot
  std::vector<int> free_;     // slots
  std::int64_t query_ = 0;
};

}  // namespace hexweft
