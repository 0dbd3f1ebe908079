/// \file
/// Numbers of VTK's files, as text or binary, in any of their types.
#pragma once

#include <bit>
#include <optional>
#include <string>
#include <string_view>

#include "io/data_array.h"
#include "io/text_scanner.h"

namespace hexweft::detail {

/// A number type of VTK's files.
struct VtkType {
  std::string_view name;  ///< of a legacy file in lower case
  ValueKind kind;
  int bytes;  ///< of one number in a binary file; 0: packed bits
  bool is_signed;
  /// Bytes of so many numbers in a binary file.
  std::size_t bytes_of(std::size_t count) const {
    return bytes == 0 ? count / 8 + (count % 8 != 0) : count * bytes;
  }
};

/// The type of a legacy file of this name, in any case; empty if there is none.
std::optional<VtkType> find_vtk_type(std::string_view name);

/// A table of numbers in the file: where the line announcing it starts and where its numbers start.
struct VtkBlock {
  std::string title;  ///< for messages: "POINTS", "data array \"fixed\""
  std::size_t header = 0, numbers = 0;
  bool binary = false;
};

/// Reads `count` numbers at the cursor, binary ones as big-endian. The array has neither name nor components set.
/// \throws FormatError at the number that is missing, malformed or too large
DataArray read_vtk_values(TextScanner& in, const VtkBlock& block, const VtkType& type,
                          std::size_t count);

/// \throws FormatError at the line of number `index` of a text block, at the header of a binary one
[[noreturn]] void fail_at_value(TextScanner in, const VtkBlock& block, std::size_t index,
                                const std::string& message);

/// The numbers that bytes stand for.
/// \pre    there are type.bytes_of(count) bytes
/// \throws FormatError at the header of the block if one is too large
DataArray decode_vtk_values(const TextScanner& in, const VtkBlock& block, const VtkType& type,
                            std::size_t count, const char* bytes, std::endian order);

}  // namespace hexweft::detail
