#include "io/medit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "io/gmsh.h"
#include "io/number_text.h"
#include "io/text_scanner.h"

namespace hexweft {
namespace {

using namespace detail;

// How the names of sections of cells begin that a hex mesh cannot hold.
constexpr std::array<std::string_view, 6> kOtherSolids{"tetrahedra", "pyramids",   "prisms",
                                                       "pentahedra", "hexahedraq", "polyhedra"};

bool is_keyword(std::string_view word) {
  constexpr std::size_t kLongest = 40;
  const auto is_letter = [](char c) { return c >= 'a' && c <= 'z'; };
  const auto may_follow = [&](char c) { return is_letter(c) || (c >= '0' && c <= '9'); };
  return !word.empty() && word.size() <= kLongest && is_letter(word[0]) &&
         std::all_of(word.begin(), word.end(), may_follow);
}

class MeditReader {
 public:
  MeditReader(std::string_view text, const std::string& path) : in_(text, path) {}

  MeshData read() {
    read_header();
    while (!in_.at_end() && lower_case(in_.peek()) != "end") read_section();
    if (!have_vertices_) in_.fail_expected("Vertices");
    if (data_.cells.empty()) in_.fail_expected("Hexahedra");
    check_cells();
    add_references(data_.point_data, std::move(point_references_));
    add_references(data_.cell_data, std::move(cell_references_));
    return std::move(data_);
  }

 private:
  void read_header();
  void read_section();
  void read_vertices();
  void read_hexahedra();
  void check_cells();
  void refuse_solids();
  void skip_section();
  void add_references(std::vector<DataArray>& arrays, std::vector<std::int64_t> references);

  std::int64_t read_count(std::string_view section, std::int64_t most) {
    std::int64_t n;
    if (!in_.read(n)) in_.fail_expected("the number of " + std::string(section));
    if (n < 0 || n > most) {
      in_.fail(section_, std::string(section) + ": expected a number in [0, " +
                             std::to_string(most) + "], found " + std::to_string(n));
    }
    return n;
  }
  std::int64_t read_reference(const char* of, std::int64_t i) {
    std::int64_t reference;
    if (!in_.read(reference))
      in_.fail_expected("the reference (an integer) of " + std::string(of) + " " +
                        std::to_string(i + 1));
    return reference;
  }

