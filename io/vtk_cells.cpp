#include "io/vtk_cells.h"

namespace hexweft::detail {

void VtkCells::read_corners(TextScanner& in, bool binary, std::size_t section) {
  const std::int64_t n = in.read_count("a number of cells", kMostCells);
  const std::int64_t size = in.read_count("the size of the cell list", std::int64_t{1} << 40);
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
  list_.corners.reserve(values.size());
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
    list_.corners.insert(list_.corners.end(), first, first + values[at]);
    list_.first_corner.push_back(list_.corners.size());
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
  list_.corners = read_list("CONNECTIVITY", n_corners, corner_block_);
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    const std::int64_t least = i == 0 ? 0 : offsets[i - 1], most = i == 0 ? 0 : n_corners;
    if (offsets[i] < least || offsets[i] > most) {
      fail_at_value(in, block, i,
                    "expected an offset in [" + std::to_string(least) + ", " +
                        std::to_string(most) + "], found " + std::to_string(offsets[i]));
    }
    if (i > 0) list_.first_corner.push_back(offsets[i]);
  }
  if (list_.first_corner.back() != list_.corners.size()) {
    in.fail(block.header, "expected the last offset to be " + std::to_string(n_corners) +
                              ", found " + std::to_string(list_.first_corner.back()));
  }
}

void VtkCells::read_types(TextScanner& in, bool binary, std::size_t section, MeshData& data) {
  const std::int64_t n = in.read_count("a number of cells", kMostCells);
  if (n != static_cast<std::int64_t>(size())) {
    in.fail(section, "expected types of " + std::to_string(size()) + " cells, found " +
                         std::to_string(n) + " announced");
  }
  in.rest_of_line();
  const VtkBlock block{"CELL_TYPES", section, in.offset(), binary};
  list_.types = read_vtk_values(in, block, *find_vtk_type("int"), n).integers;
  check_vtk_types(list_, [&](int cell, const std::string& problem) {
    fail_at_value(in, block, cell, problem);
  });
  hexahedra_ = pick_hexahedra(
      list_, data, [&](int cell, const std::string& problem) { fail_at_cell(in, cell, problem); });
  note_cells_without_volume(size() - hexahedra_.size(), data.notes);
  if (data.cells.empty()) in.fail(section, "expected hexahedra, found none");
}

void VtkCells::fail_at_cell(const TextScanner& in, int cell, const std::string& problem) const {
  const std::size_t counts_before = corners_have_counts_ ? cell : 0;
  fail_at_value(in, corner_block_, list_.first_corner[cell] + counts_before,
                "cell " + std::to_string(cell) + " " + problem);
}

}  // namespace hexweft::detail
