#include <algorithm>
#include <map>
#include <set>

#include "io/gmsh.h"
#include "io/gmsh_data.h"
#include "io/gmsh_elements.h"
#include "io/gmsh_nodes.h"

namespace hexweft {
namespace {

using namespace detail;

class GmshReader {
 public:
  GmshReader(std::string_view text, const std::string& path) : in_(text, path) {}

  MeshData read() {
    if (!in_.peek().starts_with('$')) in_.fail_expected("$MeshFormat");
    sections_ = split_gmsh_sections(in_);
    read_format();
    read_entities();
    read_nodes();
    read_elements();
    read_data();
    check_end();
    finish_notes();
    return std::move(data_);
  }

 private:
  void read_format();
  void read_byte_order(const GmshSection& section);
  void read_entities();
  void read_nodes();
  void read_elements();
  void read_data();
  void check_end() const;
  void finish_notes();

  /// The section of that name; null if there is none. \throws FormatError if there are two
  const GmshSection* find(const std::string& name);
  const GmshSection& find_required(const std::string& name);
  GmshValues values(const GmshSection& section) const { return {in_, section, layout_}; }

  TextScanner in_;
  MeshData data_;
  GmshLayout layout_;
  std::vector<GmshSection> sections_;  // in any order: data may come before nodes
  std::set<std::string> used_{"Comments"};
  GmshNodes nodes_{data_};
  GmshElements elements_{nodes_.tags(), data_};
};

const GmshSection* GmshReader::find(const std::string& name) {
  const GmshSection* found = nullptr;
  for (const GmshSection& section : sections_) {
    if (section.name != name) continue;
    if (found) in_.fail(section.header, "$" + name + " appears twice");
    found = &section;
  }
  used_.insert(name);
  return found;
}

const GmshSection& GmshReader::find_required(const std::string& name) {
  if (const GmshSection* section = find(name)) return *section;
  check_end();
  in_.seek(in_.text().size());
  in_.fail_expected("$" + name);
}

// The version; 0 for text or 1 for binary; the bytes of a real, or from version 4 on of a size.
void GmshReader::read_format() {
  const auto first =
      std::find_if(sections_.begin(), sections_.end(),
                   [](const GmshSection& section) { return section.name != "Comments"; });
  if (first != sections_.end() && first->name != "MeshFormat") {
    in_.seek(first->header);
    in_.fail_expected("$MeshFormat");
  }
  const GmshSection& section = find_required("MeshFormat");
  GmshValues in = values(section);
  const char* versions = "a version from 2.0 to 2.2, 4.0 or 4.1";
  const std::size_t where = in.where();
  const double version = in.read_real(versions);
  if (version == 4.0 || version == 4.1) {
    layout_.version = version == 4.0 ? GmshVersion::v40 : GmshVersion::v41;
  } else if (version != 2.0 && version != 2.1 && version != 2.2) {
    in_.seek(where);
    in_.fail_expected(versions);
  }
  if (in.read_int({0, 1}, "0 for text or 1 for binary") == 1) {
    in.read_int({8, 8}, "a data size of 8 bytes");
    read_byte_order(section);
  } else {
    in.read_int(kGmshInts, "a data size");
    in.expect_end();
  }
}

// The number 1 in binary follows the first line.
void GmshReader::read_byte_order(const GmshSection& section) {
  constexpr std::int64_t kOne = 1, kSwappedOne = 0x01000000;
  layout_.is_binary = true;
  GmshValues in = values(section);
  for (int i = 0; i < 3; ++i) in.read_real("a number of the first line");
  in.begin_binary();
  const std::int64_t one = in.read_int(kGmshInts, "the number 1 that tells the byte order");
  in.expect_end();
  if (one == kSwappedOne) {
    layout_.byte_order = std::endian::big;
  } else if (one != kOne) {
    in.fail(in.header(), "$MeshFormat: expected the number 1 that tells the byte order, found " +
                             std::to_string(one));
  }
}

void GmshReader::read_entities() {
  const GmshSection* section = layout_.version == GmshVersion::v2 ? nullptr : find("Entities");
  if (!section) return;
  GmshValues in = values(*section);
  elements_.read_entities(in);
}

void GmshReader::read_nodes() {
  const GmshSection* parametric =
      layout_.version == GmshVersion::v2 ? find("ParametricNodes") : nullptr;
  GmshValues in = values(parametric ? *parametric : find_required("Nodes"));
  nodes_.read(in, parametric != nullptr);
}

void GmshReader::read_elements() {
  GmshValues in = values(find_required("Elements"));
  elements_.read(in);
}

void GmshReader::read_data() {
  for (const GmshSection& section : sections_) {
    const bool of_nodes = section.name == "NodeData";
    if (!of_nodes && section.name != "ElementData") continue;
    used_.insert(section.name);
    GmshValues in = values(section);
    if (of_nodes) {
      read_gmsh_data(in, nodes_.tags(), data_.points.size(), true, data_.point_data, data_.notes);
    } else {
      read_gmsh_data(in, elements_.tags(), data_.cells.size(), false, data_.cell_data, data_.notes);
    }
  }
}

// A section without an end takes in all that follows, so that only the last can be one.
void GmshReader::check_end() const {
  const GmshSection& last = sections_.back();
  if (last.is_closed) return;
  in_.fail(last.header,
           "expected $End" + last.name + " after $" + last.name + ", found the end of the file");
}

void GmshReader::finish_notes() {
  std::map<std::string, int> others;
  for (const GmshSection& section : sections_) {
    if (!used_.contains(section.name)) ++others[section.name];
  }
  // Each time step of the same data brings the same notes.
  std::set<std::string> said;
  std::erase_if(data_.notes, [&](const std::string& note) { return !said.insert(note).second; });
  for (const auto& [name, n] : others) {
    data_.notes.push_back((n == 1 ? "section $" : std::to_string(n) + " sections $") + name +
                          (n == 1 ? " was left out" : " were left out"));
  }
}

}  // namespace

bool is_gmsh(std::string_view text) {
  TextScanner in(text, "");
  while (in.peek() == "$Comments") {
    in.seek(std::min(text.find("$EndComments", in.offset()), text.size()));
    in.next();
  }
  return in.peek() == "$MeshFormat";
}

MeshData read_gmsh(std::string_view text, const std::string& path) {
  return GmshReader(text, path).read();
}

}  // namespace hexweft
