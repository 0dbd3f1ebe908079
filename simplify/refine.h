/// \file
/// Refinement: splitting a dual sheet where elements are scarce or the surface is badly met.
/// It adds a layer of cells and leaves the base complex as it is. Source [Xu2021, §6].
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "ovm/dual.h"
#include "simplify/trial.h"

namespace hexweft {

/// For RefineOptions::by_distance: the longest of all comes first, whatever its distance.
inline constexpr int kAllSheets = std::numeric_limits<int>::max();

struct RefineOptions {
  int max_cells = 0;            ///< a sheet may hold at most so many
  double min_length_rel = 1.2;  ///< > 0, mean length across, of the mean edge length of the mesh
  /// >= 0, of so many with the largest mean distance the longest comes first
  int by_distance = 4;
};

/// The sheets that may be split, by their lowest edges, in the order to try them: each time, of those
/// left with the largest mean distance, the one that is longest across. A split shortens what lies
/// beside it: after one the best to split next may be another.
/// \param excluded  lowest edges of sheets not to take
std::vector<EdgeHandle> list_sheets_to_refine(const HexMesh& mesh, const SurfaceDistance& distance,
                                              const RefineOptions& options,
                                              std::span<const EdgeHandle> excluded = {});

/// Splits the sheet, puts new boundary vertices on the surface and relaxes round it.
/// \return false (and all as before) if that inverts a cell or leaves the surface
bool try_refine(TrialContext& context, const DualSheet& sheet, const SimplifyOptions& options);

}  // namespace hexweft
