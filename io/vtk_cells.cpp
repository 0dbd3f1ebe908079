#include "io/vtk_cells.h"

#include <algorithm>
#include <limits>
#include <map>

#include "ovm/hex_numbering.h"

namespace hexweft::detail {
namespace {

constexpr int kVoxel = 11, kHexahedron = 12;
constexpr std::array<int, 8> kVoxelToHexahedron{0, 1, 3, 2, 4, 5, 7, 6};
constexpr int kMostCells =
    std::numeric_limits<int>::max() / 12;  // 12 edge slots a cell, int indices

// Points, curves and surface cells of VTK, linear and curved.
bool has_no_volume(std::int64_t type) {
  static constexpr int kTypes[] = {0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  21, 22, 23, 28, 30,
                                   34, 35, 36, 51, 52, 53, 60, 61, 62, 68, 69, 70, 75, 76, 77};
  return std::find(std::begin(kTypes), std::end(kTypes), type) != std::end(kTypes);
}

std::string type_name(std::int64_t type) {
  static const std::map<std::int64_t, const char*> names{
      {10, "a tetrahedron"}, {13, "a wedge"}, {14, "a pyramid"}, {42, "a polyhedron"}};
  const auto it = names.find(type);
  return (it == names.end() ? "a cell" : it->second) + (" of type " + std::to_string(type));
}

}  // namespace

void VtkCells::read_corners(TextScanner& in, bool binary, std::size_t section) {
  const std::int64_t n = read_vtk_count(in, "a number of cells", kMostCells);
  const std::int64_t size = read_vtk_count(in, "the size of the cell list", std::int64_t{1} << 40);
  in.rest_of_line();
  corner_block_ = {"CELLS", section, in.offset(), binary};
  // Since version 5.1 the corners come in one list and a second list says where each cell's start.
  constexpr std::string_view kOffsets = "offsets";
  const bool offsets_ahead =
      binary ? lower_case(in.text().substr(in.offset(), kOffsets.size())) == kOffsets
             : lower_case(in.peek()) == kOffsets;
  if (offsets_ahead) return read_offsets(in, n, size);
  const DataArray records = read_vtk_values(in, corner_block_, *find_vtk_type("int"), size);
  split_records(in, records.integers, n);
}

// The list of versions before 5.1: for each cell its number of corners, then the corners.
void VtkCells::split_records(TextScanner& in, const std::vector<std::int64_t>& values,
                             std::int64_t n_cells) {
  corners_have_counts_ = true;
  corners_.reserve(values.size());
  std::size_t at = 0;
  for (std::int64_t c = 0; c < n_cells; ++c) {
    const std::int64_t left = static_cast<std::int64_t>(values.size() - at) - 1;
    if (left < 0 || values[at] < 0 || values[at] > left) {
      fail_at_value(in, corner_block_, at,
                    "cell " + std::to_string(c) + " of " + std::to_string(n_cells) +
                        " does not fit the announced " + std::to_string(values.size()) +
                        " numbers of CELLS");
    }
    const auto first = values.begin() + at + 1;
    corners_.insert(corners_.end(), first, first + values[at]);
    first_corner_.push_back(corners_.size());
    at += 1 + values[at];
  }
  if (at != values.size()) {
    in.fail(corner_block_.header, "CELLS: expected " + std::to_string(at) + " numbers for " +
                                      std::to_string(n_cells) + " cells, found " +
                                      std::to_string(values.size()) + " announced");
  }
}

void VtkCells::read_offsets(TextScanner& in, std::int64_t n_offsets, std::int64_t n_corners) {
  const auto read_list = [&](const char* keyword, std::int64_t n, VtkBlock& block) {
    const std::size_t header = (in.peek(), in.offset());
    if (lower_case(in.next()) != lower_case(keyword)) {
      in.seek(header);
      in.fail_expected(keyword);
    }
    const auto type = find_vtk_type(in.peek());
    if (!type || type->kind != ValueKind::integer) in.fail_expected("a type of integers");
    in.rest_of_line();
    block = {keyword, header, in.offset(), corner_block_.binary};
    return read_vtk_values(in, block, *type, n).integers;
  };
  VtkBlock block;
  const std::vector<std::int64_t> offsets = read_list("OFFSETS", n_offsets, block);
  corners_ = read_list("CONNECTIVITY", n_corners, corner_block_);
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    const std::int64_t least = i == 0 ? 0 : offsets[i - 1], most = i == 0 ? 0 : n_corners;
    if (offsets[i] < least || offsets[i] > most) {
      fail_at_value(in, block, i,
                    "expected an offset in [" + std::to_string(least) + ", " +
                        std::to_string(most) + "], found " + std::to_string(offsets[i]));
    }
    if (i > 0) first_corner_.push_back(offsets[i]);
  }
  if (first_corner_.back() != corners_.size()) {
    in.fail(block.header, "expected the last offset to be " + std::to_string(n_corners) +
                              ", found " + std::to_string(first_corner_.back()));
  }
}

