/// \file
/// Text as it may stand in an attribute of an XML file. Source: XML 1.0, W3C, §2.2 and §2.4.
#pragma once

#include <string>
#include <string_view>

namespace hexweft::detail {

/// Whether an XML file can hold the text: UTF-8 without most control characters.
bool is_xml_text(std::string_view text);

/// The text as the value of an attribute in double quotes.
std::string xml_attribute_text(std::string_view text);

}  // namespace hexweft::detail
