#include <algorithm>
#include <string>
#include <string_view>

#include "io/binary_numbers.h"
#include "io/ovm.h"
#include "io/ovm_topology.h"
#include "io/ovm_types.h"
#include "io/ovmb_layout.h"

namespace hexweft {
namespace {

using namespace detail;

class OvmbWriter {
 public:
  explicit OvmbWriter(std::string& out) : out_(out) {}

  void write(const HexMesh& mesh, std::vector<std::string>& notes) {
    const OvmTopology topology = make_ovm_topology(mesh);
    write_header(mesh, topology);
    std::vector<std::pair<OvmEntity, OvmProperty>> properties;
    for (auto& p : ovm_properties<VertexTag>(mesh, OvmFile::binary, notes)) {
      properties.emplace_back(OvmEntity::vertex, std::move(p));
    }
    for (auto& p : ovm_properties<CellTag>(mesh, OvmFile::binary, notes)) {
      properties.emplace_back(OvmEntity::cell, std::move(p));
    }
    write_directory(properties);
    write_vertices(mesh);
    write_rows(OvmEntity::edge, mesh.n_vertices(), topology.edges);
    write_rows(OvmEntity::face, 2 * topology.edges.size(), topology.faces);
    write_rows(OvmEntity::cell, 2 * topology.faces.size(), topology.cells);
    for (std::size_t i = 0; i < properties.size(); ++i) write_values(i, properties[i].second);
    write_chunk(kOvmbEnd, {});
  }

 private:
  void write_header(const HexMesh& mesh, const OvmTopology& topology) {
    out_ += kOvmbMagic;
    for (int byte : {kOvmbVersion, kOvmbVersion, 3, kOvmbHexahedral, 0, 0, 0, 0}) {
      append_little_endian(out_, byte, 1);
    }
    append_little_endian(out_, mesh.n_vertices(), 8);
    append_little_endian(out_, topology.edges.size(), 8);
    append_little_endian(out_, topology.faces.size(), 8);
    append_little_endian(out_, topology.cells.size(), 8);
  }

  void write_chunk(std::string_view type, const std::string& payload) {
    const std::size_t padding = (8 - payload.size() % 8) % 8;
    out_ += type;
    for (std::size_t byte :
         {std::size_t{0}, padding, std::size_t{0}, std::size_t{kOvmbMandatory}}) {
      append_little_endian(out_, byte, 1);
    }
    append_little_endian(out_, payload.size() + padding, 8);
    out_ += payload;
    out_.append(padding, '\0');
  }

  static std::string span_of(std::size_t count) {
    std::string span;
    append_little_endian(span, 0, 8);
    append_little_endian(span, count, 4);
    return span;
  }

  static void append_text(std::string& out, std::string_view text) {
    append_little_endian(out, text.size(), 4);
    out += text;
  }

  // The default of a property is one row of zeros; a bit takes a byte there.
  void write_directory(const std::vector<std::pair<OvmEntity, OvmProperty>>& properties) {
    if (properties.empty()) return;
    std::string payload;
    for (const auto& [entity, property] : properties) {
      append_little_endian(payload, static_cast<int>(entity), 1);
      append_text(payload, property.array.name);
      append_text(payload, property.type->binary_name);
      const std::size_t bytes = property.type->components * std::max(property.type->bytes, 1);
      append_text(payload, std::string(bytes, '\0'));
    }
    write_chunk(kOvmbDirectory, payload);
  }

  void write_vertices(const HexMesh& mesh) {
    if (mesh.n_vertices() == 0) return;
    std::string payload = span_of(mesh.n_vertices());
    append_little_endian(payload, kOvmbDouble, 4);  // and three bytes of zero
    for (VertexHandle v : mesh.vertices()) {
      for (double x : mesh.point(v)) append_bytes(payload, x, std::endian::little);
    }
    write_chunk(kOvmbVertices, payload);
  }

  // All edges in one chunk without offset: readers do not agree on what an offset of edges means.
  template <std::size_t n>
  void write_rows(OvmEntity entity, std::size_t n_parts,
                  const std::vector<std::array<int, n>>& rows) {
    if (rows.empty()) return;
    const int width = n_parts <= 0xff ? 1 : n_parts <= 0xffff ? 2 : 4;
    std::string payload = span_of(rows.size());
    for (int byte : {static_cast<int>(entity), static_cast<int>(n), 0, width}) {
      append_little_endian(payload, byte, 1);
    }
    append_little_endian(payload, 0, 8);
    for (const auto& row : rows) {
      for (int index : row) append_little_endian(payload, index, width);
    }
    write_chunk(kOvmbTopology, payload);
  }

  void write_values(std::size_t index, const OvmProperty& property) {
    const DataArray& array = property.array;
    if (array.size() == 0) return;
    std::string payload = span_of(array.size() / array.components);
    append_little_endian(payload, index, 4);
    if (array.kind == ValueKind::bit) {
      append_bits(payload, array.integers);
    } else if (array.kind == ValueKind::integer) {
      for (std::int64_t x : array.integers) append_little_endian(payload, x, property.type->bytes);
    } else {
      for (double x : array.reals) append_bytes(payload, x, std::endian::little);
    }
    write_chunk(kOvmbValues, payload);
  }

  static void append_bits(std::string& out, const std::vector<std::int64_t>& bits) {
    for (std::size_t i = 0; i < bits.size(); i += 8) {
      int byte = 0;
      for (std::size_t k = 0; k < 8 && i + k < bits.size(); ++k) byte |= int(bits[i + k]) << k;
      append_little_endian(out, byte, 1);
    }
  }

  std::string& out_;
};

}  // namespace

void write_ovmb(const HexMesh& mesh, const WriteOptions&, std::string& out,
                std::vector<std::string>& notes) {
  OvmbWriter(out).write(mesh, notes);
}

}  // namespace hexweft
