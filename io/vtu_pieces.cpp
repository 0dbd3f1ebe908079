#include "io/vtu_pieces.h"

#include <algorithm>
#include <optional>
#include <set>

namespace hexweft::detail {
namespace {

using Tables = std::vector<std::vector<DataArray>*>;  // the data arrays of each piece

const DataArray* find_like(const std::vector<DataArray>& arrays, const DataArray& array) {
  const auto it = std::find_if(arrays.begin(), arrays.end(), [&](const DataArray& other) {
    return other.name == array.name && other.kind == array.kind &&
           other.components == array.components;
  });
  return it == arrays.end() ? nullptr : &*it;
}

// The array with the rows of all pieces; empty if one has none like it.
std::optional<DataArray> joined(const DataArray& array, const Tables& tables) {
  DataArray result = array;
  result.integers.clear();
  result.reals.clear();
  for (const std::vector<DataArray>* arrays : tables) {
    const DataArray* part = find_like(*arrays, array);
    if (!part) return std::nullopt;
    result.integers.insert(result.integers.end(), part->integers.begin(), part->integers.end());
    result.reals.insert(result.reals.end(), part->reals.begin(), part->reals.end());
  }
  return result;
}

std::vector<DataArray> join_arrays(const Tables& tables, std::vector<std::string>& notes) {
  std::vector<DataArray> result;
  std::set<std::string> names;
  for (const std::vector<DataArray>* arrays : tables) {
    for (const DataArray& array : *arrays) {
      if (!names.insert(array.name).second) continue;
      if (auto whole = joined(array, tables)) {
        result.push_back(std::move(*whole));
      } else {
        notes.push_back("data array \"" + array.name +
                        "\" was left out: not every piece of the file has it, or not alike");
      }
    }
  }
  return result;
}

}  // namespace

MeshData join_pieces(std::vector<MeshData> pieces) {
  if (pieces.size() == 1) return std::move(pieces.front());
  MeshData whole;
  Tables of_points, of_cells;
  for (MeshData& piece : pieces) {
    if (!piece.points.empty()) of_points.push_back(&piece.point_data);
    if (!piece.cells.empty()) of_cells.push_back(&piece.cell_data);
    const int first = static_cast<int>(whole.points.size());
    whole.points.insert(whole.points.end(), piece.points.begin(), piece.points.end());
    for (std::array<int, 8> cell : piece.cells) {
      for (int& corner : cell) corner += first;
      whole.cells.push_back(cell);
    }
    for (std::string& note : piece.notes) {  // what every piece has is told once
      const auto end = whole.notes.end();
      if (std::find(whole.notes.begin(), end, note) == end) whole.notes.push_back(std::move(note));
    }
  }
  whole.point_data = join_arrays(of_points, whole.notes);
  whole.cell_data = join_arrays(of_cells, whole.notes);
  if (of_cells.size() > 1) {
    whole.notes.push_back(std::to_string(of_cells.size()) +
                          " pieces were put beside each other; points that they share were not "
                          "joined");
  }
  return whole;
}

}  // namespace hexweft::detail
