#include "ovm/dual.h"

#include <algorithm>

#include "ovm/detail/disjoint_sets.h"

namespace hexweft {
namespace {

/// Numbers the sets of the elements for which `live` holds; -1 for the others.
template <class Live>
std::vector<int> number(detail::DisjointSets& sets, Live&& live, int& n_sets) {
  std::vector<int> result(sets.size(), -1);
  n_sets = 0;
  for (int i = 0; i < sets.size(); ++i) {
    if (!live(i)) continue;
    const int root = sets.find(i);  // the lowest of its set, which has its number
    result[i] = root == i ? n_sets++ : result[root];
  }
  return result;
}

// The face reached from side hf straight through its cell.
HalfFaceHandle across(HalfFaceHandle hf) { return HalfFaceHandle(hf.idx ^ 1); }

}  // namespace

std::vector<CellHandle> DualSheet::cells() const {
  std::vector<CellHandle> result;
  for (const CellAxis& x : crossings) {
    if (result.empty() || result.back() != x.cell) result.push_back(x.cell);
  }
  return result;
}

bool DualSheet::crosses_itself() const {
  return std::adjacent_find(crossings.begin(), crossings.end(),
                            [](const CellAxis& a, const CellAxis& b) {
                              return a.cell == b.cell;
                            }) != crossings.end();
}

DualSheet dual_sheet(const HexMesh& mesh, EdgeHandle seed) {
  DualSheet sheet;
  std::vector<char> reached(mesh.edge_slots(), 0);
  reached[seed.idx] = 1;
  sheet.edges.assign(1, seed);
  for (std::size_t i = 0; i < sheet.edges.size(); ++i) {
    const EdgeHandle e = sheet.edges[i];
    const auto cells = mesh.cells(e);
    for (auto it = cells.begin(); it != cells.end(); ++it) {
      const int axis = edge_axis(it.slot() % 12);
      const auto& edges = mesh.edges(*it);
      for (int k = 4 * axis; k < 4 * axis + 4; ++k) {
        if (reached[edges[k].idx]) continue;
        reached[edges[k].idx] = 1;
        sheet.edges.push_back(edges[k]);
      }
      // Listed once, from the first of its four edges.
      if (edges[4 * axis] == e) sheet.crossings.push_back({*it, axis});
    }
  }
  std::sort(sheet.edges.begin(), sheet.edges.end());
  std::sort(sheet.crossings.begin(), sheet.crossings.end());
  return sheet;
}

DualChord dual_chord(const HexMesh& mesh, FaceHandle f) {
  // Back to the boundary, or once round.
  HalfFaceHandle start = mesh.halfface(f);
  bool closed = false;
  while (mesh.opposite(start).valid()) {
    start = across(mesh.opposite(start));
    if (mesh.face(start) == f) {
      closed = true;
      break;
    }
  }
  DualChord chord;
  chord.closed = closed;
  for (HalfFaceHandle hf = start;;) {
    chord.faces.push_back(mesh.face(hf));
    chord.crossings.push_back({mesh.cell(hf), side_axis(HexMesh::side(hf))});
    const HalfFaceHandle end = across(hf);
    hf = mesh.opposite(end);
    if (closed && mesh.face(end) == chord.faces.front()) return chord;
    if (!hf.valid()) {
      chord.faces.push_back(mesh.face(end));
      return chord;
    }
  }
}

DualSheets extract_dual_sheets(const HexMesh& mesh) {
  detail::DisjointSets sets(mesh.edge_slots());
  for (CellHandle c : mesh.cells()) {
    const auto& e = mesh.edges(c);
    for (int k = 0; k < kHexEdges; k += 4) {
      for (int i = 1; i < 4; ++i) sets.join(e[k].idx, e[k + i].idx);
    }
  }
  DualSheets result;
  const auto live = [&](int i) { return mesh.is_live(EdgeHandle(i)); };
  result.of_edge = number(sets, live, result.n_sheets);
  return result;
}

DualChords extract_dual_chords(const HexMesh& mesh) {
  detail::DisjointSets sets(mesh.face_slots());
  for (CellHandle c : mesh.cells()) {
    for (int side = 0; side < kSides; side += 2) {
      sets.join(mesh.face(mesh.halfface(c, side)).idx, mesh.face(mesh.halfface(c, side + 1)).idx);
    }
  }
  DualChords result;
  const auto live = [&](int i) { return mesh.is_live(FaceHandle(i)); };
  result.of_face = number(sets, live, result.n_chords);
  return result;
}

std::vector<DualSheet> list_dual_sheets(const HexMesh& mesh) {
  const DualSheets sheets = extract_dual_sheets(mesh);
  std::vector<DualSheet> lists(sheets.n_sheets);
  for (EdgeHandle e : mesh.edges()) lists[sheets[e]].edges.push_back(e);
  for (CellHandle c : mesh.cells()) {
    for (int a = 0; a < 3; ++a) lists[sheets[mesh.edges(c)[4 * a]]].crossings.push_back({c, a});
  }
  return lists;
}

}  // namespace hexweft
