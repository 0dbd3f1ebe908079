/// \file
/// Every sheet and chord of a mesh with the terms of its ranking, every peel, and every pillow that a
/// sheet could be collapsed with; and why ordinary trials would leave the others out.
///
///     const auto on_feature = base_edges_on_features(bc, feature_of(surface, mesh));
///     const RankReport report = report_ranking(mesh, bc, on_feature, options);
///     std::cout << report.table(10);
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "simplify/candidates.h"
#include "simplify/peel.h"
#include "simplify/pillow_search.h"

namespace hexweft {

struct RankedSheet {
  int id = 0;  ///< place in extract_sheets()
  SheetKind kind = SheetKind::open;
  int width = 0, base_edges = 0;
  int cells = 0;  ///< that a collapse would remove
  SheetTerms terms;
  Refusal refusal = Refusal::none;
};

struct RankedChord {
  int id = 0;  ///< place in extract_chords()
  bool closed = false;
  int components = 0;  ///< along it
  int cells = 0;       ///< that a collapse would remove; 0 where no plan can be made
  ChordTerms terms;
  Refusal refusal = Refusal::none;
};

struct RankedPeel {
  int id = 0;                        ///< place in extract_peels()
  SheetKind kind = SheetKind::open;  ///< of its sheet
  int width = 0, components = 0;
  int cells = 0;  ///< that would go
  Refusal refusal = Refusal::none;
};

struct RankedPillow {
  int id = 0;                        ///< place in find_pillows()
  int sheet = 0;                     ///< that would go
  SheetKind kind = SheetKind::open;  ///< of it
  int width = 0;
  int inside = 0;  ///< components that the pillow would lie round
  int added = 0;   ///< components of it
  int gain = 0;    ///< components that would go more than come
};

/// Those that pass the filters first, each kind in the order of the queues; then the others,
/// likewise in order of their costs. Peels have no cost: those of the most components come first. Pillows come in order of
/// what they gain; none is refused.
struct RankReport {
  Ranking ranking = Ranking::weighted;
  std::vector<RankedSheet> sheets;
  std::vector<RankedChord> chords;
  std::vector<RankedPeel> peels;
  std::vector<RankedPillow> pillows;

  std::string table(int max_rows) const;  ///< for people, at most so many of each kind
  nlohmann::ordered_json json() const;
};

/// Refusals are those found before anything is moved: filter_chord() and check_plan(). Writes
/// nothing. Cost O(#candidates × #vertices).
/// \param on_feature  by base edge; base_edges_on_features()
RankReport report_ranking(const HexMesh& mesh, const BaseComplex& bc,
                          const std::vector<char>& on_feature, const SimplifyOptions& options,
                          Ranking ranking = Ranking::weighted);

}  // namespace hexweft
