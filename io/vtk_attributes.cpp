#include "io/vtk_attributes.h"

#include <algorithm>
#include <charconv>
#include <limits>

namespace hexweft::detail {
namespace {

constexpr VtkType kColourByte{"unsigned_char", ValueKind::integer, 1, false};
constexpr VtkType kColourReal{"float", ValueKind::real, 4, true};

class AttributeReader {
 public:
  AttributeReader(TextScanner& in, bool binary, bool in_data, std::size_t rows)
      : in_(in), binary_(binary), in_data_(in_data), rows_(rows) {}

  VtkAttributes read();

 private:
  void read_scalars();
  void read_fixed(int components);
  void read_texture_coordinates();
  void read_colour_scalars();
  void read_colour_table();
  void read_field();
  void read_field_array(bool keep);
  void skip_strings(std::size_t count);
  void skip_binary_string();

  // VTK knows no comments, and writes `#` in names as it is.
  std::string read_name() {
    if (in_.peek_raw().empty()) in_.fail_expected("a name of a data array");
    return decode_vtk_name(in_.next_raw());
  }
  VtkType read_type() {
    const auto type = find_vtk_type(in_.peek());
    if (!type) in_.fail_expected("a type of numbers");
    in_.next();
    return *type;
  }
  int read_small_count(const std::string& what) {
    return static_cast<int>(in_.read_count(what, kMostComponents));
  }
  // The numbers of `array`, from the next line on.
  void read_numbers(DataArray array, const VtkType& type) {
    in_.rest_of_line();
    finish(std::move(array), type);
  }
  void finish(DataArray array, const VtkType& type) {
    const VtkBlock block{"data array " + quoted(array.name), header_, in_.offset(), binary_};
    DataArray values = read_vtk_values(in_, block, type, rows_ * array.components);
    values.name = std::move(array.name);
    values.components = array.components;
    found_.arrays.push_back(std::move(values));
  }

