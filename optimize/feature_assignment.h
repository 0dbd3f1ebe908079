/// \file
/// Which vertices of a mesh stand for the feature lines and corners of its reference: the lines of
/// the reference found again as chains of mesh edges.
///
///     const auto features = feature_of(reference, mesh);       // by vertex handle
///     if (features[v.idx].is_corner()) ...
#pragma once

#include <array>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "optimize/feature_curves.h"
#include "optimize/reference_surface.h"

namespace hexweft {

class HexMesh;

/// What a vertex stands for. Neither its line nor its corner: it belongs to a face.
struct FeatureLabel {
  int line = -1;    ///< index into SurfaceFeatures::lines
  int corner = -1;  ///< index into SurfaceFeatures::corners; then `line` is -1
  bool is_line() const { return line >= 0; }
  bool is_corner() const { return corner >= 0; }
  bool is_any() const { return is_line() || is_corner(); }
  friend bool operator==(const FeatureLabel&, const FeatureLabel&) = default;
};

/// The feature lines near each of some vertices, found anew only for those that have moved since.
class NearLines {
 public:
  /// \param n  vertices to come are less than this
  void make_room(int n);
  /// \param reach  > 0, model units
  /// \return until make_room()
  std::span<const CurvePoint> near(int v, const Eigen::Vector3d& point, double reach,
                                   const FeatureCurves& curves);

 private:
  struct Entry {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    double reach = 0;  // 0: not looked for yet
    std::vector<CurvePoint> lines = {};
  };
  std::vector<Entry> entries_;
};

/// Each corner of the reference is claimed by the nearest vertex, if it is within an edge's length.
/// Each line is followed by the chain of boundary edges between its corners that stays closest to
/// it, mesh edges that are bent themselves first; a line of which no chain stays within an edge's
/// length has no vertices there. No vertex stands for two lines.
///
/// A collapse keeps the features of the surface if no group holds two corners, or two lines, or a
/// corner and a line that does not end there. Its vertex is best put on the group's corner, else on
/// its line (FeatureCurves::closest), else on the boundary.
///
/// Depends on the mesh as it is, not on its history. Cost: about that of one closest point a
/// boundary vertex.
/// \return by vertex handle, vertex_slots() of them; inner vertices have no feature
std::vector<FeatureLabel> feature_of(const ReferenceSurface& reference, const HexMesh& mesh);

/// The same, for a mesh that is looked at again and again.
/// \param known  at first empty, then as it was left here; always with the same reference
std::vector<FeatureLabel> feature_of(const ReferenceSurface& reference, const HexMesh& mesh,
                                     NearLines& known);

/// The same for a part of a boundary.
/// \param points  3 × #points, model units
/// \param quads   counter-clockwise from outside
/// \param n_free  points from this one on are the rim: lines may go on beyond them
std::vector<FeatureLabel> assign_features(const Eigen::Matrix3Xd& points,
                                          std::span<const std::array<int, 4>> quads, int n_free,
                                          const ReferenceSurface& reference);

}  // namespace hexweft
