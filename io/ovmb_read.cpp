#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "io/byte_scanner.h"
#include "io/ovm.h"
#include "io/ovm_topology.h"
#include "io/ovm_types.h"
#include "io/ovmb_layout.h"

namespace hexweft {
namespace {

using namespace detail;

struct Span {
  std::uint64_t first;
  std::size_t count;
};

struct PropertyOfFile {
  OvmEntity entity;
  std::string name, type_name;
  const OvmType* type;  // null if it is left out
  DataArray default_row;
  std::vector<std::pair<Span, DataArray>> parts;
};

class OvmbReader {
 public:
  OvmbReader(std::string_view bytes, const std::string& path) : in_(bytes, path) {}

  MeshData read() {
    read_header();
    while (!ended_) read_chunk();
    if (in_.remaining() > 0) in_.fail(in_.offset(), "expected nothing after the chunk \"EOF \"");
    check_counts();
    add_hexahedra(topology_, data_, [&](int cell, const std::string& problem) {
      in_.fail(cells_at_, "cell " + std::to_string(cell) + " " + problem);
    });
    for (const PropertyOfFile& property : properties_) keep(property);
    return std::move(data_);
  }

 private:
  void read_header();
  void read_chunk();
  void read_payload(std::string_view type);
  Span read_span(std::uint64_t most);
  void read_vertices();
  void read_topology();
  template <std::size_t n>
  void read_rows(const std::string& what, std::size_t n_parts,
                 std::vector<std::array<int, n>>& rows);
  void read_directory();
  void read_values();
  DataArray read_numbers(const OvmType& type, std::size_t rows, bool packed);
  void check_counts();
  void keep(const PropertyOfFile& property);