void VtkCells::read_types(TextScanner& in, bool binary, std::size_t section, MeshData& data) {
  const std::int64_t n = read_vtk_count(in, "a number of cells", kMostCells);
  if (n != static_cast<std::int64_t>(size())) {
    in.fail(section, "expected types of " + std::to_string(size()) + " cells, found " +
                         std::to_string(n) + " announced");
  }
  in.rest_of_line();
  const VtkBlock block{"CELL_TYPES", section, in.offset(), binary};
  const auto types = read_vtk_values(in, block, *find_vtk_type("int"), n).integers;
  for (std::size_t c = 0; c < types.size(); ++c) {
    const bool is_hexahedron = types[c] == kHexahedron || types[c] == kVoxel;
    if (!is_hexahedron && !has_no_volume(types[c])) {
      fail_at_value(in, block, c,
                    "expected hexahedra (type 12), found cell " + std::to_string(c) + ", " +
                        type_name(types[c]));
    }
  }
  pick_hexahedra(in, types, data);
  if (data.cells.empty()) in.fail(section, "expected hexahedra, found none");
}

void VtkCells::pick_hexahedra(const TextScanner& in, const std::vector<std::int64_t>& types,
                              MeshData& data) {
  data.cells.reserve(types.size());
  for (int c = 0; c < static_cast<int>(types.size()); ++c) {
    if (has_no_volume(types[c])) continue;
    const std::size_t first = first_corner_[c], n_corners = first_corner_[c + 1] - first;
    if (n_corners != kCorners) {
      fail_at_cell(in, c, "has " + std::to_string(n_corners) + " corners, expected 8");
    }
    std::array<int, 8> cell;
    for (int i = 0; i < kCorners; ++i) {
      const std::int64_t v = corners_[first + (types[c] == kVoxel ? kVoxelToHexahedron[i] : i)];
      const auto n_points = static_cast<std::int64_t>(data.points.size());
      if (v < 0 || v >= n_points) {
        fail_at_cell(in, c,
                     "uses vertex " + std::to_string(v) + ", expected one of [0, " +
                         std::to_string(n_points - 1) + "]");
      }
      cell[i] = static_cast<int>(v);
    }
    data.cells.push_back(cell);
    hexahedra_.push_back(c);
  }
  check_cells(data, 0,
              [&](int c, const std::string& problem) { fail_at_cell(in, hexahedra_[c], problem); });
  if (const std::size_t others = types.size() - data.cells.size()) {
    data.notes.push_back(std::to_string(others) +
                         " cells without volume (points, lines, faces) were left out");
  }
}

void VtkCells::fail_at_cell(const TextScanner& in, int cell, const std::string& problem) const {
  const std::size_t counts_before = corners_have_counts_ ? cell : 0;
  fail_at_value(in, corner_block_, first_corner_[cell] + counts_before,
                "cell " + std::to_string(cell) + " " + problem);
}

}  // namespace hexweft::detail
