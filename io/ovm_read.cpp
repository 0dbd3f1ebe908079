#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "io/ovm.h"
#include "io/ovm_topology.h"
#include "io/ovm_types.h"
#include "io/text_scanner.h"
#include "ovm/hex_numbering.h"

namespace hexweft {
namespace {

using namespace detail;

class OvmReader {
 public:
  OvmReader(std::string_view text, const std::string& path) : in_(text, path) {}

  MeshData read() {
    read_header();
    read_vertices();
    read_rows("Edges", "edge", "vertices", data_.points.size(), topology_.edges);
    read_rows("Faces", "face", "half-edges", 2 * topology_.edges.size(), topology_.faces);
    const std::size_t first_cell = read_rows("Polyhedra", "polyhedron", "half-faces",
                                             2 * topology_.faces.size(), topology_.cells);
    make_hexahedra(first_cell);
    while (!in_.at_end()) read_property();
    return std::move(data_);
  }

 private:
  void read_header();
  void read_vertices();
  std::int64_t read_count(const char* section, int most);
  template <std::size_t n>
  std::size_t read_rows(const char* section, const char* what, const char* parts,
                        std::size_t n_parts, std::vector<std::array<int, n>>& rows);
  void make_hexahedra(std::size_t first_cell);
  void read_property();
  DataArray read_values(const OvmType& type, std::size_t rows);
  void skip_values(std::string_view type, std::size_t rows);
  void skip_strings(std::size_t n);