  ByteScanner in_;
  std::array<std::uint64_t, 4> announced_{};  // vertices, edges, faces, cells
  MeshData data_;
  OvmTopology topology_;
  std::vector<PropertyOfFile> properties_;
  std::size_t cells_at_ = 0;  // the chunk of the last cells
  bool ended_ = false, have_directory_ = false;
};

void OvmbReader::read_header() {
  if (in_.take(kOvmbMagic.size(), "the start of an .ovmb file") != kOvmbMagic) {
    in_.fail(0, "expected the start of an .ovmb file, found something else");
  }
  in_.number(1, "the version of the file");
  in_.number(1, "a header of version", kOvmbVersion, kOvmbVersion);
  in_.number(1, "vertices of dimension", 3, 3);
  const std::size_t at = in_.offset();
  const std::uint64_t topology = in_.number(1, "the kind of cells", 0, kOvmbHexahedral);
  if (topology == kOvmbTetrahedral) in_.fail(at, "expected hexahedra, found tetrahedra announced");
  in_.zeros(4, "a reserved byte");
  for (std::uint64_t& n : announced_) {
    const int most = &n == &announced_.back() ? kMostCells : kMostPoints;
    n = in_.number(8, "a number of elements", 0, most);
  }
}

void OvmbReader::read_chunk() {
  const std::size_t header = in_.offset();
  const std::string_view type = in_.take(4, "another chunk; the last is \"EOF \"");
  const std::uint64_t version = in_.number(1, "the version of a chunk");
  const std::uint64_t padding = in_.number(1, "padding", 0, 7);
  in_.number(1, "the compression", 0, 0);
  const bool mandatory = in_.number(1, "whether a chunk is mandatory", 0, 1) == kOvmbMandatory;
  const std::uint64_t length = in_.number(8, "the length of a chunk", padding, in_.remaining() - 8);
  const bool known =
      version == 0 && (type == kOvmbVertices || type == kOvmbTopology || type == kOvmbDirectory ||
                       type == kOvmbValues || type == kOvmbEnd);
  if (!known) {
    if (mandatory) in_.fail(header, "found a mandatory chunk of a kind or version not known");
    in_.take(length, "a chunk");
    return;
  }
  in_.set_end(length - padding);
  read_payload(type);
  if (in_.remaining() > 0) {
    in_.fail(in_.offset(), "expected the end of the chunk, found " +
                               std::to_string(in_.remaining()) + " bytes more");
  }
  in_.unset_end();
  in_.zeros(padding, "a byte of padding");
}

void OvmbReader::read_payload(std::string_view type) {
  if (type == kOvmbVertices) return read_vertices();
  if (type == kOvmbTopology) return read_topology();
  if (type == kOvmbDirectory) return read_directory();
  if (type == kOvmbValues) return read_values();
  ended_ = true;
}

Span OvmbReader::read_span(std::uint64_t most) {
  const std::uint64_t first = in_.number(8, "the first element of a chunk", 0, most);
  return {first, in_.number(4, "the number of elements of a chunk", 0, most - first)};
}

void OvmbReader::read_vertices() {
  const std::size_t at = in_.offset();
  const Span span = read_span(announced_[0]);
  if (span.first != data_.points.size()) {
    in_.fail(at, "expected vertex " + std::to_string(data_.points.size()) + ", found " +
                     std::to_string(span.first));
  }
  const bool is_float =
      in_.number(1, "the type of coordinates", kOvmbFloat, kOvmbDouble) == kOvmbFloat;
  in_.zeros(3, "a reserved byte");
  const OvmType& type = *find_ovm_type(OvmFile::binary, is_float ? "3f" : "3d");
  const std::size_t numbers = in_.offset();
  const DataArray coordinates = read_numbers(type, span.count, false);
  for (std::size_t i = 0; i < coordinates.reals.size(); i += 3) {
    const Eigen::Vector3d p(&coordinates.reals[i]);
    if (!p.allFinite()) {
      in_.fail(numbers + i * type.bytes, "expected finite coordinates of vertex " +
                                             std::to_string(data_.points.size()) +
                                             ", found another value");
    }
    data_.points.push_back(p);
  }
}

void OvmbReader::read_topology() {
  const std::size_t entity_at = 12;  // behind the span
  const std::string_view head = in_.peek(24, "the head of a chunk TOPO");
  const int entity = static_cast<unsigned char>(head[entity_at]);
  if (entity == int(OvmEntity::edge)) {
    read_rows("edge", data_.points.size(), topology_.edges);
  } else if (entity == int(OvmEntity::face)) {
    read_rows("face", 2 * topology_.edges.size(), topology_.faces);
  } else if (entity == int(OvmEntity::cell)) {
    cells_at_ = in_.offset();
    read_rows("cell", 2 * topology_.faces.size(), topology_.cells);
  } else {
    in_.fail(in_.offset() + entity_at,
             "expected edges (1), faces (2) or cells (3), found " + std::to_string(entity));
  }
}

/// \param n_parts  an index is below it
template <std::size_t n>
void OvmbReader::read_rows(const std::string& what, std::size_t n_parts,
                           std::vector<std::array<int, n>>& rows) {
  const std::size_t at = in_.offset();
  const Span span = read_span(std::numeric_limits<int>::max());
  if (span.first != rows.size()) {
    in_.fail(at, "expected " + what + " " + std::to_string(rows.size()) + ", found " +
                     std::to_string(span.first));
  }
  in_.number(1, "the entity");
  const int valence = in_.number(1, "the valence");
  const int valence_width = in_.number(1, "the width of valences", 0, 4);
  const int width = in_.number(1, "the width of indices", 1, 4);
  const std::uint64_t offset = in_.number(8, "the offset of indices", 0, n_parts);
  const std::string expected = "the valence of a " + what + " (only hexahedra can be read)";
  const auto check = [&](std::uint64_t found, std::size_t where) {
    if (found != n) {
      in_.fail(where, "expected " + expected + " " + std::to_string(n) + ", found " +
                          std::to_string(found));
    }
  };
  if (valence != 0) check(valence, at + 13);
  for (std::size_t i = 0; valence == 0 && i < span.count; ++i) {
    const std::size_t where = in_.offset();
    check(in_.number(std::max(valence_width, 1), expected), where);
  }
  rows.reserve(rows.size() + std::min(span.count, in_.remaining() / (n * width)));
  for (std::size_t i = 0; i < span.count; ++i) {
    std::array<int, n> row;
    for (int& index : row) {
      const std::size_t where = in_.offset();
      const std::uint64_t value = offset + in_.number(width, "an index of a " + what);
      if (value >= n_parts) {
        in_.fail(where, what + " " + std::to_string(rows.size()) + " uses element " +
                            std::to_string(value) + ", expected one of " + std::to_string(n_parts));
      }
      index = static_cast<int>(value);
    }
    rows.push_back(row);
  }
}

void OvmbReader::read_directory() {
  if (std::exchange(have_directory_, true)) {
    in_.fail(in_.offset(), "found a second directory of properties, expected one");
  }
  const auto read_text = [&](const std::string& what) {
    const std::size_t length = in_.number(4, "the length of " + what);
    return std::string(in_.take(length, what));
  };
  while (in_.remaining() > 0) {
    PropertyOfFile p;
    p.entity = OvmEntity(in_.number(1, "the entity of a property", 0, kOvmEntities - 1));
    p.name = read_text("the name of a property");
    p.type_name = read_text("the type of a property");
    const bool has_rows = p.entity == OvmEntity::vertex || p.entity == OvmEntity::cell;
    p.type = has_rows ? find_ovm_type(OvmFile::binary, p.type_name) : nullptr;
    const std::size_t length = in_.number(4, "the length of a default value");
    const std::size_t at = in_.offset();
    if (p.type) {
      p.default_row = read_numbers(*p.type, 1, false);
      if (in_.offset() - at != length) {
        in_.fail(at, "expected a default value of " + std::to_string(in_.offset() - at) +
                         " bytes, found " + std::to_string(length) + " announced");
      }
    } else {
      in_.take(length, "a default value");
      data_.notes.push_back(left_out_note(p.entity, p.type_name, p.name));
    }
    properties_.push_back(std::move(p));
  }
}

void OvmbReader::read_values() {
  const std::size_t at = in_.offset();
  Span span = read_span(std::numeric_limits<int>::max());
  if (properties_.empty()) in_.fail(at, "found values of a property before any directory of them");
  PropertyOfFile& property =
      properties_[in_.number(4, "the number of a property", 0, properties_.size() - 1)];
  if (!property.type) {
    in_.take(in_.remaining(), "values");
    return;
  }
  const std::uint64_t rows = announced_[property.entity == OvmEntity::cell ? 3 : 0];
  if (span.first + span.count > rows) {
    in_.fail(at, "expected values of no more than " + std::to_string(rows) + " elements, found " +
                     std::to_string(span.first + span.count));
  }
  property.parts.emplace_back(span, read_numbers(*property.type, span.count, true));
}

/// \param packed  whether bits are; else each has a byte
DataArray OvmbReader::read_numbers(const OvmType& type, std::size_t rows, bool packed) {
  DataArray array;
  array.kind = type.kind;
  array.components = type.components;
  const std::size_t n = rows * type.components;
  const bool bits = type.bytes == 0 && packed;
  const std::size_t at = in_.offset();
  const std::string_view bytes =
      in_.take(bits ? (n + 7) / 8 : n * std::max(type.bytes, 1), std::to_string(n) + " numbers");
  if (bits) {
    for (std::size_t i = 0; i < n; ++i) array.integers.push_back(bytes[i / 8] >> (i % 8) & 1);
    return array;
  }
  const int width = std::max(type.bytes, 1);
  for (std::size_t i = 0; i < n; ++i) {
    const char* p = bytes.data() + i * width;
    if (type.kind == ValueKind::real) {
      array.reals.push_back(load_real(p, width));
      continue;
    }
    array.integers.push_back(type.is_signed ? load_signed(p, width)
                                            : static_cast<std::int64_t>(load_unsigned(p, width)));
    if (!type.is_signed && array.integers.back() < 0) {
      in_.fail(at + i * width, "found an integer beyond 2^63");
    }
  }
  return array;
}

void OvmbReader::check_counts() {
  const std::array<std::pair<const char*, std::size_t>, 4> found{
      {{"vertices", data_.points.size()},
       {"edges", topology_.edges.size()},
       {"faces", topology_.faces.size()},
       {"cells", topology_.cells.size()}}};
  for (int i = 0; i < 4; ++i) {
    if (found[i].second != announced_[i]) {
      in_.fail(16 + 8 * i, "expected " + std::to_string(announced_[i]) + " " + found[i].first +
                               " as announced, found " + std::to_string(found[i].second));
    }
  }
  if (topology_.cells.empty()) in_.fail(40, "expected hexahedra, found none");
}

void OvmbReader::keep(const PropertyOfFile& property) {
  if (!property.type) return;
  const bool of_cells = property.entity == OvmEntity::cell;
  const std::size_t rows = of_cells ? data_.cells.size() : data_.points.size();
  DataArray array = property.default_row;
  array.name = property.name;
  const auto fill = [&](auto DataArray::*numbers) {
    const auto row = property.default_row.*numbers;
    auto& values = array.*numbers;
    values.clear();
    values.reserve(rows * row.size());
    for (std::size_t i = 0; i < rows; ++i) values.insert(values.end(), row.begin(), row.end());
    for (const auto& [span, part] : property.parts) {
      std::copy((part.*numbers).begin(), (part.*numbers).end(),
                values.begin() + static_cast<std::ptrdiff_t>(span.first * row.size()));
    }
  };
  fill(&DataArray::integers);
  fill(&DataArray::reals);
  add_array(of_cells ? data_.cell_data : data_.point_data, std::move(array), data_.notes);
}

}  // namespace

bool is_ovmb(std::string_view bytes) { return bytes.starts_with(kOvmbMagic.substr(0, 4)); }

MeshData read_ovmb(std::string_view bytes, const std::string& path) {
  return OvmbReader(bytes, path).read();
}

}  // namespace hexweft
