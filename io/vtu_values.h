/// \file
/// The numbers of a DataArray element: ascii, binary (base64 in the element) or appended (base64 or
/// raw at the end of the file), the latter two also compressed by zlib.
///
/// Binary data start with their size in bytes. Compressed data start with the number of blocks, the
/// size of a block, that of the last one if it is smaller (else 0), and the compressed sizes of all
/// blocks, which follow. Source: "VTK XML Formats", docs.vtk.org.
#pragma once

#include <string>

#include "io/data_array.h"
#include "io/vtu_document.h"

namespace hexweft::detail {

struct VtuValues {
  VtkBlock block;  ///< for fail_at_value
  DataArray array;
};

/// Reads `count` numbers; the array has neither name nor components set.
/// \param title  what the numbers are, for messages
/// \throws FormatError at the number that is malformed or too large; if it is not exactly `count`
///         numbers that the element has; if they are compressed by other means than zlib
VtuValues read_vtu_values(const VtuDocument& document, pugi::xml_node element,
                          const std::string& title, const VtkType& type, std::size_t count);

}  // namespace hexweft::detail
