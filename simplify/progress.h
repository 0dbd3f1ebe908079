/// \file
/// What an observer of the simplification is told.
#pragma once

#include <optional>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "simplify/rank.h"

namespace hexweft {

enum class StepKind {
  start,       ///< nothing done yet
  sheet,       ///< a sheet was collapsed
  chord,       ///< a chord was collapsed
  peel,        ///< a sheet was taken off a face of the surface
  pillow,      ///< a sheet was collapsed with a pillow beside what was in its way
  coarsening,  ///< layers were taken out of sheets, before the first collapse
  refinement,  ///< a sheet was split
  relief,      ///< the place farthest from the surface was relaxed
  smoothing,  ///< the whole mesh was smoothed, or relaxed before a first collapse; the last is of the output
  back  ///< a mesh of the way was taken up again: the one after SimplifyProgress::step
};
std::string_view name(StepKind kind);
constexpr bool is_collapse(StepKind k) {
  return k == StepKind::sheet || k == StepKind::chord || k == StepKind::peel ||
         k == StepKind::pillow;
}

/// A change of the mesh that was accepted, and the mesh after it.
struct SimplifyProgress {
  StepKind what = StepKind::start;
  std::string_view kind =
      {};  ///< of a sheet, also a peel's or one with a pillow: name(SheetKind); of a chord: open
           ///< or closed
  int width = 0;  ///< of a collapse: layers of cells that folded together or went
  std::optional<SheetTerms> sheet_terms = {};  ///< of a sheet, before it went
  std::optional<ChordTerms> chord_terms = {};  ///< of a chord, before it went

  int attempt = 0;  ///< of several, from 0
  int step =
      0;  ///< collapses, splits and layers taken out so far; relief and smoothing belong to the one before
  int hexahedra = 0;
  /// When last counted. Of collapses far enough from each other to be made at one go they are counted
  /// after the last.
  int components = 0;
  int input_components = 0;
  /// Of the bounding-box diagonal, at the sampling of the loop, where what is far below the limit
  /// counts as 0.
  double hausdorff_ratio = 0;
  double min_scaled_jacobian = 1, mean_scaled_jacobian = 1;
  double seconds = 0;  ///< since the start, earlier runs of a resumed one included
};

nlohmann::ordered_json to_json(const SimplifyProgress& progress);

}  // namespace hexweft