  TextScanner in_;
  MeshData data_;
  std::size_t section_ = 0, first_hexahedron_ = 0;
  bool have_vertices_ = false, have_hexahedra_ = false;
  std::vector<std::int64_t> point_references_, cell_references_;
};

void MeditReader::read_header() {
  if (lower_case(in_.peek()) != "meshversionformatted") in_.fail_expected("MeshVersionFormatted");
  in_.next();
  const std::size_t before = in_.offset();
  std::int64_t version;
  if (!in_.read(version) || version < 1 || version > 4) {
    in_.seek(before);
    in_.fail_expected("a version from 1 to 4");
  }
}

void MeditReader::read_section() {
  const std::string keyword = lower_case(in_.peek());
  section_ = in_.offset();
  if (keyword == "dimension") {
    in_.next();
    std::int64_t dimension;
    const std::size_t before = in_.offset();
    if (!in_.read(dimension) || dimension != 3) {
      in_.seek(before);
      in_.fail_expected("dimension 3");
    }
    return;
  }
  if (keyword == "vertices") return read_vertices();
  if (keyword == "hexahedra") return read_hexahedra();
  if (!is_keyword(keyword)) in_.fail_expected("a section of a Medit file");
  for (std::string_view solids : kOtherSolids) {
    if (keyword.starts_with(solids)) refuse_solids();
  }
  skip_section();
}

void MeditReader::read_vertices() {
  in_.next();
  if (have_vertices_) in_.fail(section_, "Vertices appears twice");
  have_vertices_ = true;
  const std::int64_t n = read_count("Vertices", kMostPoints);
  data_.points.reserve(in_.room_for(n, 4));
  point_references_.reserve(in_.room_for(n, 4));
  for (std::int64_t i = 0; i < n; ++i) {
    Eigen::Vector3d p;
    for (double& x : p) {
      x = in_.read_finite([&] {
        return "a finite coordinate of vertex " + std::to_string(i + 1) + " of " +
               std::to_string(n);
      });
    }
    data_.points.push_back(p);
    point_references_.push_back(read_reference("vertex", i));
  }
}

void MeditReader::read_hexahedra() {
  in_.next();
  if (have_hexahedra_) in_.fail(section_, "Hexahedra appears twice");
  have_hexahedra_ = true;
  const std::int64_t n = read_count("Hexahedra", kMostCells);
  first_hexahedron_ = in_.offset();
  data_.cells.reserve(in_.room_for(n, 9));
  cell_references_.reserve(in_.room_for(n, 9));
  for (std::int64_t i = 0; i < n; ++i) {
    std::array<int, 8> cell;
    for (int& corner : cell) {
      std::int64_t v;
      const std::size_t before = in_.offset();
      if (!in_.read(v) || v < 1 || v > std::numeric_limits<int>::max()) {
        in_.seek(before);
        in_.fail_expected("a vertex number, 1 or more, of hexahedron " + std::to_string(i + 1) +
                          " of " + std::to_string(n));
      }
      corner = static_cast<int>(v - 1);
    }
    data_.cells.push_back(cell);
    cell_references_.push_back(read_reference("hexahedron", i));
  }
}

// After all sections are read: Hexahedra may come before Vertices.
void MeditReader::check_cells() {
  hexweft::check_cells(data_, 1, [&](int cell, const std::string& problem) {
    in_.seek(first_hexahedron_);
    for (int i = 0; i < 9 * cell; ++i) in_.next();
    in_.peek();
    in_.fail(in_.offset(), "hexahedron " + std::to_string(cell + 1) + " " + problem);
  });
}

void MeditReader::refuse_solids() {
  const std::size_t before = in_.offset();
  const std::string section(in_.next());
  const std::int64_t n = read_count(section, std::numeric_limits<int>::max());
  if (n > 0) {
    in_.fail(section_, "expected Hexahedra alone, found " + std::to_string(n) + " " + section);
  }
  in_.seek(before);
}

// Of most sections the first number is that of rows, but some have none, and how many numbers there
// are in a row is known of few: the numbers go on to the next word.
void MeditReader::skip_section() {
  const std::string section(in_.next());
  double first, number;
  if (!in_.read(first)) in_.fail_expected("a number of section " + section);
  std::int64_t n = 0;
  while (in_.read(number)) ++n;
  if (n == 0 && first == 0) return;
  const bool counts_rows = n > 0 && first >= 1 && first == std::floor(first) &&
                           std::fmod(static_cast<double>(n), first) == 0;
  data_.notes.push_back(counts_rows ? std::to_string(static_cast<std::int64_t>(first)) + " " +
                                          section + " were left out"
                                    : "section " + section + " was left out");
}

void MeditReader::add_references(std::vector<DataArray>& arrays,
                                 std::vector<std::int64_t> references) {
  if (std::all_of(references.begin(), references.end(), [](auto r) { return r == 0; })) return;
  DataArray array;
  array.name = kMeditReference;
  array.kind = ValueKind::integer;
  array.integers = std::move(references);
  arrays.push_back(std::move(array));
}

// The references, those of Gmsh if there are no others, or zeros; other properties have no place in
// the file.
template <class Tag>
std::vector<std::int64_t> references(const HexMesh& mesh, std::size_t n,
                                     std::vector<std::string>& notes) {
  std::vector<std::int64_t> result(n, 0);
  std::vector<DataArray> arrays = property_arrays<Tag>(mesh, notes);
  auto it = find_integers(arrays, kMeditReference);
  if (it == arrays.end()) {
    it = find_integers(arrays, kGmshPhysical);
    if (it != arrays.end()) {
      notes.push_back("property \"" + it->name + "\" was written as references");
    }
  }
  if (it != arrays.end()) {
    result = std::move(it->integers);
    arrays.erase(it);
  }
  for (const DataArray& array : arrays) {
    notes.push_back(left_out(array.name, "Medit has no place for it"));
  }
  return result;
}

// Versions below 4 have integers of 32 bits.
bool need_version_4(const std::vector<std::int64_t>& references) {
  using Limits = std::numeric_limits<std::int32_t>;
  return std::any_of(references.begin(), references.end(),
                     [](std::int64_t r) { return r < Limits::min() || r > Limits::max(); });
}

}  // namespace

bool is_medit(std::string_view text) {
  return lower_case(TextScanner(text, "").peek()) == "meshversionformatted";
}

MeshData read_medit(std::string_view text, const std::string& path) {
  return MeditReader(text, path).read();
}

void write_medit(const HexMesh& mesh, const WriteOptions& options, std::string& out,
                 std::vector<std::string>& notes) {
  const auto vertex_refs = references<VertexTag>(mesh, mesh.n_vertices(), notes);
  const auto cell_refs = references<CellTag>(mesh, mesh.n_cells(), notes);
  const bool is_wide = need_version_4(vertex_refs) || need_version_4(cell_refs);
  if (is_wide) {
    notes.push_back("there are references beyond 32 bits: the file has version 4 of Medit, not 2");
  }
  out += is_wide ? "MeshVersionFormatted 4\n" : "MeshVersionFormatted 2\n";
  out += "Dimension 3\nVertices\n" + std::to_string(mesh.n_vertices()) + '\n';
  int row = 0;
  for (VertexHandle v : mesh.vertices()) {
    for (double x : mesh.point(v)) {
      append_number(out, x, options.precision);
      out += ' ';
    }
    append_number(out, vertex_refs[row++]);
    out += '\n';
  }
  out += "Hexahedra\n" + std::to_string(mesh.n_cells()) + '\n';
  const std::vector<int> number = vertex_numbers(mesh);
  row = 0;
  for (CellHandle c : mesh.cells()) {
    for (VertexHandle v : mesh.vertices(c)) {
      append_number(out, number[v.idx] + 1);
      out += ' ';
    }
    append_number(out, cell_refs[row++]);
    out += '\n';
  }
  out += "End\n";
}

}  // namespace hexweft
