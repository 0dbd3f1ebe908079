/// \file
/// The data sections of a legacy VTK file: SCALARS, VECTORS, NORMALS, TENSORS, FIELD and so on.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/vtk_values.h"

namespace hexweft::detail {

struct VtkAttributes {
  std::vector<DataArray> arrays;
  std::vector<std::string> notes;
};

/// Reads the section at the cursor.
/// \param in_data  whether it belongs to points or cells; if not, only field data and colour tables
/// may
///                 come, and both are left out with a note
/// \param rows     number of points or cells in the file
/// \throws FormatError if it is no such section or does not hold what it announces
VtkAttributes read_vtk_attribute(TextScanner& in, bool binary, bool in_data, std::size_t rows);

/// Skips the block that ends at the first empty line; the cursor is behind its keyword METADATA.
void skip_vtk_metadata(TextScanner& in);

/// Names of arrays are one word in the file: other characters are written %XX, as VTK does.
std::string encode_vtk_name(std::string_view name);
std::string decode_vtk_name(std::string_view word);

}  // namespace hexweft::detail
