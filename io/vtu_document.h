/// \file
/// The XML of a .vtu file: its elements, its appended data, and how its numbers are encoded.
#pragma once

#include <bit>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>

#include "io/text_scanner.h"
#include "io/vtk_values.h"

namespace hexweft::detail {

class VtuDocument {
 public:
  /// \param text  the whole file, which must outlive the document
  /// \throws FormatError if it is no XML, or that of another file than an unstructured grid
  VtuDocument(std::string_view text, const std::string& path);

  pugi::xml_node grid() const { return grid_; }            ///< <UnstructuredGrid>
  std::endian byte_order() const { return byte_order_; }   ///< of binary numbers
  const VtkType& header_type() const { return *header_; }  ///< of the sizes before binary data
  const std::string& compressor() const { return compressor_; }  ///< empty: none

  /// The data that elements refer to by offset; empty if there are none.
  std::optional<std::string_view> appended() const { return appended_; }
  bool appended_is_base64() const { return appended_is_base64_; }

  const TextScanner& scanner() const { return in_; }  ///< the file, from its start
  /// Where the element stands in the file.
  std::size_t offset_of(pugi::xml_node element) const;
  /// The text that stands directly in the element, as in the file up to its end, from which on it
  /// is read; nothing is read where the element has no text.
  TextScanner text_of(pugi::xml_node element) const;

  /// \throws FormatError if the attribute is not there or no integer from `least` to `most`
  std::int64_t integer(pugi::xml_node element, const char* attribute, std::int64_t least,
                       std::int64_t most) const;
  /// \throws FormatError at the line of the element
  [[noreturn]] void fail(pugi::xml_node element, const std::string& message) const;

 private:
  std::string without_appended_data();
  void parse();
  void read_header();
  void read_encoding();
  std::size_t offset_in_file(std::ptrdiff_t offset) const;

  TextScanner in_;
  std::string path_;
  std::string xml_text_;  // what the parsed XML points into
  pugi::xml_document xml_;
  std::size_t cut_ = std::string_view::npos;  // where appended data were taken out of the XML
  pugi::xml_node grid_;
  std::endian byte_order_ = std::endian::little;
  std::optional<VtkType> header_;
  std::string compressor_;
  std::optional<std::string_view> appended_;
  bool appended_is_base64_ = false;
};

/// The attribute that tells an array of bools, written as UInt8, from one of integers (vtu.h).
inline constexpr const char* kVtuBit = "Bit";

/// The type of this name as a .vtu file has it ("UInt8"); empty if there is none.
std::optional<VtkType> find_vtu_type(std::string_view name);

}  // namespace hexweft::detail
