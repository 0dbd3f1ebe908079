/// \file
/// What a run of the simplification did.
#pragma once

#include <array>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "simplify/refusal.h"

namespace hexweft {

/// A mesh in the numbers that the published tables use (spec, "Words").
struct MeshFigures {
  int vertices = 0, hexahedra = 0;
  int base_vertices = 0, base_edges = 0, base_faces = 0, components = 0;
  double min_scaled_jacobian = 1, mean_scaled_jacobian = 1, std_scaled_jacobian = 0;
  double mean_volume_deviation = 0, max_volume_deviation = 0;
  int inverted = 0;
  int genus = 0, parts = 0;
};
class HexMesh;
MeshFigures measure_mesh(const HexMesh& mesh);

/// Why the loop ended.
enum class StopReason { nothing_left, no_progress, target_reached, out_of_time, interrupted };
std::string_view name(StopReason reason);

/// How often trials of one kind ended how.
struct TrialCounts {
  int accepted = 0;
  std::array<int, kRefusals> refused = {};  ///< by Refusal
};

struct SimplifyReport {
  MeshFigures before, after;
  double hausdorff_ratio = 0;  ///< of the output, at full sampling
  StopReason stopped = StopReason::nothing_left;
  TrialCounts sheets, chords;
  int refined = 0, refinement_failed = 0;  ///< sheets split
  double seconds = 0;

  double rate() const {  ///< R
    return before.components > 0 ? 1 - static_cast<double>(after.components) / before.components
                                 : 0;
  }
  std::string brief() const;  ///< a table for people, before and after side by side
  nlohmann::ordered_json json() const;
};

}  // namespace hexweft
