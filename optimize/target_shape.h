/// \file
/// The cuboid each hexahedron should become: its own mean edge lengths at its own volume, evened
/// out.
#pragma once

#include <vector>

#include "optimize/hex_energy.h"
#include "optimize/region.h"

namespace hexweft {

struct TargetShapeOptions {
  double size_blend =
      0.5;  ///< [0, 1], how far lengths move to the mean with the neighbors on both sides
  int blend_passes = 2;            ///< ≥ 0; each pass carries the evening one ring further
  double least_length_rel = 0.05;  ///< > 0, of the region's mean length: no target is thinner
};

/// Means of the lengths of the three sets of parallel edges, scaled to the volume. Along each axis
/// the lengths are blended with those of the two neighbors across it, which spreads what a collapse
/// has stretched over the layers beside it.
std::vector<TargetCuboid> target_cuboids(const Region& region, const TargetShapeOptions& options);

}  // namespace hexweft
