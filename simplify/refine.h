/// \file
/// Refinement: splitting a dual sheet where elements are scarce or the surface is badly met.
/// It adds a layer of cells and leaves the base complex as it is. Source [Xu2021, §6].
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "ovm/dual.h"
#include "simplify/trial.h"

namespace hexweft {

struct RefineOptions {
  double min_length_rel = 1.2;  ///< > 0, mean length across, of the mean edge length of the mesh
  int by_distance = 4;  ///< >= 0, sheets looked at in the order of their mean distance first
};

/// The sheets of a mesh that may be split, one after the other: of those with the largest mean
/// distance the one that is longest across.
class SheetsToRefine {
 public:
  /// \param mesh      must outlive this
  /// \param excluded  lowest edges of sheets not to take
  SheetsToRefine(const HexMesh& mesh, const SurfaceDistance& distance, const RefineOptions& options,
                 std::span<const EdgeHandle> excluded = {});
  /// None comes twice. The mesh has to be as it was measured: a split shortens what lies beside it,
  /// and the best to split next may be another.
  /// \param max_cells  what is crossed more often is passed over
  /// \return empty if none is left
  std::optional<DualSheet> next(int max_cells);

 private:
  struct Measured {
    EdgeHandle first;     // lowest edge of the sheet
    int cells = 0;        // crossed; one that is crossed twice counts twice
    double length = 0;    // mean across, model units
    double distance = 0;  // mean over its boundary sides
  };
  struct Measures {
    std::vector<Measured> sheets;
    double mean_edge;
  };
  static Measures measure(const HexMesh& mesh, const SurfaceDistance& distance);

  const HexMesh& mesh_;
  int by_distance_;
  std::vector<Measured> left_;  // farthest first
};

/// Splits the sheet, puts new boundary vertices on the surface and relaxes round it.
/// \return false (and all as before) if that inverts a cell or leaves the surface
bool try_refine(TrialContext& context, const DualSheet& sheet, const SimplifyOptions& options);

}  // namespace hexweft
