#include "io/gmsh_elements.h"

#include <algorithm>
#include <array>

#include "io/gmsh.h"
#include "ovm/hex_numbering.h"

namespace hexweft::detail {
namespace {

constexpr std::int64_t kHexahedron = 5;

// Nodes of points, lines, triangles and quadrangles of orders 1 to 10, by type; 0: another type.
constexpr std::array<int, 67> kFlatNodes{
    0,  2,  3,  4,  0,   0,   0,  0,  3,  6,  9,  0,  0,  0,  0,  1,  8,  0,  0,  0,  9,  10, 12,
    15, 15, 21, 4,  5,   6,   0,  0,  0,  0,  0,  0,  0,  16, 25, 36, 12, 16, 20, 28, 36, 45, 55,
    66, 49, 64, 81, 100, 121, 18, 21, 24, 27, 30, 24, 28, 32, 36, 40, 7,  8,  9,  10, 11};

int flat_nodes(std::int64_t type) {
  return type >= 0 && type < std::ssize(kFlatNodes) ? kFlatNodes[type] : 0;
}

std::string type_name(std::int64_t type) {
  static const std::map<std::int64_t, const char*> names{{4, "a tetrahedron"},
                                                         {11, "a tetrahedron"},
                                                         {29, "a tetrahedron"},
                                                         {30, "a tetrahedron"},
                                                         {31, "a tetrahedron"},
                                                         {6, "a prism"},
                                                         {13, "a prism"},
                                                         {18, "a prism"},
                                                         {7, "a pyramid"},
                                                         {14, "a pyramid"},
                                                         {19, "a pyramid"},
                                                         {12, "a hexahedron of 27 nodes"},
                                                         {17, "a hexahedron of 20 nodes"},
                                                         {92, "a hexahedron of 64 nodes"},
                                                         {93, "a hexahedron of 125 nodes"}};
  const auto it = names.find(type);
  return (it == names.end() ? "one" : it->second) + (" of type " + std::to_string(type));
}

}  // namespace

void GmshElements::read_entities(GmshValues& in) {
  static constexpr const char* kCounts[] = {"the number of points", "the number of curves",
                                            "the number of surfaces", "the number of volumes"};
  in.begin_binary();
  std::array<std::int64_t, 4> counts;
  for (int d = 0; d < 4; ++d) counts[d] = in.read_size(kGmshSizes, kCounts[d]);
  for (int d = 0; d < 4; ++d) {
    for (std::int64_t i = 0; i < counts[d]; ++i) read_entity(in, d);
  }
  in.expect_end();
}

// Its tag, its box (of a point since version 4.1: its place), its physical groups, and what bounds
// it.
void GmshElements::read_entity(GmshValues& in, int dimension) {
  static constexpr const char* kNames[] = {"point", "curve", "surface", "volume"};
  const std::int64_t tag =
      in.read_int(kGmshInts, [&] { return std::string("the tag of a ") + kNames[dimension]; });
  const auto of_it = [&](const char* what) {
    return [&, what] {
      return std::string(what) + " of " + kNames[dimension] + " " + std::to_string(tag);
    };
  };
  const int n_box = dimension == 0 && in.version() == GmshVersion::v41 ? 3 : 6;
  for (int i = 0; i < n_box; ++i) in.read_real(of_it("the bounding box"));
  const std::int64_t n_groups = in.read_size(kGmshSizes, of_it("the number of physical groups"));
  for (std::int64_t i = 0; i < n_groups; ++i) {
    const std::int64_t group = in.read_int(kGmshInts, of_it("a physical group"));
    if (dimension == 3 && i == 0) physical_of_volume_[tag] = group;
  }
  if (dimension == 3 && n_groups > 1) ++n_volumes_in_several_groups_;
  if (dimension == 0) return;
  const std::int64_t n_bounds = in.read_size(kGmshSizes, of_it("the number of bounds"));
  for (std::int64_t i = 0; i < n_bounds; ++i) in.read_int(kGmshInts, of_it("a bound"));
}

void GmshElements::read(GmshValues& in) {
  if (in.version() == GmshVersion::v2) {
    const std::int64_t n = in.read_int({0, kMostCells}, [] {
      return "the number of elements in [0, " + std::to_string(kMostCells) + "]";
    });
    in.begin_binary();
    in.is_binary() ? read_binary_blocks(in, n) : read_text_rows(in, n);
  } else {
    in.begin_binary();
    read_entity_blocks(in);
  }
  in.expect_end();
  if (data_.cells.empty()) {
    in.fail(in.header(), "expected hexahedra (type 5) in $Elements, found none");
  }
  check(in);
  tags_.sort();
  add_notes_and_groups();
}

// Version 2, text: each element tells its type and how many groups follow.
void GmshElements::read_text_rows(GmshValues& in, std::int64_t n) {
  while (n_rows_ < n) {
    Row row;
    row.where = in.where();
    row.tag = in.read_int(kGmshTags, [&] {
      return "the tag, 1 or more, of element " + std::to_string(n_rows_ + 1) + " of " +
             std::to_string(n);
    });
    row.type =
        in.read_int(kGmshInts, [&] { return "the type of element " + std::to_string(row.tag); });
    const std::int64_t n_groups = in.read_int(
        kGmshCounts, [&] { return "the number of tags of element " + std::to_string(row.tag); });
    read_groups(in, row, n_groups);
    read_nodes(in, row);
  }
}

// Version 2, binary: blocks of elements of one type and one number of groups.
void GmshElements::read_binary_blocks(GmshValues& in, std::int64_t n) {
  while (n_rows_ < n) {
    Row row;
    row.where = in.where();
    row.type = in.read_int(kGmshInts, "the type of a block of elements");
    const std::int64_t n_in_block = in.read_int({0, n - n_rows_}, [&] {
      return "at most " + std::to_string(n - n_rows_) + " elements in a block";
    });
    const std::int64_t n_groups =
        in.read_int(kGmshCounts, "the number of tags of each element of a block");
    for (std::int64_t i = 0; i < n_in_block; ++i) {
      row.tag = in.read_int(kGmshTags, "the tag, 1 or more, of an element");
      read_groups(in, row, n_groups);
      read_nodes(in, row);
    }
  }
}

// The physical group, the volume, and others (parts of a partition) that mean nothing here.
void GmshElements::read_groups(GmshValues& in, Row& row, std::int64_t n_groups) {
  row.physical = row.geometrical = 0;
  for (std::int64_t i = 0; i < n_groups; ++i) {
    const std::int64_t group = in.read_int(
        kGmshInts, [&] { return "a tag (an integer) of element " + std::to_string(row.tag); });
    if (i == 0) row.physical = group;
    if (i == 1) row.geometrical = group;
  }
}

// From version 4 on: blocks of elements of one type and one volume, surface, curve or point.
void GmshElements::read_entity_blocks(GmshValues& in) {
  const std::int64_t n_blocks = in.read_size(kGmshSizes, "the number of blocks of elements");
  const std::int64_t n = in.read_size({0, kMostCells}, [] {
    return "the number of elements in [0, " + std::to_string(kMostCells) + "]";
  });
  if (in.version() == GmshVersion::v41) {
    in.read_size(kGmshSizes, "the least tag of an element");
    in.read_size(kGmshSizes, "the greatest tag of an element");
  }
  for (std::int64_t b = 0; b < n_blocks; ++b) {
    const GmshEntity entity = in.read_entity();
    Row row;
    row.type = in.read_int(kGmshInts, "the type of a block of elements");
    const std::int64_t n_in_block = in.read_size({0, n - n_rows_}, [&] {
      return "at most " + std::to_string(n - n_rows_) + " elements in a block";
    });
    row.geometrical = entity.tag;
    const auto it = physical_of_volume_.find(entity.tag);
    row.physical = entity.dimension == 3 && it != physical_of_volume_.end() ? it->second : 0;
    for (std::int64_t i = 0; i < n_in_block; ++i) {
      row.where = in.where();
      row.tag = in.read_tag(kGmshTags, "the tag, 1 or more, of an element");
      read_nodes(in, row);
    }
  }
  if (n_rows_ < n) {
    in.fail(in.header(), "$Elements: expected " + std::to_string(n) + " elements, found " +
                             std::to_string(n_rows_) + " in its blocks");
  }
}

void GmshElements::read_nodes(GmshValues& in, const Row& row) {
  const auto a_node = [&] { return "the tag of a node of element " + std::to_string(row.tag); };
  ++n_rows_;
  if (const int n = flat_nodes(row.type)) {
    for (int i = 0; i < n; ++i) in.read_tag(kGmshTags, a_node);
    ++n_without_volume_;
    return;
  }
  if (row.type != kHexahedron) {
    in.fail(row.where, "expected hexahedra of 8 nodes (type 5), found element " +
                           std::to_string(row.tag) + ", " + type_name(row.type));
  }
  std::array<int, 8> cell;
  for (int& corner : cell) {
    const std::int64_t node = in.read_tag(kGmshTags, a_node);
    corner = nodes_.find(node);
    if (corner < 0) {
      in.fail(row.where, "element " + std::to_string(row.tag) + " uses node " +
                             std::to_string(node) + ", which $Nodes does not have");
    }
  }
  add_hexahedron(cell, row);
}

void GmshElements::add_hexahedron(const std::array<int, 8>& cell, const Row& row) {
  // Version 2 knows one group an element; Gmsh lists the element again for each further group.
  const bool repeats = !data_.cells.empty() && data_.cells.back() == cell &&
                       geometrical_.back() == row.geometrical && physical_.back() != row.physical;
  if (repeats) {
    ++n_repeated_;
  } else {
    data_.cells.push_back(cell);
    physical_.push_back(row.physical);
    geometrical_.push_back(row.geometrical);
    where_.push_back(row.where);
  }
  tags_.add(row.tag, static_cast<int>(data_.cells.size()) - 1);
}

void GmshElements::check(const GmshValues& in) const {
  check_cells(
      data_, 0,
      [&](int cell, const std::string& problem) {
        in.fail(where_[cell], "element " + std::to_string(tags_.tag_of(cell)) + " " + problem);
      },
      [&](int vertex) { return "node " + std::to_string(nodes_.tag_of(vertex)); });
}

void GmshElements::add_notes_and_groups() {
  const auto note = [&](std::int64_t n, const char* what) {
    if (n > 0) data_.notes.push_back(std::to_string(n) + what);
  };
  note(n_without_volume_, " elements without volume (points, lines, faces) were left out");
  note(n_repeated_,
       " hexahedra listed again for another physical group were left out; the first group counts");
  note(n_volumes_in_several_groups_, " volumes are in several physical groups; the first counts");
  const auto add = [&](const char* name, std::vector<std::int64_t>& values) {
    if (std::all_of(values.begin(), values.end(), [](auto x) { return x == 0; })) return;
    DataArray array;
    array.name = name;
    array.kind = ValueKind::integer;
    array.integers = std::move(values);
    data_.cell_data.push_back(std::move(array));
  };
  add(kGmshPhysical, physical_);
  add(kGmshGeometrical, geometrical_);
}

}  // namespace hexweft::detail
