#include <string>

#include "io/number_text.h"
#include "io/ovm.h"
#include "io/ovm_topology.h"
#include "io/ovm_types.h"

namespace hexweft {
namespace {

using namespace detail;

class OvmWriter {
 public:
  OvmWriter(const WriteOptions& options, std::string& out) : options_(options), out_(out) {}

  void write(const HexMesh& mesh, std::vector<std::string>& notes) {
    out_ += "OVM ASCII\n";
    begin("Vertices", mesh.n_vertices());
    for (VertexHandle v : mesh.vertices()) row(mesh.point(v));
    const OvmTopology topology = make_ovm_topology(mesh);
    begin("Edges", topology.edges.size());
    for (const auto& edge : topology.edges) row(edge);
    begin("Faces", topology.faces.size());
    for (const auto& face : topology.faces) counted_row(face);
    begin("Polyhedra", topology.cells.size());
    for (const auto& cell : topology.cells) counted_row(cell);
    for (const auto& property : ovm_properties<VertexTag>(mesh, OvmFile::text, notes)) {
      write_property("VProp", property);
    }
    for (const auto& property : ovm_properties<CellTag>(mesh, OvmFile::text, notes)) {
      write_property("CProp", property);
    }
  }

 private:
  void begin(const char* section, std::size_t count) {
    out_ += section;
    out_ += '\n' + std::to_string(count) + '\n';
  }
  template <class T>
  void put(T value) {
    append_number(out_, value, options_.precision);
    out_ += ' ';
  }
  template <class Numbers>
  void row(const Numbers& numbers) {
    for (auto x : numbers) put(x);
    out_.back() = '\n';
  }
  template <class Numbers>
  void counted_row(const Numbers& numbers) {
    put(numbers.size());
    row(numbers);
  }
  void write_property(const char* entity, const OvmProperty& property) {
    const DataArray& array = property.array;
    out_ += std::string(entity) + ' ' + std::string(property.type->text_name) + " \"" + array.name +
            "\"\n";
    for (std::size_t i = 0; i < array.size(); ++i) {
      if (array.kind == ValueKind::real) {
        put(array.reals[i]);
      } else {
        put(array.integers[i]);
      }
      if ((i + 1) % array.components == 0) out_.back() = '\n';
    }
  }

  const WriteOptions& options_;
  std::string& out_;
};

}  // namespace

void write_ovm(const HexMesh& mesh, const WriteOptions& options, std::string& out,
               std::vector<std::string>& notes) {
  OvmWriter(options, out).write(mesh, notes);
}

}  // namespace hexweft
