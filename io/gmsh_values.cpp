#include "io/gmsh_values.h"

#include "io/binary_numbers.h"

namespace hexweft::detail {

std::vector<GmshSection> split_gmsh_sections(TextScanner in) {
  std::vector<GmshSection> sections;
  const std::string_view text = in.text();
  while (!in.at_end()) {
    const std::string_view word = in.peek();
    if (word.size() < 2 || word[0] != '$' || word.starts_with("$End")) {
      in.fail_expected("the start of a section");
    }
    GmshSection section;
    section.header = in.offset();
    section.name = in.next().substr(1);
    section.begin = in.offset();
    const std::size_t end = text.find("$End" + section.name, section.begin);
    section.is_closed = end != std::string_view::npos;
    section.end = std::min(end, text.size());
    in.seek(section.end);
    in.next();
    sections.push_back(std::move(section));
  }
  return sections;
}

const char* GmshValues::take_bytes(std::size_t n) {
  if (section_.end < in_.offset() || section_.end - in_.offset() < n) return nullptr;
  const char* bytes = in_.text().data() + in_.offset();
  in_.seek(in_.offset() + n);
  return bytes;
}

bool GmshValues::load(std::int64_t& value, int n_bytes) {
  if (!binary_) return in_.read(value);
  const char* bytes = take_bytes(n_bytes);
  if (bytes) value = load_signed(bytes, n_bytes, layout_.byte_order);
  return bytes != nullptr;
}

bool GmshValues::load(double& value) {
  if (!binary_) return in_.read(value);
  const char* bytes = take_bytes(sizeof(value));
  if (bytes) value = load_real(bytes, sizeof(value), layout_.byte_order);
  return bytes != nullptr;
}

GmshEntity GmshValues::read_entity() {
  constexpr GmshRange kDimensions{0, 3};
  const auto read_dimension = [&] {
    return read_int(kDimensions, "the dimension of a block in [0, 3]");
  };
  const auto read_tag = [&] { return read_int(kGmshInts, "the tag (an integer) of a block"); };
  GmshEntity entity;
  if (layout_.version == GmshVersion::v40) {
    entity.tag = read_tag();
    entity.dimension = read_dimension();
  } else {
    entity.dimension = read_dimension();
    entity.tag = read_tag();
  }
  return entity;
}

void GmshValues::fail_expected(const std::string& what) {
  if (!binary_) in_.fail_expected(what);
  fail_found(in_.offset(), what, "the end of the section");
}

void GmshValues::fail_found(std::size_t before, const std::string& what, const std::string& found) {
  if (!binary_) {
    in_.seek(before);
    in_.fail_expected(what);
  }
  in_.fail(section_.header, "$" + section_.name + ": expected " + what + ", found " + found);
}

void GmshValues::expect_end() {
  const std::string end = "$End" + section_.name;
  if (binary_ && in_.offset() < section_.end) {
    // Binary numbers end with a line end, which some writers leave out.
    const std::string_view rest = in_.text().substr(in_.offset(), section_.end - in_.offset());
    if (rest != "\n" && rest != "\r\n") {
      in_.fail(section_.header, "$" + section_.name + ": expected " + end + ", found " +
                                    std::to_string(rest.size()) + " bytes before it");
    }
  }
  if (in_.peek() != end) in_.fail_expected(end);
}

}  // namespace hexweft::detail
