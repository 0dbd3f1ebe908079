/// \file
/// What a run of the simplification did.
#pragma once

#include <array>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "simplify/profile.h"
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

/// Why the run ended; one of the last two also where only the smoothing was left out for it.
enum class StopReason { nothing_left, no_progress, target_reached, out_of_time, interrupted };
std::string_view name(StopReason reason);

/// How often trials of one kind ended how, and what that took.
struct TrialCounts {
  int accepted = 0;
  std::array<int, kRefusals> refused = {};  ///< by Refusal
  /// By Refusal, as the trials themselves ended; at none of those that succeeded, also where they were
  /// only compared with others or taken back later.
  std::array<double, kRefusals> seconds = {};
  int waited = 0;     ///< passed over, since they failed and little has changed
  int tried() const;  ///< accepted and refused
};
nlohmann::ordered_json to_json(const TrialCounts& counts);
/// What to_json() was made from. \throws nlohmann::json::exception if it is not of that form
TrialCounts trial_counts(const nlohmann::ordered_json& j);

/// How one of several attempts has ended.
struct AttemptFigures {
  int attempt = 0;  ///< from 0
  int components = 0;
  double min_scaled_jacobian = 1, mean_scaled_jacobian = 1;
  double seconds = 0;
};

struct SimplifyReport {
  MeshFigures before, after;
  double hausdorff_ratio = 0;  ///< of the output, at full sampling
  StopReason stopped = StopReason::nothing_left;
  TrialCounts sheets, chords, peels, pillows;
  int coarsened = 0;          ///< layers taken out before the first collapse
  int refined = 0;            ///< sheets split
  int refinement_failed = 0;  ///< sheets whose split failed, or was undone since it led nowhere
  double seconds = 0;         ///< earlier runs of a resumed one included
  Profile profile;            ///< where they went, in the attempt that was taken
  int attempt = 0;            ///< that was taken
  std::vector<AttemptFigures> attempts;  ///< that were made, in order; none where one was asked for

  int collapses() const {
    return sheets.accepted + chords.accepted + peels.accepted + pillows.accepted;
  }
  double rate() const {  ///< R
    return before.components > 0 ? 1 - static_cast<double>(after.components) / before.components
                                 : 0;
  }
  std::string brief() const;          ///< for people: before and after side by side, why it ended
  std::string profile_table() const;  ///< for people: stages of the run, fate of the trials
  nlohmann::ordered_json json() const;
};

}  // namespace hexweft
