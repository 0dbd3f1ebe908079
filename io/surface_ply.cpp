#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "io/binary_numbers.h"
#include "io/polygon_soup.h"
#include "io/text_scanner.h"
#include "ovm/errors.h"

namespace hexweft::detail {
namespace {

struct PlyType {
  std::string_view name, other_name;
  int bytes;
  bool is_real, is_signed;
};
constexpr std::array<PlyType, 8> kTypes{{{"char", "int8", 1, false, true},
                                         {"uchar", "uint8", 1, false, false},
                                         {"short", "int16", 2, false, true},
                                         {"ushort", "uint16", 2, false, false},
                                         {"int", "int32", 4, false, true},
                                         {"uint", "uint32", 4, false, false},
                                         {"float", "float32", 4, true, true},
                                         {"double", "float64", 8, true, true}}};

struct PlyProperty {
  std::string name;
  const PlyType* count_type;  // null if it is no list
  const PlyType* type;
};
struct PlyElement {
  std::string name;
  std::int64_t count;
  std::vector<PlyProperty> properties;
};

/// Polygon file format (Stanford), text and binary of either byte order: the elements vertex and face.
class PlyReader {
 public:
  PlyReader(std::string_view text, const std::string& path) : in_(text, path), path_(path) {}

  PolygonSoup read() {
    read_header();
    for (const PlyElement& element : elements_) {
      for (std::int64_t i = 0; i < element.count; ++i) read_element(element, i);
    }
    if (!binary_ && !in_.at_end()) in_.fail_expected("the end of the file");
    return std::move(soup_);
  }

 private:
  void read_header();
  void read_element_header();
  void read_property_header();
  const PlyType* read_type();
  void read_element(const PlyElement& element, std::int64_t i);
  double read_number(const PlyType& type, const PlyElement& element, std::int64_t i);
  [[noreturn]] void fail(const PlyElement& element, std::int64_t i, const std::string& expected);

  TextScanner in_;
  std::string path_;
  std::vector<PlyElement> elements_;
  PolygonSoup soup_;
  int n_points_ = 0;                   // announced
  std::optional<std::endian> binary_;  // its byte order; empty: text
};

void PlyReader::read_header() {
  if (in_.peek() != "ply") in_.fail_expected("ply");
  in_.rest_of_line();
  for (;;) {
    const std::string_view keyword = in_.peek();
    if (keyword == "comment" || keyword == "obj_info") {
      in_.rest_of_line();
    } else if (keyword == "format") {
      in_.next();
      const std::string_view format = in_.peek();
      if (format == "binary_little_endian") binary_ = std::endian::little;
      if (format == "binary_big_endian") binary_ = std::endian::big;
      if (format != "ascii" && !binary_) in_.fail_expected("ascii or binary_..._endian");
      in_.rest_of_line();
    } else if (keyword == "element") {
      read_element_header();
    } else if (keyword == "property" && !elements_.empty()) {
      read_property_header();
    } else if (keyword == "end_header") {
      in_.rest_of_line();
      return;
    } else {
      in_.fail_expected("a line of the header of a PLY file");
    }
  }
}

void PlyReader::read_element_header() {
  in_.next();
  PlyElement element;
  element.name = in_.next();
  element.count = in_.read_count("a number of elements", kMostOfSurface);
  in_.rest_of_line();
  if (element.name == "vertex") n_points_ = static_cast<int>(element.count);
  elements_.push_back(std::move(element));
}

const PlyType* PlyReader::read_type() {
  const std::string_view word = in_.peek();
  const auto type = std::find_if(kTypes.begin(), kTypes.end(), [&](const PlyType& t) {
    return t.name == word || t.other_name == word;
  });
  if (type == kTypes.end()) in_.fail_expected("a type of numbers");
  in_.next();
  return &*type;
}

void PlyReader::read_property_header() {
  in_.next();
  PlyProperty property{};
  if (in_.peek() == "list") {
    in_.next();
    property.count_type = read_type();
  }
  property.type = read_type();
  property.name = in_.rest_of_line();
  elements_.back().properties.push_back(std::move(property));
}

void PlyReader::read_element(const PlyElement& element, std::int64_t i) {
  const bool is_point = element.name == "vertex", is_face = element.name == "face";
  Eigen::Vector3d p = Eigen::Vector3d::Constant(std::nan(""));
  std::vector<int> polygon;
  for (const PlyProperty& property : element.properties) {
    if (!property.count_type) {
      const double value = read_number(*property.type, element, i);
      if (property.name == "x") p[0] = value;
      if (property.name == "y") p[1] = value;
      if (property.name == "z") p[2] = value;
      continue;
    }
    const double count = read_number(*property.count_type, element, i);
    const bool is_polygon =
        is_face && (property.name == "vertex_indices" || property.name == "vertex_index");
    for (double k = 0; k < count; ++k) {
      const double index = read_number(*property.type, element, i);
      if (!is_polygon) continue;
      if (!(index >= 0 && index < n_points_) || index != std::floor(index)) {
        fail(element, i, "points in [0, " + std::to_string(n_points_ - 1) + "]");
      }
      polygon.push_back(static_cast<int>(index));
    }
  }
  if (is_point) {
    if (!p.allFinite()) fail(element, i, "finite coordinates x, y and z");
    soup_.points.push_back(p);
  } else if (is_face) {
    if (polygon.size() < 3) fail(element, i, "three points or more in vertex_indices");
    soup_.polygons.push_back(std::move(polygon));
  }
}

double PlyReader::read_number(const PlyType& type, const PlyElement& element, std::int64_t i) {
  if (!binary_) {
    double value;
    if (!in_.read(value)) {
      in_.fail_expected("a number of " + element.name + " " + std::to_string(i) + " of " +
                        std::to_string(element.count));
    }
    return value;
  }
  if (in_.remaining() < std::size_t(type.bytes)) fail(element, i, "more bytes");
  const char* p = in_.text().data() + in_.offset();
  in_.seek(in_.offset() + type.bytes);
  return type.is_real     ? load_real(p, type.bytes, *binary_)
         : type.is_signed ? static_cast<double>(load_signed(p, type.bytes, *binary_))
                          : static_cast<double>(load_unsigned(p, type.bytes, *binary_));
}

void PlyReader::fail(const PlyElement& element, std::int64_t i, const std::string& expected) {
  const std::string problem = "expected " + expected + " of " + element.name + " " +
                              std::to_string(i) + " of " + std::to_string(element.count);
  if (!binary_) in_.fail(in_.offset(), problem);
  throw FormatError(path_ + ": byte " + std::to_string(in_.offset()) + ": " + problem);
}

}  // namespace

PolygonSoup read_ply(std::string_view text, const std::string& path) {
  return PlyReader(text, path).read();
}

}  // namespace hexweft::detail
