// Files of VTK's XML format in each of its encodings.
#pragma once

#include <bit>
#include <zlib.h>

#include "io/base64.h"
#include "tests/io/sample_meshes.h"

namespace hexweft::test {

struct VtuEncoding {
  std::string format = "ascii";  // or "binary", "base64", "raw"; the last two are appended
  std::endian order = std::endian::little;
  std::size_t header_bytes = 4;
  std::size_t block_size = 0;  // of compressed data; 0: not compressed
};

inline void PrintTo(const VtuEncoding& encoding, std::ostream* out) {
  *out << encoding.format << (encoding.order == std::endian::big ? " big" : " little") << " UInt"
       << 8 * encoding.header_bytes << " blocks of " << encoding.block_size;
}

/// Puts a file together, element by element.
class VtuFile {
 public:
  explicit VtuFile(VtuEncoding encoding) : encoding_(std::move(encoding)) {}

  void add(const std::string& xml) { xml_ += xml + "\n"; }

  template <class T>
  void add_array(const std::string& attributes, const std::vector<T>& values) {
    xml_ += "<DataArray " + attributes + " format=\"";
    if (encoding_.format == "ascii") {
      xml_ += "ascii\">\n";
      for (T value : values) xml_ += std::to_string(value) + " ";
      xml_ += "\n</DataArray>\n";
    } else if (encoding_.format == "binary") {
      xml_ += "binary\">\n  " + data_of(values, true) + "\n</DataArray>\n";
    } else {
      xml_ += "appended\" offset=\"" + std::to_string(appended_.size()) + "\"/>\n";
      appended_ += data_of(values, encoding_.format == "base64");
    }
  }

  std::string text() const {
    std::string root = "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" byte_order=\"";
    root += encoding_.order == std::endian::big ? "BigEndian\"" : "LittleEndian\"";
    root += " version=\"0.1\" header_type=\"UInt" + std::to_string(8 * encoding_.header_bytes);
    if (encoding_.block_size > 0) root += "\" compressor=\"vtkZLibDataCompressor";
    root += "\">\n<UnstructuredGrid>\n" + xml_ + "</UnstructuredGrid>\n";
    if (!appended_.empty()) {
      root += "<AppendedData encoding=\"" + encoding_.format + "\">\n   _" + appended_ +
              "\n</AppendedData>\n";
    }
    return root + "</VTKFile>\n";
  }

 private:
  template <class T>
  void append(std::string& out, T value) const {
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), &value, sizeof(T));
    if (encoding_.order != std::endian::native) std::reverse(bytes.begin(), bytes.end());
    out.append(bytes.data(), bytes.size());
  }
  void append_size(std::string& out, std::size_t size) const {
    encoding_.header_bytes == 4 ? append(out, static_cast<std::uint32_t>(size))
                                : append(out, static_cast<std::uint64_t>(size));
  }
  template <class T>
  std::string data_of(const std::vector<T>& values, bool as_base64) const {
    std::string bytes, header;
    for (T value : values) append(bytes, value);
    if (encoding_.block_size == 0) {
      append_size(header, bytes.size());
      return as_base64 ? base64(header + bytes) : header + bytes;
    }
    const std::string blocks = compressed(bytes, header);
    return as_base64 ? base64(header) + base64(blocks) : header + blocks;
  }
  std::string compressed(const std::string& bytes, std::string& header) const {
    const std::size_t size = encoding_.block_size;
    append_size(header, (bytes.size() + size - 1) / size);
    append_size(header, size);
    append_size(header, bytes.size() % size);
    std::string blocks;
    for (std::size_t at = 0; at < bytes.size(); at += size) {
      const std::string block = bytes.substr(at, size);
      uLongf packed_size = compressBound(block.size());
      std::string packed(packed_size, '\0');
      compress(reinterpret_cast<Bytef*>(packed.data()), &packed_size,
               reinterpret_cast<const Bytef*>(block.data()), block.size());
      append_size(header, packed_size);
      blocks += packed.substr(0, packed_size);
    }
    return blocks;
  }
  static std::string base64(const std::string& bytes) {
    std::string result;
    detail::append_base64(result, bytes);
    return result;
  }

  VtuEncoding encoding_;
  std::string xml_, appended_;
};

/// A piece with a hexahedron, a triangle that is left out, and data of three kinds.
inline void add_cube_piece(VtuFile& file) {
  std::vector<float> points;
  for (const auto& corner : kCornerCoords) {
    for (int x : corner) points.push_back(static_cast<float>(x));
  }
  file.add("<Piece NumberOfPoints=\"8\" NumberOfCells=\"2\">\n<PointData Scalars=\"weight\">");
  file.add_array<double>("type=\"Float64\" Name=\"weight\"", {0, 0.5, 1, 1.5, -2, 2.25, 3, 0x1p-4});
  file.add("</PointData>\n<CellData>");
  file.add_array<std::int16_t>("type=\"Int16\" Name=\"part\"", {-7, 300});
  file.add_array<float>("NumberOfComponents=\"3\" type=\"Float32\" Name=\"axis\"",
                        {1, 2, 3, 4, 5, 6.5});
  file.add("</CellData>\n<Points>");
  file.add_array("type=\"Float32\" NumberOfComponents=\"3\"", points);
  file.add("</Points>\n<Cells>");
  file.add_array<std::int64_t>("type=\"Int64\" Name=\"connectivity\"",
                               {0, 1, 2, 0, 1, 2, 3, 4, 5, 6, 7});
  file.add_array<std::uint16_t>("type=\"UInt16\" Name=\"offsets\"", {3, 11});
  file.add_array<std::uint8_t>("type=\"UInt8\" Name=\"types\"", {5, 12});
  file.add("</Cells>\n</Piece>");
}

/// What the file of one such piece holds.
inline HexMesh cube_with_data() {
  HexMesh mesh = unit_cube();
  auto weight = named_property<VertexTag, double>(mesh, "weight", 0.0);
  const double weights[] = {0, 0.5, 1, 1.5, -2, 2.25, 3, 0x1p-4};
  for (VertexHandle v : mesh.vertices()) weight[v] = weights[v.idx];
  named_property<CellTag, int>(mesh, "part", 300);
  named_property<CellTag, Eigen::Vector3d>(mesh, "axis", Eigen::Vector3d(4, 5, 6.5));
  return mesh;
}

}  // namespace hexweft::test