  /// Reads a number of a row that began at `start`; rows do not go on in the next line.
  template <class T>
  void read_in_row(std::size_t start, T& value, const std::string& what) {
    const std::size_t before = (in_.peek(), in_.offset());
    const auto gap = in_.text().substr(start, before - start);
    if (gap.find('\n') != gap.npos) {
      in_.fail(start, "expected " + what + ", found the end of the line");
    }
    if (!in_.read(value)) in_.fail_expected(what);
  }
  std::size_t start_of_row() { return (in_.peek(), in_.offset()); }
  TextScanner in_;
  MeshData data_;
  OvmTopology topology_;
};

// Files of old versions start with the vertices.
void OvmReader::read_header() {
  if (lower_case(in_.peek()) == "vertices") return;
  if (lower_case(in_.peek()) != "ovm") in_.fail_expected("OVM ASCII");
  in_.next();
  if (lower_case(in_.peek()) != "ascii") in_.fail_expected("ASCII");
  in_.rest_of_line();
}

std::int64_t OvmReader::read_count(const char* section, int most) {
  if (lower_case(in_.peek()) != lower_case(section)) in_.fail_expected(section);
  in_.rest_of_line();
  const std::int64_t n = in_.read_count("a number of " + lower_case(section), most);
  in_.rest_of_line();
  return n;
}

void OvmReader::read_vertices() {
  const std::int64_t n = read_count("Vertices", kMostPoints);
  data_.points.reserve(in_.room_for(n, 3));
  for (std::int64_t i = 0; i < n; ++i) {
    const std::size_t start = start_of_row();
    const std::string what =
        "a finite coordinate of vertex " + std::to_string(i) + " of " + std::to_string(n);
    Eigen::Vector3d p;
    for (double& x : p) {
      const std::size_t before = (in_.peek(), in_.offset());
      read_in_row(start, x, what);
      if (!std::isfinite(x)) {
        in_.seek(before);
        in_.fail_expected(what);
      }
    }
    in_.rest_of_line();
    data_.points.push_back(p);
  }
}

/// Rows of indices in [0, n_parts); those of faces and polyhedra begin with their number, which has to
/// be n. \return where the first starts
template <std::size_t n>
std::size_t OvmReader::read_rows(const char* section, const char* what, const char* parts,
                                 std::size_t n_parts, std::vector<std::array<int, n>>& rows) {
  constexpr int kMost = n == kSides ? kMostCells : kMostPoints;
  const std::int64_t count = read_count(section, kMost);
  rows.reserve(in_.room_for(count, n));
  const std::size_t first = in_.offset();
  for (std::int64_t i = 0; i < count; ++i) {
    const std::size_t start = start_of_row();
    const std::string of = std::string(" of ") + what + " " + std::to_string(i);
    if (n > 2) {
      std::int64_t size;
      read_in_row(start, size, std::string("the number of ") + parts + of);
      if (size != n) {
        in_.fail(start, std::string(what) + " " + std::to_string(i) + " has " +
                            std::to_string(size) + " " + parts + ", expected " + std::to_string(n) +
                            ": only hexahedra can be read");
      }
    }
    std::array<int, n> row;
    for (int& index : row) {
      std::int64_t value;
      read_in_row(start, value, std::string("one of the ") + parts + of);
      if (value < 0 || value >= static_cast<std::int64_t>(n_parts)) {
        in_.fail(start, std::string(what) + " " + std::to_string(i) + " has " +
                            std::to_string(value) + " among its " + parts + ", expected [0, " +
                            std::to_string(std::int64_t(n_parts) - 1) + "]");
      }
      index = static_cast<int>(value);
    }
    in_.rest_of_line();
    rows.push_back(row);
  }
  return first;
}

void OvmReader::make_hexahedra(std::size_t first_cell) {
  if (topology_.cells.empty()) in_.fail(first_cell, "expected hexahedra, found none");
  const auto fail = [&](int cell, const std::string& problem) {
    in_.seek(first_cell);
    for (int i = 0; i < cell; ++i) in_.peek(), in_.rest_of_line();
    in_.fail(start_of_row(), "polyhedron " + std::to_string(cell) + " " + problem);
  };
  add_hexahedra(topology_, data_, fail);
}

void OvmReader::read_property() {
  const std::size_t header = start_of_row();
  const auto entity = find_ovm_entity(in_.peek());
  if (!entity) in_.fail_expected("a property, as VProp or CProp");
  in_.next();
  const std::string_view type_name = in_.next();
  std::string_view name = in_.rest_of_line();
  const std::size_t quote = name.find('"');
  if (quote == name.npos) in_.fail(header, "expected the name of a property in quotation marks");
  name.remove_prefix(quote + 1);
  while (name.ends_with('"')) name.remove_suffix(1);
  const std::size_t rows = count(*entity, data_.points.size(), topology_);
  const bool of_cells = *entity == OvmEntity::cell;
  const OvmType* type = find_ovm_type(OvmFile::text, type_name);
  if (type && (of_cells || *entity == OvmEntity::vertex)) {
    DataArray array = read_values(*type, rows);
    array.name = name;
    return add_array(of_cells ? data_.cell_data : data_.point_data, std::move(array), data_.notes);
  }
  data_.notes.push_back(left_out_note(*entity, type_name, name));
  skip_values(type_name, rows);
}

DataArray OvmReader::read_values(const OvmType& type, std::size_t rows) {
  DataArray array;
  array.kind = type.kind;
  array.components = type.components;
  const std::string of = " of a property of type " + std::string(type.text_name);
  for (std::size_t i = 0; i < rows; ++i) {
    const std::size_t start = start_of_row();
    for (int k = 0; k < type.components; ++k) {
      if (type.kind == ValueKind::real) {
        read_in_row(start, array.reals.emplace_back(), "a number in row " + std::to_string(i) + of);
      } else {
        read_in_row(start, array.integers.emplace_back(),
                    "an integer in row " + std::to_string(i) + of);
      }
    }
    in_.rest_of_line();
  }
  return array;
}

// Values whose layout is not known end where the next property starts.
void OvmReader::skip_values(std::string_view type, std::size_t rows) {
  if (type == "string") return skip_strings(rows);
  while (in_.remaining() > 0) {
    const std::size_t line = in_.offset();
    const std::string_view rest = in_.rest_of_line();
    const std::string word = lower_case(rest.substr(0, rest.find_first_of(" \t")));
    if (!find_ovm_entity(word) || rest.find('"') == rest.npos) continue;
    in_.seek(line);
    return;
  }
}

// The length in bytes, a colon, the bytes, which may be anything.
void OvmReader::skip_strings(std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t start = start_of_row();
    const char* begin = in_.text().data() + start;
    const char* end = in_.text().data() + in_.text().size();
    std::size_t length = 0;
    const auto [stop, error] = std::from_chars(begin, end, length);
    if (error != std::errc() || stop == end || *stop != ':' ||
        length > static_cast<std::size_t>(end - stop - 1)) {
      in_.fail_expected("a string with its length, as 5:hello");
    }
    in_.seek(stop + 1 + length - in_.text().data());
    in_.rest_of_line();
  }
}

}  // namespace

bool is_ovm(std::string_view text) {
  TextScanner in(text, "");
  const std::string first = lower_case(in.next());
  return first == "ovm" || first == "vertices";
}

MeshData read_ovm(std::string_view text, const std::string& path) {
  return OvmReader(text, path).read();
}

}  // namespace hexweft
