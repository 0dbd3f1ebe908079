#include <utility>

#include "io/number_writer.h"
#include "io/vtk_attributes.h"
#include "io/vtk_legacy.h"
#include "io/vtk_values.h"

namespace hexweft {
namespace {

using namespace detail;

class VtkWriter {
 public:
  VtkWriter(const WriteOptions& options, std::string& out)
      : options_(options), out_(out), rows_(options, std::endian::big, out) {}

  void write(const HexMesh& mesh, std::vector<std::string>& notes) {
    out_ += "# vtk DataFile Version 3.0\nhexahedral mesh\n";
    out_ += options_.binary ? "BINARY\n" : "ASCII\n";
    out_ += "DATASET UNSTRUCTURED_GRID\n";
    write_points(mesh);
    write_cells(mesh);
    write_data("CELL_DATA", mesh.n_cells(), property_arrays<CellTag>(mesh, notes));
    write_data("POINT_DATA", mesh.n_vertices(), property_arrays<VertexTag>(mesh, notes));
  }

 private:
  void write_points(const HexMesh& mesh) {
    line("POINTS ", std::to_string(mesh.n_vertices()), " double");
    for (VertexHandle v : mesh.vertices()) {
      for (double x : mesh.point(v)) rows_.put(x);
      rows_.end_row();
    }
    end_block();
  }
  void write_cells(const HexMesh& mesh) {
    const std::vector<int> number = vertex_numbers(mesh);
    const int n = mesh.n_cells();
    line("CELLS ", std::to_string(n), " ", std::to_string(9LL * n));
    for (CellHandle c : mesh.cells()) {
      rows_.put(std::int32_t{8});
      for (VertexHandle v : mesh.vertices(c)) rows_.put(std::int32_t{number[v.idx]});
      rows_.end_row();
    }
    end_block();
    line("CELL_TYPES ", std::to_string(n));
    for (int i = 0; i < n; ++i) {
      rows_.put(std::int32_t{12});
      rows_.end_row();
    }
    end_block();
  }
  void write_data(const char* section, int rows, const std::vector<DataArray>& arrays);
  void write_field_arrays(int rows, const std::vector<const DataArray*>& arrays);
  void write_rows(const DataArray& array);
  static std::string type_name(const DataArray& array);

  template <class... Part>
  void line(const Part&... parts) {
    ((out_ += parts), ...);
    out_ += '\n';
  }
  void end_block() {
    if (options_.binary) out_ += '\n';
  }

  const WriteOptions& options_;
  std::string& out_;
  NumberWriter rows_;
};

std::string VtkWriter::type_name(const DataArray& array) {
  if (array.kind == ValueKind::real) return "double";
  if (array.kind == ValueKind::bit) return "bit";
  return fits_int(array) ? "int" : "long";
}

void VtkWriter::write_data(const char* section, int rows, const std::vector<DataArray>& arrays) {
  if (arrays.empty() || rows == 0) return;
  line(section, " ", std::to_string(rows));
  std::vector<const DataArray*> others;
  for (const DataArray& array : arrays) {
    const std::string name = encode_vtk_name(array.name);
    if (array.components == 1) {
      line("SCALARS ", name, " ", type_name(array), " 1");
      line("LOOKUP_TABLE default");
      write_rows(array);
    } else if (array.components == 3 && array.kind == ValueKind::real) {
      line("VECTORS ", name, " double");
      write_rows(array);
    } else {
      others.push_back(&array);
    }
  }
  if (!others.empty()) write_field_arrays(rows, others);
}

void VtkWriter::write_field_arrays(int rows, const std::vector<const DataArray*>& arrays) {
  line("FIELD FieldData ", std::to_string(arrays.size()));
  for (const DataArray* array : arrays) {
    line(encode_vtk_name(array->name), " ", std::to_string(array->components), " ",
         std::to_string(rows), " ", type_name(*array));
    write_rows(*array);
  }
}

void VtkWriter::write_rows(const DataArray& array) {
  const bool is_bit = array.kind == ValueKind::bit, is_long = type_name(array) == "long";
  std::uint8_t bits = 0;
  for (std::size_t i = 0; i < array.size(); ++i) {
    if (array.kind == ValueKind::real) {
      rows_.put(array.reals[i]);
    } else if (is_bit && options_.binary) {
      bits |= static_cast<std::uint8_t>(array.integers[i] << (7 - i % 8));
      if (i % 8 == 7 || i + 1 == array.size()) rows_.put(std::exchange(bits, std::uint8_t{0}));
    } else if (is_long) {
      rows_.put(array.integers[i]);
    } else {
      rows_.put(static_cast<std::int32_t>(array.integers[i]));
    }
    if ((i + 1) % array.components == 0) rows_.end_row();
  }
  end_block();
}

}  // namespace

void write_vtk_legacy(const HexMesh& mesh, const WriteOptions& options, std::string& out,
                      std::vector<std::string>& notes) {
  VtkWriter(options, out).write(mesh, notes);
}

}  // namespace hexweft
