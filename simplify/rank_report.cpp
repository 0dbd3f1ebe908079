#include "simplify/rank_report.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace hexweft {
namespace {

template <class Ranked>
void sort_by_cost(std::vector<Ranked>& list, Ranking ranking) {
  std::stable_sort(list.begin(), list.end(), [&](const Ranked& a, const Ranked& b) {
    return a.terms.cost(ranking) < b.terms.cost(ranking);
  });
}

template <class Ranked>
void put_passing_first(std::vector<Ranked>& list) {
  std::stable_partition(list.begin(), list.end(),
                        [](const Ranked& r) { return r.refusal == Refusal::none; });
}

template <class Ranked>
int n_passing(const std::vector<Ranked>& list) {
  return static_cast<int>(std::count_if(
      list.begin(), list.end(), [](const Ranked& r) { return r.refusal == Refusal::none; }));
}

template <class Ranked>
std::string heading(const std::vector<Ranked>& list, const char* what, std::string_view order) {
  return fmt::format("{} {}, {} of them pass the filters, by {}\n", list.size(), what,
                     n_passing(list), order);
}

template <class Ranked>
std::string rest(const std::vector<Ranked>& list, int max_rows) {
  const int left = static_cast<int>(list.size()) - max_rows;
  return left > 0 ? fmt::format("  and {} more\n", left) : "";
}

std::string state(Refusal r) { return r == Refusal::none ? "" : std::string(name(r)); }

nlohmann::ordered_json to_json(const RankedSheet& s) {
  return {{"id", s.id},
          {"kind", name(s.kind)},
          {"width", s.width},
          {"base_edges", s.base_edges},
          {"cells", s.cells},
          {"energy", s.terms.energy},
          {"valence_term", s.terms.valence},
          {"width_term", s.terms.width},
          {"distortion_term", s.terms.distortion},
          {"thickness", s.terms.thickness},
          {"refusal", name(s.refusal)}};
}

nlohmann::ordered_json to_json(const RankedChord& c) {
  return {{"id", c.id},
          {"closed", c.closed},
          {"components", c.components},
          {"cells", c.cells},
          {"diagonal", c.terms.diagonal == Diagonal::first ? "first" : "second"},
          {"energy", c.terms.energy},
          {"valence_term", c.terms.valence},
          {"geometry_term", c.terms.geometry},
          {"deviation", c.terms.deviation},
          {"singular_groups", c.terms.singular_groups},
          {"thickness", c.terms.thickness},
          {"refusal", name(c.refusal)}};
}

nlohmann::ordered_json to_json(const RankedPeel& p) {
  return {{"id", p.id},       {"kind", name(p.kind)},
          {"width", p.width}, {"components", p.components},
          {"cells", p.cells}, {"refusal", name(p.refusal)}};
}

nlohmann::ordered_json to_json(const RankedPillow& p) {
  return {{"id", p.id},         {"sheet", p.sheet}, {"kind", name(p.kind)}, {"width", p.width},
          {"inside", p.inside}, {"added", p.added}, {"gain", p.gain}};
}

RankedSheet report_sheet(const HexMesh& mesh, const BaseComplex& bc, const CandidateQueues& q,
                         int id, const SimplifyOptions& options) {
  const Sheet& s = q.sheets[id];
  const CollapsePlan plan = plan_sheet_collapse(mesh, bc, s);
  return {id,
          s.kind,
          s.width,
          static_cast<int>(s.edges.size()),
          static_cast<int>(plan.removed.size()),
          q.sheet_terms[id],
          check_plan(mesh, bc.graph, plan, options.valence)};
}

RankedChord report_chord(const HexMesh& mesh, const BaseComplex& bc, const CandidateQueues& q,
                         int id, const SimplifyOptions& options) {
  const Chord& c = q.chords[id];
  const ChordTerms& terms = q.chord_terms[id];
  RankedChord r = {.id = id,
                   .closed = c.closed,
                   .components = static_cast<int>(c.links.size()),
                   .terms = terms,
                   .refusal = filter_chord(bc, c, terms, q.sheets, options)};
  if (can_plan(bc, c, q.sheets) != Refusal::none) return r;
  const CollapsePlan plan = plan_chord_collapse(mesh, bc, c, terms.diagonal, q.sheets);
  r.cells = static_cast<int>(plan.removed.size());
  if (r.refusal == Refusal::none) r.refusal = check_plan(mesh, bc.graph, plan, options.valence);
  return r;
}

RankedPeel report_peel(const HexMesh& mesh, const BaseComplex& bc, const Peel& peel, int id,
                       const SimplifyOptions& options) {
  const CollapsePlan plan = plan_peel(mesh, bc, peel);
  return {id,
          peel.kind,
          peel.width,
          static_cast<int>(peel.components.size()),
          static_cast<int>(plan.removed.size()),
          check_plan(mesh, bc.graph, plan, options.valence)};
}

RankedPillow report_pillow(const Sheet& sheet, const PillowedSheet& p, int id) {
  return {id,
          p.sheet,
          sheet.kind,
          sheet.width,
          static_cast<int>(p.pillow.inside.size()),
          p.pillow.added,
          p.gain};
}

}  // namespace

