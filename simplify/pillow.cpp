#include "simplify/pillow.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <unordered_map>

#include "ovm/detail/sort_unique.h"
#include "simplify/component_cut.h"

namespace hexweft {

std::vector<int> components_of(const Sheet& sheet) {
  std::vector<int> crossed;
  for (const Crossing& x : sheet.crossings) crossed.push_back(x.component);
  detail::sort_unique(crossed);
  return crossed;
}

std::vector<char> sides_of_sheet(const HexMesh& mesh, const BaseComplex& bc, const Sheet& sheet) {
  std::vector<char> sides(mesh.vertex_slots(), 0);
  for (const Crossing& x : sheet.crossings) {
    const Component& c = bc.components[x.component];
    const bool against = runs_against(bc, sheet, x);
    const int u = (x.axis + 1) % 3, v = (x.axis + 2) % 3;
    std::array<int, 3> at;
    for (int end = 0; end < 2; ++end) {
      at[x.axis] = end * c.n[x.axis];
      const char side = (end == 1) != against ? 2 : 1;
      for (at[u] = 0; at[u] <= c.n[u]; ++at[u]) {
        for (at[v] = 0; at[v] <= c.n[v]; ++at[v])
          sides[bc.vertex(c, at[0], at[1], at[2]).idx] |= side;
      }
    }
  }
  return sides;
}

std::optional<Pillow> smallest_pillow(const HexMesh& mesh, const BaseComplex& bc,
                                      const Sheet& sheet, const CollapsePlan& plan,
                                      std::span<const int> groups, int side) {
  const std::vector<char> sides = sides_of_sheet(mesh, bc, sheet);
  const std::vector<int> crossed = components_of(sheet);
  std::vector<int> inside, outside;
  for (int g : groups) {
    for (VertexHandle v : plan.group(g)) {
      for (CellHandle cell : mesh.cells(v)) {
        const int c = bc.component_of_cell[cell.idx];
        if (std::binary_search(crossed.begin(), crossed.end(), c)) continue;
        (sides[v.idx] & (1 << side) ? inside : outside).push_back(c);
      }
    }
  }
  outside.insert(outside.end(), crossed.begin(), crossed.end());
  detail::sort_unique(inside);
  detail::sort_unique(outside);
  std::vector<int> both;
  std::set_intersection(inside.begin(), inside.end(), outside.begin(), outside.end(),
                        std::back_inserter(both));
  if (inside.empty() || !both.empty()) return std::nullopt;
  const ComponentCut cut = smallest_cut(bc, inside, outside);
  Pillow pillow;
  pillow.added = cut.n_faces;
  for (int c = 0; c < static_cast<int>(cut.inside.size()); ++c) {
    if (cut.inside[c]) pillow.inside.push_back(c);
  }
  return pillow;
}

namespace {

bool is_inside(const BaseComplex& bc, const Pillow& pillow, CellHandle cell) {
  return std::binary_search(pillow.inside.begin(), pillow.inside.end(),
                            bc.component_of_cell[cell.idx]);
}

// The copies that a layer has given its inside, by the index of the vertex as it was.
std::unordered_map<int, VertexHandle> inner_copies(const SheetInsertion& layer) {
  std::unordered_map<int, VertexHandle> inner;
  for (const auto& copy : layer.copies) inner[copy.outer.idx] = copy.inner;
  return inner;
}

// The sheet through the same mesh edges in a new base complex, if there is one.
std::optional<Sheet> find_again(const HexMesh& mesh, const BaseComplex& before, const Sheet& sheet,
                                const InsertedPillow& now) {
  const auto inner = inner_copies(now.layer);
  const auto vertex = [&](VertexHandle v) {
    const auto copy = inner.find(v.idx);
    return copy == inner.end() ? v : copy->second;
  };
  const BaseComplex& bc = now.base_complex;
  for (int e : sheet.edges) {
    const auto chain = before.chain(before.edges[e]);
    const HalfEdgeHandle first = mesh.find_halfedge(vertex(chain[0]), vertex(chain[1]));
    const int id = first.valid() ? bc.base_edge_of_edge[mesh.edge(first).idx] : -1;
    if (id < 0) continue;
    for (Sheet& s : extract_sheets(bc)) {
      if (std::binary_search(s.edges.begin(), s.edges.end(), id)) return std::move(s);
    }
  }
  return std::nullopt;
}

// The cells as they are called now.
std::vector<CellHandle> replaced(std::vector<CellHandle> cells, const SheetInsertion& layer) {
  std::unordered_map<int, CellHandle> after;
  for (const auto& r : layer.replaced) after[r.before.idx] = r.after;
  for (CellHandle& c : cells) {
    if (const auto found = after.find(c.idx); found != after.end()) c = found->second;
  }
  std::sort(cells.begin(), cells.end());
  return cells;
}

}  // namespace

std::vector<VertexHandle> wall_of(const HexMesh& mesh, const BaseComplex& bc,
                                  const Pillow& pillow) {
  std::vector<VertexHandle> wall;
  for (VertexHandle v : mesh.vertices()) {
    bool has_inside = false, has_outside = false;
    for (CellHandle c : mesh.cells(v)) (is_inside(bc, pillow, c) ? has_inside : has_outside) = true;
    if (has_inside && has_outside) wall.push_back(v);
  }
  return wall;
}

std::optional<InsertedPillow> insert_pillow(HexMesh& mesh, const BaseComplex& bc,
                                            const Sheet& sheet, const CollapsePlan& plan,
                                            const Pillow& pillow) {
  std::vector<CellHandle> outside;
  for (CellHandle c : mesh.cells()) {
    if (!is_inside(bc, pillow, c)) outside.push_back(c);
  }
  InsertedPillow result;
  result.layer = insert_sheet(mesh, outside);
  if (result.layer.refusal != InsertRefusal::none) return std::nullopt;
  result.base_complex = extract_base_complex(mesh);
  if (result.base_complex.irregular > 0) return std::nullopt;
  const auto now = find_again(mesh, bc, sheet, result);
  if (!now) return std::nullopt;
  result.plan = plan_sheet_collapse(mesh, result.base_complex, *now);
  if (result.plan.removed != replaced(plan.removed, result.layer)) return std::nullopt;
  return result;
}

}  // namespace hexweft
