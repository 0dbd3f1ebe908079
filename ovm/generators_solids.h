/// \file
/// Solids to mesh: a function that is negative inside, and a box that holds it. Simple ones are
/// put together by union, intersection and difference, as in CAD.
///
///     const Solid bored = subtract(cylinder_solid(0.8, 1), cylinder_solid(0.35, 2));
///     const HexMesh mesh = make_octree_like(turned(bored, some_rotation), {.resolution = 20});
#pragma once

#include <functional>
#include <span>
#include <string_view>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace hexweft {

struct Solid {
  /// Negative inside, about the distance near the surface, model units.
  std::function<double(const Eigen::Vector3d&)> distance;
  Eigen::AlignedBox3d box;  ///< holds the solid
  /// The surface has sharp edges. Vertices are then drawn onto them.
  bool sharp = true;
};

// ---- Simple solids round the origin; lengths > 0 ----
Solid box_solid(const Eigen::Vector3d& half_sides);
Solid ball_solid(double radius);
Solid cylinder_solid(double radius, double half_height);     ///< round the z axis
Solid ring_solid(double major_radius, double minor_radius);  ///< round the z axis

// ---- Put together; the result is sharp ----
Solid unite(const Solid& a, const Solid& b);
Solid intersect(const Solid& a, const Solid& b);
Solid subtract(const Solid& a, const Solid& b);  ///< a without b

Solid moved(const Solid& solid, const Eigen::Vector3d& by);
Solid turned(const Solid& solid, const Eigen::Quaterniond& rotation);  ///< about the origin

/// A rotation in general position, the same for the same seed everywhere.
Eigen::Quaterniond random_rotation(unsigned seed);

/// A plate in the plane of x and y with n round holes in rows: genus n.
/// \throws InputError for a negative n
Solid plate_with_holes(int n);

/// A solid to test with, about 2 across, and what is true of every good mesh of it.
struct SampleSolid {
  std::string_view name;
  int n_parts, n_boundary_components, genus;  ///< as TopologySummary counts them
  int least_resolution;                       ///< voxels along the longest side that show all of it
  Solid (*make)();
};

/// Parts such as CAD gives (bracket, plates with holes, crossing pipes, gear), thin ones, a knot,
/// cavities, and several pieces.
std::span<const SampleSolid> sample_solids();

}  // namespace hexweft
