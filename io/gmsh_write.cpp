#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "io/gmsh.h"
#include "io/medit.h"
#include "io/number_writer.h"

namespace hexweft {
namespace {

using namespace detail;

class GmshWriter {
 public:
  GmshWriter(const WriteOptions& options, std::string& out, std::vector<std::string>& notes)
      : options_(options), out_(out), notes_(notes), rows_(options, std::endian::little, out) {}

  void write(const HexMesh& mesh) {
    auto of_cells = property_arrays<CellTag>(mesh, notes_);
    const auto of_vertices = property_arrays<VertexTag>(mesh, notes_);
    write_format();
    write_nodes(mesh);
    write_elements(mesh, take_groups(of_cells));
    for (const DataArray& array : of_vertices) write_data("NodeData", array);
    for (const DataArray& array : of_cells) write_data("ElementData", array);
  }

 private:
  struct Groups {
    std::vector<std::int64_t> physical, geometrical;  // of each cell; empty: none
  };
  void write_format();
  void write_nodes(const HexMesh& mesh);
  Groups take_groups(std::vector<DataArray>& of_cells);
  void write_elements(const HexMesh& mesh, const Groups& groups);
  void write_data(const char* section, const DataArray& array);
  bool has_place(const DataArray& array);
  void leave_out(const DataArray& array, const std::string& reason) {
    notes_.push_back(left_out(array.name, reason));
  }

  template <class... Part>
  void line(const Part&... parts) {
    ((out_ += parts), ...);
    out_ += '\n';
  }
  void end_section(const char* name) {
    if (options_.binary) out_ += '\n';
    line("$End", name);
  }

  const WriteOptions& options_;
  std::string& out_;
  std::vector<std::string>& notes_;
  NumberWriter rows_;  // the lowest byte first everywhere, as most files are
};

// The tags of that name, which leave the arrays, or none; those that no tag can be stay data.
std::vector<std::int64_t> take_tags(std::vector<DataArray>& arrays, const char* name) {
  const auto it = find_integers(arrays, name);
  const auto is_tag = [](std::int64_t x) {
    return x >= 0 && x <= std::numeric_limits<std::int32_t>::max();
  };
  if (it == arrays.end() || !std::all_of(it->integers.begin(), it->integers.end(), is_tag))
    return {};
  std::vector<std::int64_t> tags = std::move(it->integers);
  arrays.erase(it);
  return tags;
}

void GmshWriter::write_format() {
  line("$MeshFormat");
  line("2.2 ", options_.binary ? "1" : "0", " 8");
  if (options_.binary) {
    rows_.put(std::int32_t{1});
    out_ += '\n';
  }
  line("$EndMeshFormat");
}

void GmshWriter::write_nodes(const HexMesh& mesh) {
  line("$Nodes");
  line(std::to_string(mesh.n_vertices()));
  std::int32_t tag = 0;
  for (VertexHandle v : mesh.vertices()) {
    rows_.put(++tag);
    for (double x : mesh.point(v)) rows_.put(x);
    rows_.end_row();
  }
  end_section("Nodes");
}

// Gmsh puts whole volumes into groups: where volumes are not told, each group becomes one.
GmshWriter::Groups GmshWriter::take_groups(std::vector<DataArray>& of_cells) {
  Groups groups{take_tags(of_cells, kGmshPhysical), take_tags(of_cells, kGmshGeometrical)};
  const auto is_physical = [](const DataArray& array) { return array.name == kGmshPhysical; };
  if (groups.physical.empty() && std::none_of(of_cells.begin(), of_cells.end(), is_physical)) {
    groups.physical = take_tags(of_cells, kMeditReference);
    if (!groups.physical.empty()) {
      notes_.push_back("property \"" + std::string(kMeditReference) +
                       "\" of cells was written as their physical groups");
    }
  }
  if (groups.physical.empty()) return groups;
  if (groups.geometrical.empty()) {
    groups.geometrical = groups.physical;
    notes_.push_back("the cells have no \"" + std::string(kGmshGeometrical) +
                     "\": each physical group became a volume of its own");
  }
  std::map<std::int64_t, std::set<std::int64_t>> physical_of;
  for (std::size_t i = 0; i < groups.physical.size(); ++i) {
    physical_of[groups.geometrical[i]].insert(groups.physical[i]);
  }
  for (const auto& [volume, physical] : physical_of) {
    if (physical.size() == 1) continue;
    notes_.push_back("volume " + std::to_string(volume) + " has cells of " +
                     std::to_string(physical.size()) +
                     " physical groups: Gmsh will put all of it into each");
  }
  return groups;
}

void GmshWriter::write_elements(const HexMesh& mesh, const Groups& groups) {
  constexpr std::int32_t kHexahedron = 5, kGroups = 2;
  const std::vector<int> number = vertex_numbers(mesh);
  line("$Elements");
  line(std::to_string(mesh.n_cells()));
  if (options_.binary) {  // one block: its type, how many there are, and their number of groups
    rows_.put(kHexahedron);
    rows_.put(static_cast<std::int32_t>(mesh.n_cells()));
    rows_.put(kGroups);
  }
  std::int32_t row = 0;
  const auto tag = [&](const std::vector<std::int64_t>& tags) {
    return static_cast<std::int32_t>(tags.empty() ? 0 : tags[row]);
  };
  for (CellHandle c : mesh.cells()) {
    rows_.put(row + 1);
    if (!options_.binary) {
      rows_.put(kHexahedron);
      rows_.put(kGroups);
    }
    rows_.put(tag(groups.physical));
    rows_.put(tag(groups.geometrical));
    for (VertexHandle v : mesh.vertices(c)) rows_.put(number[v.idx] + 1);
    rows_.end_row();
    ++row;
  }
  end_section("Elements");
}

bool GmshWriter::has_place(const DataArray& array) {
  if (array.components != 1 && array.components != 3 && array.components != 9) {
    leave_out(array, "it has " + std::to_string(array.components) +
                         " components, and data of Gmsh 1, 3 or 9");
    return false;
  }
  const auto breaks_name = [](unsigned char c) { return c < ' ' || c == '"'; };
  if (std::any_of(array.name.begin(), array.name.end(), breaks_name)) {
    leave_out(array, "Gmsh has no way to write its name");
    return false;
  }
  if (array.kind == ValueKind::real) return true;
  if (!fits_double(array)) {
    leave_out(array, "data of Gmsh are reals, which cannot hold its integers");
    return false;
  }
  notes_.push_back("property \"" + array.name + "\" was written as reals: Gmsh has no other data");
  return true;
}

void GmshWriter::write_data(const char* section, const DataArray& array) {
  if (array.size() == 0 || !has_place(array)) return;
  const std::size_t rows = array.size() / array.components;
  line("$", section);
  line("1\n\"", array.name, "\"");                                               // texts: the name
  line("1\n0");                                                                  // reals: the time
  line("3\n0\n", std::to_string(array.components), "\n", std::to_string(rows));  // the step first
  std::size_t next = 0;
  for (std::size_t i = 0; i < rows; ++i) {
    rows_.put(static_cast<std::int32_t>(i + 1));
    for (int j = 0; j < array.components; ++j, ++next) {
      rows_.put(array.kind == ValueKind::real ? array.reals[next]
                                              : static_cast<double>(array.integers[next]));
    }
    rows_.end_row();
  }
  end_section(section);
}

}  // namespace

void write_gmsh(const HexMesh& mesh, const WriteOptions& options, std::string& out,
                std::vector<std::string>& notes) {
  GmshWriter(options, out, notes).write(mesh);
}

}  // namespace hexweft
