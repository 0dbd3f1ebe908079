#include <cstdio>
#include <limits>

#include "io/vtk_attributes.h"
#include "io/vtk_cells.h"
#include "io/vtk_grid.h"
#include "io/vtk_legacy.h"
#include "io/vtk_values.h"

namespace hexweft {
namespace {

using namespace detail;

class VtkReader {
 public:
  VtkReader(std::string_view text, const std::string& path) : in_(text, path) {}

  MeshData read() {
    read_header();
    while (!in_.at_end()) read_section();
    if (!have_dataset_) in_.fail_expected("DATASET UNSTRUCTURED_GRID");
    if (!have_points_) in_.fail_expected("POINTS");
    if (!have_cells_) in_.fail_expected("CELLS");
    if (!have_types_) in_.fail_expected("CELL_TYPES");
    return std::move(data_);
  }

 private:
  void read_header();
  void read_section();
  void read_dataset();
  void read_points();
  void read_data_header(bool of_points);
  void add_data(DataArray array);

  void once(bool& seen, const std::string& keyword) {
    if (seen) in_.fail(section_, keyword + " appears twice");
    seen = true;
  }

  TextScanner in_;
  MeshData data_;
  bool binary_ = false;
  bool have_dataset_ = false, have_points_ = false, have_cells_ = false, have_types_ = false;
  std::size_t section_ = 0;  // where the current section starts

  VtkCells cells_;
  enum class DataOf { nothing, points, cells } data_of_ = DataOf::nothing;
};

void VtkReader::read_header() {
  const std::string_view first = in_.rest_of_line();
  int major = 0, minor = 0;
  if (!is_vtk_legacy(first) || std::sscanf(std::string(first).c_str(),
                                           "# vtk DataFile Version %d.%d", &major, &minor) != 2) {
    in_.fail(0, "expected \"# vtk DataFile Version\" and a number, found " + quoted(first));
  }
  if (major < 1 || major > 5) {
    in_.fail(0, "expected a version from 1.0 to 5.1, found " + std::to_string(major) + "." +
                    std::to_string(minor));
  }
  in_.rest_of_line();  // the title
  const std::string encoding = lower_case(in_.peek());
  if (encoding != "ascii" && encoding != "binary") in_.fail_expected("ASCII or BINARY");
  binary_ = encoding == "binary";
  in_.rest_of_line();
}

void VtkReader::read_section() {
  section_ = (in_.peek(), in_.offset());
  const std::string keyword = lower_case(in_.peek());
  const auto starts = [&](const char* name) {
    if (keyword != name) return false;
    in_.next();
    return true;
  };
  if (starts("dataset")) return read_dataset();
  if (starts("metadata")) return skip_vtk_metadata(in_);
  if (starts("points")) return read_points();
  if (starts("cells")) {
    if (!have_points_) in_.fail(section_, "expected POINTS before CELLS");
    once(have_cells_, "CELLS");
    return cells_.read_corners(in_, binary_, section_);
  }
  if (starts("cell_types")) {
    if (!have_cells_) in_.fail(section_, "expected CELLS before CELL_TYPES");
    once(have_types_, "CELL_TYPES");
    return cells_.read_types(in_, binary_, section_, data_);
  }
  if (starts("point_data")) return read_data_header(true);
  if (starts("cell_data")) return read_data_header(false);
  const std::size_t rows = data_of_ == DataOf::nothing  ? 0
                           : data_of_ == DataOf::points ? data_.points.size()
                                                        : cells_.size();
  VtkAttributes found = read_vtk_attribute(in_, binary_, data_of_ != DataOf::nothing, rows);
  data_.notes.insert(data_.notes.end(), found.notes.begin(), found.notes.end());
  for (DataArray& array : found.arrays) add_data(std::move(array));
}

void VtkReader::read_dataset() {
  once(have_dataset_, "DATASET");
  if (lower_case(in_.peek()) != "unstructured_grid") in_.fail_expected("UNSTRUCTURED_GRID");
  in_.rest_of_line();
}

void VtkReader::read_points() {
  once(have_points_, "POINTS");
  const std::int64_t n = in_.read_count("a number of points", kMostPoints);
  const auto type = find_vtk_type(in_.peek());
  if (!type || type->kind == ValueKind::bit) in_.fail_expected("a type of coordinates");
  in_.rest_of_line();
  const VtkBlock block{"POINTS", section_, in_.offset(), binary_};
  const DataArray array = read_vtk_values(in_, block, *type, 3 * static_cast<std::size_t>(n));
  data_.points = points_of(array, [&](std::size_t place, const std::string& problem) {
    fail_at_value(in_, block, place, problem);
  });
}

void VtkReader::read_data_header(bool of_points) {
  if (!have_types_) in_.fail(section_, "expected CELL_TYPES before any data");
  const std::size_t rows = of_points ? data_.points.size() : cells_.size();
  const std::int64_t n = in_.read_count("a number of rows", std::numeric_limits<int>::max());
  if (n != static_cast<std::int64_t>(rows)) {
    in_.fail(section_, "expected data of " + std::to_string(rows) +
                           (of_points ? " points" : " cells") + ", found " + std::to_string(n));
  }
  in_.rest_of_line();
  data_of_ = of_points ? DataOf::points : DataOf::cells;
}

void VtkReader::add_data(DataArray array) {
  const bool of_cells = data_of_ == DataOf::cells;
  if (of_cells && cells_.hexahedra().size() < cells_.size()) keep_rows(array, cells_.hexahedra());
  add_array(of_cells ? data_.cell_data : data_.point_data, std::move(array), data_.notes);
}

}  // namespace

bool is_vtk_legacy(std::string_view text) { return text.starts_with("# vtk DataFile"); }

MeshData read_vtk_legacy(std::string_view text, const std::string& path) {
  return VtkReader(text, path).read();
}

}  // namespace hexweft
