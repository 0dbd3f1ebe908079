/// \file
/// Keeps as much of a move of vertices as the hexahedra and the surface bear.
///
///     const Region before = make_region(mesh, cells);
///     ...move vertices of the cells...
///     if (keep_what_fits(mesh, before, distance, limits)) { ...; distance.commit(); }
#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "optimize/region.h"
#include "optimize/surface_distance.h"

namespace hexweft {

struct MoveLimits {
  double least_scaled_jacobian;  ///< no hexahedron ends below this, nor falls if it was below it
  /// Model units; of the samples of every side that moves, unless it was farther before.
  double distance;
  /// Model units; of what moves, also between the samples.
  double between = std::numeric_limits<double>::infinity();
};

/// Asked with the scaled Jacobians of the hexahedra of the region.
using WorthKeeping = std::function<bool(const std::vector<double>& scaled_jacobians)>;

/// Takes vertices back towards where they were, half the way and in the end all of it, round every
/// hexahedron and side that breaks a limit, in ever wider surroundings; all the way at once round a
/// place between the samples.
/// \param before    the region as it was; only its free vertices have moved
/// \param distance  of the mesh before the move; afterwards, if true, up to date but not committed
/// \param worth_keeping  asked of what the hexahedra bear, before the surface is looked at and after all
///                       that this takes back; all is worth it if this is empty
/// \return false if no part of the move fits, or what does is not worth it; the points are then
///         anything between
bool keep_what_fits(HexMesh& mesh, const Region& before, SurfaceDistance& distance,
                    const MoveLimits& limits, const WorthKeeping& worth_keeping = {});

}  // namespace hexweft
