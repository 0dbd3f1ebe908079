/// \file
/// The two-sided distance between a mesh's boundary and a reference, kept current through local
/// edits.
///
///     SurfaceDistance distance(mesh, reference);
///     Transaction trial(mesh);
///     ...edit the mesh...
///     if (distance.after_change(mesh, limit) <= limit) { trial.commit(); distance.commit(); }
///     else distance.rollback();
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "optimize/farthest_sample.h"
#include "optimize/known_distances.h"
#include "optimize/quad_grid.h"
#include "optimize/reference_surface.h"
#include "optimize/sample_lists.h"
#include "ovm/hex_mesh.h"

namespace hexweft {

/// Sample density, a compromise between a trial's cost and what it can miss. The samples are the
/// corners, edge midpoints and centroids of triangles, of their four parts too with more levels. A
/// triangle four times as large as the reference's are on average gets one level more, and so on.
struct SurfaceDistanceOptions {
  int mesh_levels = 0;       ///< ≥ 0, subdivisions of a boundary triangle of the mesh
  int reference_levels = 0;  ///< ≥ 0, subdivisions of a triangle of the reference
  int suspect_levels = 2;    ///< ≥ 0, more of these for a side whose samples come near the limit
  double suspect_rel = 0.5;  ///< (0, 1], of the limit: how near that is
  double negligible = 0;  ///< ≥ 0, model units; distances up to it count as 0, which is found fast
};

/// Holds, for every boundary side of the mesh, its samples' largest distance to the reference, and
/// for every sample of the reference the nearest side. A change recomputes the sides it moved, and
/// the samples whose nearest side moved or went away. A sample whose nearest side stays keeps its
/// distance, even if another side has come nearer: the result is never below the truth on the
/// samples, but for what is negligible (SurfaceDistanceOptions).
class SurfaceDistance {
 public:
  SurfaceDistance(const HexMesh& mesh, const ReferenceSurface& reference,
                  const SurfaceDistanceOptions& options = {});

  double forward() const;   ///< model units, from the mesh to the reference
  double backward() const;  ///< model units, from the reference to the mesh
  double distance() const { return std::max(forward(), backward()); }
  double ratio() const { return distance() / reference_.bounding_box_diagonal(); }

  /// Distance of one boundary side's samples to the reference, and of the reference's samples
  /// nearest to it; model units. 0 for a half-face that is not on the boundary.
  std::vector<double> distance_by_halfface() const;  ///< indexed by half-face
  double distance_at(HalfFaceHandle hf) const;       ///< of one; costs what it has samples

  /// Brings the distances up to the mesh as it is now; until commit() they can be rolled back.
  /// Looks at every side of the mesh. Gives up as soon as a sample is farther than `limit` (model
  /// units) and returns that sample's distance; then only rollback() is allowed.
  /// \return the distance of what has changed since the last commit(), model units; 0 if nothing has
  double after_change(const HexMesh& mesh, double limit = std::numeric_limits<double>::infinity());
  /// The same where only sides of these cells, alive or deleted, can have changed.
  double after_change(const HexMesh& mesh, std::span<const CellHandle> touched,
                      double limit = std::numeric_limits<double>::infinity());
  /// Whether what changed since the last commit() stays within `limit` (model units) also between the
  /// samples of the options: looks as closely as is_within() (hausdorff.h), at the changed part only.
  /// \param skip_rel  sides and triangles all of whose samples are closer than this, in limits, are
  ///                  taken for good
  bool change_is_within(double limit, double skip_rel = 0);
  /// Where the last of these looks was given up, or did not hold: the middle of the side or the sample
  /// of the reference that is too far.
  const std::optional<Eigen::Vector3d>& too_far_at() const { return too_far_at_; }
  void commit();    ///< \throws InputError after a change that was given up
  void rollback();  ///< to the last commit; the mesh must be rolled back by its transaction
  /// After HexMesh::collect_garbage(). \throws InputError unless all changes are committed
  void renumber(const Renumbering& now);

  const ReferenceSurface& reference() const { return reference_; }
  const SurfaceDistanceOptions& options() const { return options_; }

 private:
  struct SideUndo {
    int side;
    bool present;
    QuadPoints points;
    double forward;
  };
  struct ChangedSide {
    int side;
    bool present;       // on the boundary as the mesh is now
    QuadPoints points;  // now, if present
  };
  struct SampleUndo {
    int sample, side;
    double distance;
  };

  /// Where a triangle of the reference has its samples, beside those of its corners.
  struct TriangleSamples {
    std::array<int, 3> edges;
    int first_centroid, end;  // of it and its parts
  };

  Closeness closeness(double limit) const;
  bool changed_triangles_are_within(double limit, double skip);
  void make_room(int n_sides);
  void make_samples(int levels);
  void add_sample(const Eigen::Vector3d& p);
  void note_if_changed(const HexMesh& mesh, int side, std::vector<ChangedSide>& changed);
  void update_grid(const std::vector<ChangedSide>& changed);
  int levels_for(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                 const Eigen::Vector3d& c) const;
  double forward_distance(const HexMesh& mesh, int side, const QuadPoints& q, double limit);
  double update(const HexMesh& mesh, const std::vector<ChangedSide>& changed, double limit);
  double update_samples(const std::vector<ChangedSide>& changed, double limit);
  double distance_of_change() const;

  ReferenceSurface reference_;
  SurfaceDistanceOptions options_;
  double mean_area_;  // of the reference's triangles, model units²
  // Samples of the vertices, then of the edges and parts of triangle after triangle.
  std::vector<Eigen::Vector3d> samples_;
  std::vector<double> backward_;  // distance of every sample to its nearest side
  SampleLists nearest_side_;
  std::vector<int> last_found_;  // side nearest to every sample the last time, which rollback keeps
  std::vector<TriangleSamples> samples_of_triangle_;
  QuadGrid grid_;                          // boundary sides by half-face
  std::vector<double> forward_;            // by half-face; 0 where not on the boundary
  KnownDistances of_vertices_, of_edges_;  // midpoints
  std::vector<int> near_;                  // by half-face, a triangle close to its middle, or -1
  std::vector<SideUndo> side_undo_;
  std::size_t n_in_grid_ = 0;  // of these, from the first on, how many the grid knows of
  std::vector<SampleUndo> sample_undo_;
  bool given_up_ = false;
  std::optional<Eigen::Vector3d> too_far_at_;
};

}  // namespace hexweft
