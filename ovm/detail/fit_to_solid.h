/// \file
/// Draws the boundary of a mesh onto the surface of a solid and evens the mesh out, as far as every
/// cell stays good.
#pragma once

#include "ovm/generators_solids.h"
#include "ovm/hex_mesh.h"

namespace hexweft::detail {

/// \param mesh         its boundary lies within a few edge lengths of the solid's surface
/// \param edge_length  of a cell, model units
/// Topology stays. Where cells are in the way, vertices are left off the surface.
void fit_to_solid(HexMesh& mesh, const Solid& solid, double edge_length);

}  // namespace hexweft::detail
