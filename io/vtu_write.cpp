#include "io/base64.h"
#include "io/number_writer.h"
#include "io/vtk_grid.h"
#include "io/vtu.h"
#include "io/vtu_document.h"
#include "io/xml_text.h"

namespace hexweft {
namespace {

using namespace detail;

class VtuWriter {
 public:
  VtuWriter(const WriteOptions& options, std::string& out)
      : options_(options),
        out_(out),
        rows_(options, std::endian::little, options.binary ? bytes_ : out) {}

  void write(const HexMesh& mesh, std::vector<std::string>& notes) {
    out_ +=
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
        "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n"
        "<Piece NumberOfPoints=\"" +
        std::to_string(mesh.n_vertices()) + "\" NumberOfCells=\"" + std::to_string(mesh.n_cells()) +
        "\">\n<Points>\n";
    write_points(mesh);
    out_ += "</Points>\n<Cells>\n";
    write_cells(mesh);
    out_ += "</Cells>\n";
    write_data("PointData", property_arrays<VertexTag>(mesh, notes), notes);
    write_data("CellData", property_arrays<CellTag>(mesh, notes), notes);
    out_ += "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  }

 private:
  void write_points(const HexMesh& mesh) {
    begin_array("Float64", "Points", 3);
    for (VertexHandle v : mesh.vertices()) {
      for (double x : mesh.point(v)) rows_.put(x);
      rows_.end_row();
    }
    end_array();
  }
  void write_cells(const HexMesh& mesh);
  void write_data(const std::string& section, const std::vector<DataArray>& arrays,
                  std::vector<std::string>& notes);
  void write_array(const DataArray& array);
  static const char* type_name(const DataArray& array);

  void begin_array(const std::string& type, const std::string& name, int components,
                   const std::string& attributes = {}) {
    out_ += "<DataArray type=\"" + type + "\" Name=\"" + name + "\"";
    if (components != 1) out_ += " NumberOfComponents=\"" + std::to_string(components) + "\"";
    out_ += attributes + " format=\"" + (options_.binary ? "binary" : "ascii") + "\">\n";
  }
  void end_array() {
    if (options_.binary) {
      std::string data;
      append_bytes(data, static_cast<std::int64_t>(bytes_.size()), std::endian::little);
      append_base64(out_, data.append(bytes_));
      out_ += '\n';
      bytes_.clear();
    }
    out_ += "</DataArray>\n";
  }

  const WriteOptions& options_;
  std::string& out_;
  std::string bytes_;  // of the current array
  NumberWriter rows_;
};

void VtuWriter::write_cells(const HexMesh& mesh) {
  const std::vector<int> number = vertex_numbers(mesh);
  begin_array("Int32", "connectivity", 1);
  for (CellHandle c : mesh.cells()) {
    for (VertexHandle v : mesh.vertices(c)) rows_.put(std::int32_t{number[v.idx]});
    rows_.end_row();
  }
  end_array();
  begin_array("Int32", "offsets", 1);
  for (int i = 1; i <= mesh.n_cells(); ++i) {
    rows_.put(std::int32_t{8 * i});
    rows_.end_row();
  }
  end_array();
  begin_array("UInt8", "types", 1);
  for (int i = 0; i < mesh.n_cells(); ++i) {
    rows_.put(std::uint8_t{kVtkHexahedron});
    rows_.end_row();
  }
  end_array();
}

const char* VtuWriter::type_name(const DataArray& array) {
  if (array.kind == ValueKind::real) return "Float64";
  if (array.kind == ValueKind::bit) return "UInt8";
  return fits_int(array) ? "Int32" : "Int64";
}

void VtuWriter::write_data(const std::string& section, const std::vector<DataArray>& arrays,
                           std::vector<std::string>& notes) {
  if (arrays.empty()) return;
  out_ += "<" + section + ">\n";
  for (const DataArray& array : arrays) {
    if (is_xml_text(array.name)) {
      write_array(array);
    } else {
      notes.push_back(left_out(array.name, "no XML file holds its name"));
    }
  }
  out_ += "</" + section + ">\n";
}

void VtuWriter::write_array(const DataArray& array) {
  const bool is_bit = array.kind == ValueKind::bit, is_short = fits_int(array);
  begin_array(type_name(array), xml_attribute_text(array.name), array.components,
              is_bit ? std::string(" ") + kVtuBit + "=\"1\"" : "");
  for (std::size_t i = 0; i < array.size(); ++i) {
    if (array.kind == ValueKind::real) {
      rows_.put(array.reals[i]);
    } else if (is_bit) {
      rows_.put(static_cast<std::uint8_t>(array.integers[i]));
    } else if (is_short) {
      rows_.put(static_cast<std::int32_t>(array.integers[i]));
    } else {
      rows_.put(array.integers[i]);
    }
    if ((i + 1) % array.components == 0) rows_.end_row();
  }
  end_array();
}

}  // namespace

void write_vtu(const HexMesh& mesh, const WriteOptions& options, std::string& out,
               std::vector<std::string>& notes) {
  VtuWriter(options, out).write(mesh, notes);
}

}  // namespace hexweft