  static constexpr int kMostComponents = 1'000'000;
  TextScanner& in_;
  bool binary_, in_data_;
  std::size_t rows_;
  std::size_t header_ = 0;
  VtkAttributes found_;
};

VtkAttributes AttributeReader::read() {
  const std::string keyword = lower_case(in_.peek());
  header_ = in_.offset();
  const auto starts = [&](const char* name) {
    if (keyword != name) return false;
    in_.next();
    return true;
  };
  if (starts("field")) {
    read_field();
  } else if (starts("lookup_table")) {
    read_colour_table();
  } else if (!in_data_) {
    in_.fail_expected("a section of an unstructured grid");
  } else if (starts("scalars")) {
    read_scalars();
  } else if (starts("color_scalars")) {
    read_colour_scalars();
  } else if (starts("texture_coordinates")) {
    read_texture_coordinates();
  } else if (starts("vectors") || starts("normals")) {
    read_fixed(3);
  } else if (starts("tensors6")) {
    read_fixed(6);
  } else if (starts("tensors")) {
    read_fixed(9);
  } else if (starts("global_ids") || starts("pedigree_ids") || starts("edge_flags")) {
    read_fixed(1);
  } else {
    in_.fail_expected("a section of point or cell data");
  }
  return std::move(found_);
}

void AttributeReader::read_fixed(int components) {
  DataArray array;
  array.name = read_name();
  array.components = components;
  read_numbers(std::move(array), read_type());
}

void AttributeReader::read_scalars() {
  DataArray array;
  array.name = read_name();
  const VtkType type = read_type();
  const std::string_view components = in_.rest_of_line();
  if (!components.empty()) {
    const char* end = components.data() + components.size();
    const auto [stop, error] = std::from_chars(components.data(), end, array.components);
    if (error != std::errc() || stop != end || array.components < 1 ||
        array.components > kMostComponents) {
      in_.fail(header_, "expected a number of components, found " + quoted(components));
    }
  }
  constexpr std::string_view kTable = "lookup_table";
  const bool table_ahead =
      binary_ ? lower_case(in_.text().substr(in_.offset(), kTable.size())) == kTable
              : lower_case(in_.peek()) == kTable;
  if (table_ahead) in_.rest_of_line();
  finish(std::move(array), type);
}

void AttributeReader::read_texture_coordinates() {
  DataArray array;
  array.name = read_name();
  array.components = std::max(1, read_small_count("a number of components"));
  read_numbers(std::move(array), read_type());
}

// Reals from 0 to 1 in text, bytes from 0 to 255 in binary files.
void AttributeReader::read_colour_scalars() {
  DataArray array;
  array.name = read_name();
  array.components = std::max(1, read_small_count("a number of components"));
  read_numbers(std::move(array), binary_ ? kColourByte : kColourReal);
  if (!binary_) return;
  DataArray& colours = found_.arrays.back();
  for (std::int64_t byte : colours.integers) colours.reals.push_back(byte / 255.0);
  colours.integers.clear();
  colours.kind = ValueKind::real;
}

void AttributeReader::read_colour_table() {
  const std::string name = read_name();
  const int size = read_small_count("a number of colours");
  in_.rest_of_line();
  const VtkBlock block{"colour table " + quoted(name), header_, in_.offset(), binary_};
  read_vtk_values(in_, block, binary_ ? kColourByte : kColourReal, 4 * std::size_t(size));
  found_.notes.push_back("the colour table \"" + name + "\" was left out");
}

void AttributeReader::read_field() {
  const std::string name = read_name();
  const int n = read_small_count("a number of arrays");
  in_.rest_of_line();
  for (int i = 0; i < n; ++i) read_field_array(in_data_);
  if (!in_data_ && n > 0) found_.notes.push_back("field data of the whole file were left out");
}

void AttributeReader::read_field_array(bool keep) {
  while (lower_case(in_.peek_raw()) == "metadata") {
    in_.next();
    skip_vtk_metadata(in_);
  }
  header_ = in_.offset();
  DataArray array;
  array.name = read_name();
  array.components = read_small_count("a number of components");
  std::int64_t rows;
  if (!in_.read(rows)) in_.fail_expected("a number of rows");
  const auto most = static_cast<std::int64_t>(8 * in_.text().size());  // bits are the smallest
  if (keep ? rows != static_cast<std::int64_t>(rows_) : rows < 0 || rows > most) {
    in_.fail(header_, "data array \"" + array.name + "\": expected " +
                          (keep ? std::to_string(rows_) : "fewer") + " rows, found " +
                          std::to_string(rows));
  }
  const std::size_t count = static_cast<std::size_t>(rows) * array.components;
  if (lower_case(in_.peek()) == "string") {
    in_.rest_of_line();
    found_.notes.push_back("the array of strings \"" + array.name + "\" was left out");
    return skip_strings(count);
  }
  const VtkType type = read_type();
  in_.rest_of_line();
  if (keep && array.components > 0) return finish(std::move(array), type);
  const VtkBlock block{"data array " + quoted(array.name), header_, in_.offset(), binary_};
  read_vtk_values(in_, block, type, count);
}

void AttributeReader::skip_strings(std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    if (in_.remaining() == 0) in_.fail_expected(std::to_string(count) + " strings");
    if (binary_) {
      skip_binary_string();
    } else {
      in_.rest_of_line();
    }
  }
}

// A string's length comes first, in 1, 2, 4 or 8 bytes; the first two bits tell how many.
void AttributeReader::skip_binary_string() {
  const std::string_view rest = in_.text().substr(in_.offset());
  const std::size_t width = std::size_t{8} >> (static_cast<unsigned char>(rest[0]) >> 6);
  std::size_t length = static_cast<unsigned char>(rest[0]) & 0x3f;
  for (std::size_t i = 1; i < std::min(width, rest.size()); ++i) {
    length = length << 8 | static_cast<unsigned char>(rest[i]);
  }
  if (rest.size() < width || rest.size() - width < length) {
    in_.fail(header_, "expected a string of " + std::to_string(length) +
                          " bytes, found the end of the file");
  }
  in_.seek(in_.offset() + width + length);
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

}  // namespace

VtkAttributes read_vtk_attribute(TextScanner& in, bool binary, bool in_data, std::size_t rows) {
  return AttributeReader(in, binary, in_data, rows).read();
}

void skip_vtk_metadata(TextScanner& in) {
  in.rest_of_line();
  while (in.remaining() > 0 && !in.rest_of_line().empty()) {
  }
}

std::string encode_vtk_name(std::string_view name) {
  static constexpr char kDigits[] = "0123456789ABCDEF";
  std::string result;
  for (char c : name) {
    if (c > ' ' && c <= '~' && c != '%' && c != '"' && c != '#') {
      result += c;
    } else {
      result += {'%', kDigits[static_cast<unsigned char>(c) >> 4], kDigits[c & 15]};
    }
  }
  return result;
}

std::string decode_vtk_name(std::string_view word) {
  std::string result;
  for (std::size_t i = 0; i < word.size(); ++i) {
    const bool coded = word[i] == '%' && i + 2 < word.size() && hex_digit(word[i + 1]) >= 0 &&
                       hex_digit(word[i + 2]) >= 0;
    result +=
        coded ? static_cast<char>(16 * hex_digit(word[i + 1]) + hex_digit(word[i + 2])) : word[i];
    if (coded) i += 2;
  }
  return result;
}

}  // namespace hexweft::detail
