/// \file
/// The main job: removes base-complex sheets and chords until nothing is left to remove.
///
///     HexMesh mesh = ...;
///     const SimplifyReport report = simplify(mesh, {.hausdorff_limit_rel = 0.005});
///     std::cout << report.brief();
#pragma once

#include "ovm/hex_mesh.h"
#include "simplify/options.h"
#include "simplify/report.h"

namespace hexweft {

/// Source [Xu2021, Algorithm 1], spec "The loop". Whenever it stops, the mesh is valid: conforming,
/// manifold, of the input's genus and parts, without inverted cells, within the Hausdorff limit.
/// \param mesh  valid (check_topology), no cell of scaled Jacobian <= 0, its base complex regular
/// \throws InputError otherwise, naming an element, and on bad options; the mesh is then unchanged
SimplifyReport simplify(HexMesh& mesh, const SimplifyOptions& options = {});

}  // namespace hexweft
