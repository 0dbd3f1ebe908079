#include "io/xml_text.h"

#include <cstdint>

namespace hexweft::detail {
namespace {

bool is_xml_character(std::uint32_t c) {
  if (c < 0x20) return c == '\t' || c == '\n' || c == '\r';
  return c < 0xD800 || (c >= 0xE000 && c <= 0xFFFD) || (c >= 0x10000 && c <= 0x10FFFF);
}

// Takes a character of UTF-8 off the text; false if there is none at its start.
bool take_character(std::string_view& text, std::uint32_t& character) {
  const auto first = static_cast<unsigned char>(text[0]);
  const std::size_t length = first < 0x80 ? 1 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
  if (length > text.size()) return false;
  character = length == 1 ? first : first & (0x7F >> length);
  for (std::size_t i = 1; i < length; ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if ((byte & 0xC0) != 0x80) return false;
    character = character << 6 | (byte & 0x3F);
  }
  text.remove_prefix(length);
  // The shortest form is the only one allowed, which also sorts out bytes that start none.
  constexpr std::uint32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  return character >= kLeast[length];
}

}  // namespace

bool is_xml_text(std::string_view text) {
  while (!text.empty()) {
    std::uint32_t character;
    if (!take_character(text, character) || !is_xml_character(character)) return false;
  }
  return true;
}

std::string xml_attribute_text(std::string_view text) {
  std::string result;
  for (char c : text) {
    // Readers take a bare tab or line end in an attribute for a space.
    constexpr std::string_view kSpecial = "&<>\"\t\n\r";
    if (kSpecial.find(c) == std::string_view::npos) {
      result += c;
    } else {
      result += "&#" + std::to_string(int{c}) + ";";
    }
  }
  return result;
}

}  // namespace hexweft::detail
