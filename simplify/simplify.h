/// \file
/// The main job: removes base-complex sheets and chords until nothing is left to remove.
///
///     HexMesh mesh = ...;
///     const SimplifyReport report = simplify(mesh, {.hausdorff_limit_rel = 0.005});
///     std::cout << report.brief();
#pragma once

#include "ovm/hex_mesh.h"
#include "simplify/checkpoint.h"
#include "simplify/options.h"
#include "simplify/report.h"

namespace hexweft {

/// Source [Xu2021, Algorithm 1], spec "The loop". Whenever it stops, the mesh is valid: conforming,
/// manifold, of the input's genus and parts, without inverted cells, within the Hausdorff limit.
/// A mesh of which nothing can be removed comes back as it was, but for gaps of deleted elements, unless
/// more hexahedra are asked for than it has.
/// Inverted cells of the input are untangled first.
/// \param mesh  valid (check_topology), its base complex regular, its inverted cells such that they
///              can be untangled within the Hausdorff limit
/// \throws InputError otherwise, naming an element, and on bad options; the mesh is then unchanged
SimplifyReport simplify(HexMesh& mesh, const SimplifyOptions& options = {});

/// Goes on from a checkpoint; the promises are those of simplify(), towards the original input.
/// \param mesh  in: the input of the run that the checkpoint is of; out: the result
/// \param from  valid as an input must be, of the input's genus and parts. If it is not within the
///              limit of distance, the run may have to fall back on the input.
/// \throws InputError as simplify(), of the input or of the checkpoint; the mesh is then unchanged
SimplifyReport resume_simplify(HexMesh& mesh, const Checkpoint& from,
                               const SimplifyOptions& options = {});

}  // namespace hexweft
