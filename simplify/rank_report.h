/// \file
/// Every sheet and chord of a mesh with the terms of its ranking, and why it would not be tried.
///
///     const RankReport report = report_ranking(mesh, extract_base_complex(mesh), options);
///     std::cout << report.table(10);
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "simplify/candidates.h"

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

/// Those that pass the filters first, each kind in the order of the queues; then the others,
/// likewise in order of their costs.
struct RankReport {
  Ranking ranking = Ranking::weighted;
  std::vector<RankedSheet> sheets;
  std::vector<RankedChord> chords;

  std::string table(int max_rows) const;  ///< for people, at most so many of each kind
  nlohmann::ordered_json json() const;
};

/// Refusals are those found before anything is moved: filter_chord() and check_plan(). Writes
/// nothing. Cost O(#candidates × #vertices).
RankReport report_ranking(const HexMesh& mesh, const BaseComplex& bc,
                          const SimplifyOptions& options, Ranking ranking = Ranking::weighted);

}  // namespace hexweft
