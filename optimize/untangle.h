/// \file
/// Makes the inverted hexahedra of a mesh valid.
#pragma once

#include "optimize/local_parametrization.h"

namespace hexweft {

/// Moves all vertices, on the reference where they are on the surface, until no hexahedron is inverted
/// or a round leaves no fewer than there were. A mesh without any stays as it is. How far the surface
/// has moved off the reference is for the caller to look at.
/// \param max_rounds  ≥ 0; one mostly suffices
/// \return how many hexahedra are inverted still: of scaled Jacobian ≤ 0
/// \throws InputError on bad options
int untangle(HexMesh& mesh, const ReferenceSurface& reference,
             const ParametrizationOptions& options = {}, int max_rounds = 3);

}  // namespace hexweft
