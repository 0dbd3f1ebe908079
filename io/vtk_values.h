/// \file
/// Numbers of a legacy VTK file, as text or as big-endian binary, in any of its types.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "io/data_array.h"
#include "io/text_scanner.h"

namespace hexweft::detail {

/// A number type of a legacy VTK file.
struct VtkType {
  std::string_view name;  ///< in lower case
  ValueKind kind;
  int bytes;  ///< of one number in a binary file; 0: packed bits
  bool is_signed;
};

/// The type of this name, in any case; empty if there is none.
std::optional<VtkType> find_vtk_type(std::string_view name);

/// Reads an integer from 0 to `most`. \throws FormatError "expected <what> in [0, <most>], found
/// ..."
std::int64_t read_vtk_count(TextScanner& in, const std::string& what, std::int64_t most);

/// A table of numbers in the file: where the line announcing it starts and where its numbers start.
struct VtkBlock {
  std::string title;  ///< for messages: "POINTS", "data array \"fixed\""
  std::size_t header = 0, numbers = 0;
  bool binary = false;
};

/// Reads `count` numbers at the cursor. The array has neither name nor components set.
/// \throws FormatError at the number that is missing, malformed or too large
DataArray read_vtk_values(TextScanner& in, const VtkBlock& block, const VtkType& type,
                          std::size_t count);

/// \throws FormatError at the line of number `index` of a text block, at the header of a binary one
[[noreturn]] void fail_at_value(TextScanner in, const VtkBlock& block, std::size_t index,
                                const std::string& message);

/// Appends a number as a big-endian one.
template <class T>
void append_big_endian(std::string& out, T value);

}  // namespace hexweft::detail
