/// \file
/// A run that was cut short, to be gone on with.
///
///     options.checkpoint = [&](const HexMesh& mesh, const RunState& state) { keep(mesh, state); };
///     simplify(mesh, options);                                  // ended by what else but a power cut
///     resume_simplify(input, {kept_mesh, kept_state}, options);  // in another process
///
/// The reference surface, the counts of the input and all limits are those of the original input.
/// What is not kept: the memory of candidates that failed, which are tried again, and the slots of
/// deleted elements. So a resumed run need not end with the mesh that one in a single go ends with;
/// but two runs resumed from one checkpoint give the same bytes.
#pragma once

#include <cstdint>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "ovm/hex_mesh.h"
#include "simplify/report.h"

namespace hexweft {

struct SimplifyOptions;

/// What a run carries from step to step, beside the mesh.
struct RunState {
  int step = 0;           ///< 0: the mesh is the input still
  bool smoothed = false;  ///< what is left are goes from the smoothed mesh
  double distance_share =
      1;                    ///< (0, 1] of the Hausdorff limit, which the loop keeps at its sampling
  double target_cells = 1;  ///< > 0, the count of cells that the loop keeps near
  TrialCounts sheets, chords, peels, pillows;
  int coarsened = 0, refined = 0, refinement_failed = 0;
  double seconds = 0;
  Profile profile;
};
nlohmann::ordered_json to_json(const RunState& state);
/// \throws InputError if it is not what to_json() makes
RunState run_state(const nlohmann::ordered_json& j);

struct Checkpoint {
  HexMesh mesh;
  RunState state;
};

/// A number that differs, as good as surely, for meshes that differ in a corner or a coordinate.
/// FNV-1a over the live elements in the order of their handles.
std::uint64_t fingerprint(const HexMesh& mesh);

/// The options that say what a mesh of the run may be and what is tried next: all but those that
/// end a run (rate, components, seconds, stop), the number of threads and the callbacks. Of the energy
/// its name, not its parameters.
nlohmann::ordered_json lasting_options(const SimplifyOptions& options);

}  // namespace hexweft