RankReport report_ranking(const HexMesh& mesh, const BaseComplex& bc,
                          const std::vector<char>& on_feature, const SimplifyOptions& options,
                          Ranking ranking) {
  validate(options.weights);
  const CandidateQueues q = make_queues(mesh, bc, options, ranking);
  RankReport report;
  report.ranking = ranking;
  for (int i = 0; i < static_cast<int>(q.sheets.size()); ++i) {
    report.sheets.push_back(report_sheet(mesh, bc, q, i, options));
  }
  for (int i = 0; i < static_cast<int>(q.chords.size()); ++i) {
    report.chords.push_back(report_chord(mesh, bc, q, i, options));
  }
  const std::vector<Peel> peels = extract_peels(bc, q.sheets, on_feature);
  for (int i = 0; i < static_cast<int>(peels.size()); ++i) {
    report.peels.push_back(report_peel(mesh, bc, peels[i], i, options));
  }
  HexMesh scratch = mesh;
  const std::vector<PillowedSheet> pillows = find_pillows(scratch, bc, q.sheets, options.valence);
  for (int i = 0; i < static_cast<int>(pillows.size()); ++i) {
    report.pillows.push_back(report_pillow(q.sheets[pillows[i].sheet], pillows[i], i));
  }
  sort_by_cost(report.sheets, ranking);
  sort_by_cost(report.chords, ranking);
  put_passing_first(report.sheets);
  put_passing_first(report.chords);
  put_passing_first(report.peels);
  return report;
}

std::string RankReport::table(int max_rows) const {
  const std::string_view order = ranking == Ranking::weighted ? "energy" : "thickness";
  std::string s = heading(sheets, "sheets", order);
  s += fmt::format("{:>7} {:>8} {:>9} {:>9} {:>9} {:>9} {:>6} {:>7}  {:<12}  {}\n", "sheet",
                   "energy", "valence", "width", "distort.", "thickness", "layers", "cells", "kind",
                   "refusal");
  for (int i = 0; i < std::min<int>(max_rows, static_cast<int>(sheets.size())); ++i) {
    const RankedSheet& r = sheets[i];
    s += fmt::format("{:>7} {:>8.4f} {:>9.4f} {:>9.4f} {:>9.4f} {:>9.4f} {:>6} {:>7}  {:<12}  {}\n",
                     r.id, r.terms.energy, r.terms.valence, r.terms.width, r.terms.distortion,
                     r.terms.thickness, r.width, r.cells, name(r.kind), state(r.refusal));
  }
  s += rest(sheets, max_rows) + heading(chords, "chords", order);
  s += fmt::format("{:>7} {:>8} {:>9} {:>9} {:>9} {:>9} {:>6} {:>7}  {:<12}  {}\n", "chord",
                   "energy", "valence", "geometry", "deviation", "thickness", "links", "cells",
                   "diagonal", "refusal");
  for (int i = 0; i < std::min<int>(max_rows, static_cast<int>(chords.size())); ++i) {
    const RankedChord& r = chords[i];
    s += fmt::format("{:>7} {:>8.4f} {:>9.4f} {:>9.4f} {:>9.4f} {:>9.4f} {:>6} {:>7}  {:<12}  {}\n",
                     r.id, r.terms.energy, r.terms.valence, r.terms.geometry, r.terms.deviation,
                     r.terms.thickness, r.components, r.cells,
                     r.terms.diagonal == Diagonal::first ? "first" : "second", state(r.refusal));
  }
  s += rest(chords, max_rows) + heading(peels, "peels", "components");
  s += fmt::format("{:>7} {:>10} {:>6} {:>7}  {:<12}  {}\n", "peel", "components", "layers",
                   "cells", "kind", "refusal");
  for (int i = 0; i < std::min<int>(max_rows, static_cast<int>(peels.size())); ++i) {
    const RankedPeel& r = peels[i];
    s += fmt::format("{:>7} {:>10} {:>6} {:>7}  {:<12}  {}\n", r.id, r.components, r.width, r.cells,
                     name(r.kind), state(r.refusal));
  }
  s += rest(peels, max_rows) +
       fmt::format("{} pillows that take the way free for a sheet, by gain\n", pillows.size());
  s += fmt::format("{:>7} {:>7} {:>6} {:>7} {:>7} {:>6}  {}\n", "pillow", "sheet", "gain", "added",
                   "inside", "layers", "kind");
  for (int i = 0; i < std::min<int>(max_rows, static_cast<int>(pillows.size())); ++i) {
    const RankedPillow& r = pillows[i];
    s += fmt::format("{:>7} {:>7} {:>6} {:>7} {:>7} {:>6}  {}\n", r.id, r.sheet, r.gain, r.added,
                     r.inside, r.width, name(r.kind));
  }
  return s + rest(pillows, max_rows);
}

nlohmann::ordered_json RankReport::json() const {
  nlohmann::ordered_json j = {{"ranking", name(ranking)}};
  j["sheets"] = nlohmann::ordered_json::array();
  j["chords"] = nlohmann::ordered_json::array();
  j["peels"] = nlohmann::ordered_json::array();
  j["pillows"] = nlohmann::ordered_json::array();
  for (const RankedSheet& s : sheets) j["sheets"].push_back(to_json(s));
  for (const RankedChord& c : chords) j["chords"].push_back(to_json(c));
  for (const RankedPeel& p : peels) j["peels"].push_back(to_json(p));
  for (const RankedPillow& p : pillows) j["pillows"].push_back(to_json(p));
  return j;
}

}  // namespace hexweft
