#include "io/vtu_document.h"

#include <algorithm>
#include <array>

namespace hexweft::detail {
namespace {

constexpr std::array<VtkType, 11> kTypes{{
    {"Bit", ValueKind::bit, 0, false},
    {"Int8", ValueKind::integer, 1, true},
    {"UInt8", ValueKind::integer, 1, false},
    {"Int16", ValueKind::integer, 2, true},
    {"UInt16", ValueKind::integer, 2, false},
    {"Int32", ValueKind::integer, 4, true},
    {"UInt32", ValueKind::integer, 4, false},
    {"Int64", ValueKind::integer, 8, true},
    {"UInt64", ValueKind::integer, 8, false},
    {"Float32", ValueKind::real, 4, true},
    {"Float64", ValueKind::real, 8, true},
}};

}  // namespace

std::optional<VtkType> find_vtu_type(std::string_view name) {
  const auto it = std::find_if(kTypes.begin(), kTypes.end(),
                               [&](const VtkType& type) { return type.name == name; });
  return it == kTypes.end() ? std::nullopt : std::optional(*it);
}

VtuDocument::VtuDocument(std::string_view text, const std::string& path)
    : in_(text, path), path_(path) {
  xml_text_ = without_appended_data();
  parse();
  read_header();
  read_encoding();
}

// Appended data may be raw bytes, which no parser of XML takes. Their end is the file's last end
// tag of that name, for such bytes may spell one.
std::string VtuDocument::without_appended_data() {
  const std::string_view text = in_.text();
  const std::size_t element = text.find("<AppendedData");
  const std::size_t tag_end = text.find('>', element);
  if (tag_end == std::string_view::npos || text[tag_end - 1] == '/') return std::string(text);
  const std::size_t mark = text.find_first_not_of(" \t\r\n", tag_end + 1);
  const std::size_t end = text.rfind("</AppendedData");
  if (mark == std::string_view::npos || end == std::string_view::npos || end < mark) {
    in_.fail(element, "expected </AppendedData>, found the end of the file");
  }
  if (text[mark] != '_') {
    in_.fail(mark, "expected \"_\" at the start of the appended data, found " +
                       quoted(text.substr(mark, 1)));
  }
  appended_ = text.substr(mark + 1, end - mark - 1);
  cut_ = mark + 1;
  return std::string(text.substr(0, cut_)).append(text.substr(end));
}

void VtuDocument::parse() {
  // With the encoding given nothing is converted, so that offsets are those of the file.
  const pugi::xml_parse_result result = xml_.load_buffer_inplace(
      xml_text_.data(), xml_text_.size(), pugi::parse_default, pugi::encoding_utf8);
  if (result) return;
  std::string problem = result.description();
  problem[0] = lower_case(problem)[0];
  in_.fail(offset_in_file(result.offset), "expected XML, found an error in it: " + problem);
}

void VtuDocument::read_header() {
  const pugi::xml_node root = xml_.child("VTKFile");
  if (!root) in_.fail(0, "expected an element <VTKFile>, found none");
  const std::string_view type = root.attribute("type").value();
  if (type != "UnstructuredGrid") {
    fail(root, "expected a VTK file of type \"UnstructuredGrid\", found " + quoted(type));
  }
  const std::string_view version = root.attribute("version").value();
  if (!version.empty() &&
      !(version[0] >= '0' && version[0] <= '2' && (version.size() == 1 || version[1] == '.'))) {
    fail(root, "expected a version from 0.1 to 2.x, found " + quoted(version));
  }
  grid_ = root.child("UnstructuredGrid");
  if (!grid_) fail(root, "expected an element <UnstructuredGrid>, found none");
}

void VtuDocument::read_encoding() {
  const pugi::xml_node root = grid_.parent();
  const std::string_view order = root.attribute("byte_order").as_string("LittleEndian");
  if (order != "LittleEndian" && order != "BigEndian") {
    fail(root, "expected a byte_order of LittleEndian or BigEndian, found " + quoted(order));
  }
  if (order == "BigEndian") byte_order_ = std::endian::big;
  const std::string_view header = root.attribute("header_type").as_string("UInt32");
  if (header != "UInt32" && header != "UInt64") {
    fail(root, "expected a header_type of UInt32 or UInt64, found " + quoted(header));
  }
  header_ = find_vtu_type(header);
  compressor_ = root.attribute("compressor").value();
  const pugi::xml_node data = root.child("AppendedData");
  const std::string_view encoding = data.attribute("encoding").as_string("base64");
  if (encoding != "raw" && encoding != "base64") {
    fail(data, "expected an encoding of raw or base64, found " + quoted(encoding));
  }
  appended_is_base64_ = encoding == "base64";
}

std::size_t VtuDocument::offset_in_file(std::ptrdiff_t offset) const {
  const auto in_xml = static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0));
  return in_xml < cut_ ? in_xml : in_xml + appended_->size();
}

std::size_t VtuDocument::offset_of(pugi::xml_node element) const {
  return offset_in_file(element.offset_debug());
}

TextScanner VtuDocument::text_of(pugi::xml_node element) const {
  std::size_t begin = offset_of(element), end = begin;
  for (pugi::xml_node child : element) {
    if (child.type() != pugi::node_pcdata) continue;
    if (begin != end) fail(element, "expected text without comments, found several pieces of it");
    begin = offset_of(child);
    end = std::min(in_.text().find('<', begin), in_.text().size());
  }
  TextScanner text(in_.text().substr(0, end), path_, "the end of the array");
  text.seek(begin);
  return text;
}

std::int64_t VtuDocument::integer(pugi::xml_node element, const char* attribute, std::int64_t least,
                                  std::int64_t most) const {
  const std::string expected = std::string("expected ") + attribute + " in [" +
                               std::to_string(least) + ", " + std::to_string(most) + "], found ";
  const pugi::xml_attribute found = element.attribute(attribute);
  if (!found) fail(element, expected + "no such attribute");
  TextScanner value(found.value(), "");
  std::int64_t result;
  if (!value.read(result) || !value.at_end() || result < least || result > most) {
    fail(element, expected + quoted(found.value()));
  }
  return result;
}

void VtuDocument::fail(pugi::xml_node element, const std::string& message) const {
  in_.fail(offset_of(element), message);
}

}  // namespace hexweft::detail
