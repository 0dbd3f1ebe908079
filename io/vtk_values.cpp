#include "io/vtk_values.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>

#include "io/binary_numbers.h"

namespace hexweft::detail {
namespace {

// vtkIdType is written as 32 bits whatever the writer's own width is.
constexpr std::array<VtkType, 15> kTypes{{
    {"bit", ValueKind::bit, 0, false},
    {"char", ValueKind::integer, 1, true},
    {"signed_char", ValueKind::integer, 1, true},
    {"unsigned_char", ValueKind::integer, 1, false},
    {"short", ValueKind::integer, 2, true},
    {"unsigned_short", ValueKind::integer, 2, false},
    {"int", ValueKind::integer, 4, true},
    {"unsigned_int", ValueKind::integer, 4, false},
    {"long", ValueKind::integer, 8, true},
    {"unsigned_long", ValueKind::integer, 8, false},
    {"vtkidtype", ValueKind::integer, 4, true},
    {"vtktypeint64", ValueKind::integer, 8, true},
    {"vtktypeuint64", ValueKind::integer, 8, false},
    {"float", ValueKind::real, 4, true},
    {"double", ValueKind::real, 8, true},
}};

DataArray read_binary(TextScanner& in, const VtkBlock& block, const VtkType& type,
                      std::size_t count) {
  const std::size_t per_byte = type.bytes == 0 ? 8 : 1, width = std::max(type.bytes, 1);
  const std::size_t available = in.remaining() / width;  // the division cannot overflow
  if ((count + per_byte - 1) / per_byte > available) {
    in.fail(block.header, block.title + ": expected " + std::to_string(count) +
                              " numbers of type " + std::string(type.name) + ", found " +
                              std::to_string(available * per_byte) + " to the end of the file");
  }
  DataArray array =
      decode_vtk_values(in, block, type, count, in.text().data() + in.offset(), std::endian::big);
  in.seek(in.offset() + type.bytes_of(count));
  return array;
}

template <class T>
std::vector<T> read_text(TextScanner& in, const VtkBlock& block, std::size_t count) {
  std::vector<T> values;
  values.reserve(std::min(count, in.remaining() / 2 + 1));  // a lying count must not cost memory
  for (std::size_t i = 0; i < count; ++i) {
    T value;
    if (!in.read(value)) {
      in.fail_expected(std::string(std::is_same_v<T, double> ? "a number" : "an integer") + " (" +
                       std::to_string(i + 1) + " of " + std::to_string(count) + " of " +
                       block.title + ")");
    }
    values.push_back(value);
  }
  return values;
}

}  // namespace

std::optional<VtkType> find_vtk_type(std::string_view name) {
  const std::string lower = lower_case(name);
  for (const VtkType& type : kTypes) {
    if (type.name == lower) return type;
  }
  return std::nullopt;
}

DataArray read_vtk_values(TextScanner& in, const VtkBlock& block, const VtkType& type,
                          std::size_t count) {
  if (block.binary) return read_binary(in, block, type, count);
  DataArray array;
  array.kind = type.kind;
  if (type.kind == ValueKind::real) {
    array.reals = read_text<double>(in, block, count);
  } else {
    array.integers = read_text<std::int64_t>(in, block, count);
  }
  return array;
}

void fail_at_value(TextScanner in, const VtkBlock& block, std::size_t index,
                   const std::string& message) {
  if (block.binary) in.fail(block.header, message);
  in.seek(block.numbers);
  for (std::size_t i = 0; i < index; ++i) in.next();
  in.peek();  // to the start of the number itself
  in.fail(in.offset(), message);
}

DataArray decode_vtk_values(const TextScanner& in, const VtkBlock& block, const VtkType& type,
                            std::size_t count, const char* bytes, std::endian order) {
  DataArray array;
  array.kind = type.kind;
  if (type.kind == ValueKind::real) {
    array.reals.resize(count);
    for (double& real : array.reals) {
      real = load_real(bytes, type.bytes, order);
      bytes += type.bytes;
    }
    return array;
  }
  array.integers.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    array.integers[i] =
        type.kind == ValueKind::bit ? bytes[i / 8] >> (7 - i % 8) & 1
        : type.is_signed
            ? load_signed(bytes + i * type.bytes, type.bytes, order)
            : static_cast<std::int64_t>(load_unsigned(bytes + i * type.bytes, type.bytes, order));
    if (!type.is_signed && array.integers[i] < 0) {
      in.fail(block.header, block.title + ": number " + std::to_string(i) + " is beyond 2^63");
    }
  }
  return array;
}

}  // namespace hexweft::detail
