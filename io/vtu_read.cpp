#include <algorithm>

#include "io/vtk_grid.h"
#include "io/vtu.h"
#include "io/vtu_pieces.h"
#include "io/vtu_values.h"

namespace hexweft {
namespace {

using namespace detail;

class VtuReader {
 public:
  VtuReader(std::string_view text, const std::string& path) : document_(text, path) {}

  MeshData read() {
    const pugi::xml_node grid = document_.grid();
    if (!grid.child("Piece")) document_.fail(grid, "expected an element <Piece>, found none");
    std::vector<MeshData> pieces;
    for (pugi::xml_node piece : grid.children("Piece")) pieces.push_back(read_piece(piece));
    MeshData data = join_pieces(std::move(pieces));
    if (data.cells.empty()) document_.fail(grid, "expected hexahedra, found none");
    note_cells_without_volume(n_cells_ - data.cells.size(), data.notes);
    if (grid.child("FieldData").first_child()) {
      data.notes.push_back("field data of the whole file were left out");
    }
    return data;
  }

 private:
  MeshData read_piece(pugi::xml_node piece);
  std::vector<Eigen::Vector3d> read_points(pugi::xml_node piece, std::size_t n);
  void read_cells(pugi::xml_node piece, std::size_t n, MeshData& data);
  void read_offsets(pugi::xml_node cells, std::size_t n, VtkCellList& list);
  VtuValues read_cell_array(pugi::xml_node cells, const char* name, std::size_t n);
  std::vector<DataArray> read_data(pugi::xml_node section, std::size_t rows,
                                   std::vector<std::string>& notes);
  DataArray read_data_array(pugi::xml_node element, const std::string& name, std::size_t rows);

  pugi::xml_node child(pugi::xml_node parent, const char* name) const {
    const pugi::xml_node found = parent.child(name);
    if (!found) {
      document_.fail(parent, std::string("expected an element <") + name + "> in <" +
                                 parent.name() + ">, found none");
    }
    return found;
  }
  VtkType type_of(pugi::xml_node array, const std::string& title) const {
    const char* name = array.attribute("type").value();
    const auto type = find_vtu_type(name);
    if (!type) document_.fail(array, title + ": expected a type of numbers, found " + quoted(name));
    return *type;
  }
  int components(pugi::xml_node array, int if_absent) const {
    constexpr const char* kAttribute = "NumberOfComponents";
    if (!array.attribute(kAttribute)) return if_absent;
    return static_cast<int>(document_.integer(array, kAttribute, 1, 1'000'000));
  }
  [[noreturn]] void fail_at(const VtuValues& values, std::size_t place,
                            const std::string& problem) const {
    fail_at_value(document_.scanner(), values.block, place, problem);
  }

  VtuDocument document_;
  std::int64_t n_points_ = 0, n_cells_ = 0;  // of the pieces so far, of all types
};

MeshData VtuReader::read_piece(pugi::xml_node piece) {
  const std::int64_t n_points =
      document_.integer(piece, "NumberOfPoints", 0, kMostPoints - n_points_);
  const std::int64_t n_cells = document_.integer(piece, "NumberOfCells", 0, kMostCells - n_cells_);
  n_points_ += n_points;
  n_cells_ += n_cells;
  MeshData data;
  if (n_points > 0) {
    data.points = read_points(piece, n_points);
    data.point_data = read_data(piece.child("PointData"), n_points, data.notes);
  }
  if (n_cells > 0) read_cells(piece, n_cells, data);
  return data;
}

std::vector<Eigen::Vector3d> VtuReader::read_points(pugi::xml_node piece, std::size_t n) {
  const pugi::xml_node element = child(child(piece, "Points"), "DataArray");
  const VtkType type = type_of(element, "Points");
  const int n_coordinates = components(element, 3);
  if (n_coordinates != 3 || type.kind == ValueKind::bit) {
    document_.fail(element, "Points: expected 3 coordinates a point, found " +
                                std::to_string(n_coordinates) + " of type " +
                                std::string(type.name));
  }
  const VtuValues values = read_vtu_values(document_, element, "Points", type, 3 * n);
  return points_of(values.array, [&](std::size_t place, const std::string& problem) {
    fail_at(values, place, problem);
  });
}

VtuValues VtuReader::read_cell_array(pugi::xml_node cells, const char* name, std::size_t n) {
  const pugi::xml_node element = cells.find_child_by_attribute("DataArray", "Name", name);
  if (!element) {
    document_.fail(cells,
                   std::string("expected a DataArray \"") + name + "\" in <Cells>, found none");
  }
  const VtkType type = type_of(element, name);
  if (type.kind != ValueKind::integer) {
    document_.fail(element,
                   std::string(name) + ": expected a type of integers, found " + quoted(type.name));
  }
  return read_vtu_values(document_, element, name, type, n);
}

// Where each cell's corners end.
void VtuReader::read_offsets(pugi::xml_node cells, std::size_t n, VtkCellList& list) {
  constexpr std::int64_t kMost = std::int64_t{1} << 40;  // bytes of so many numbers can be counted
  const VtuValues offsets = read_cell_array(cells, "offsets", n);
  for (std::size_t c = 0; c < n; ++c) {
    const std::int64_t offset = offsets.array.integers[c];
    const auto least = static_cast<std::int64_t>(list.first_corner.back());
    if (offset < least || offset > kMost) {
      fail_at(offsets, c,
              "expected an offset in [" + std::to_string(least) + ", " + std::to_string(kMost) +
                  "], found " + std::to_string(offset));
    }
    list.first_corner.push_back(offset);
  }
}

void VtuReader::read_cells(pugi::xml_node piece, std::size_t n, MeshData& data) {
  const pugi::xml_node cells = child(piece, "Cells");
  VtkCellList list;
  read_offsets(cells, n, list);
  VtuValues types = read_cell_array(cells, "types", n);
  list.types = std::move(types.array.integers);
  check_vtk_types(list,
                  [&](int cell, const std::string& problem) { fail_at(types, cell, problem); });
  VtuValues corners = read_cell_array(cells, "connectivity", list.first_corner.back());
  list.corners = std::move(corners.array.integers);
  const std::vector<int> hexahedra =
      pick_hexahedra(list, data, [&](int cell, const std::string& problem) {
        fail_at(corners, list.first_corner[cell], "cell " + std::to_string(cell) + " " + problem);
      });
  data.cell_data = read_data(piece.child("CellData"), n, data.notes);
  if (hexahedra.size() == n) return;
  for (DataArray& array : data.cell_data) keep_rows(array, hexahedra);
}

std::vector<DataArray> VtuReader::read_data(pugi::xml_node section, std::size_t rows,
                                            std::vector<std::string>& notes) {
  std::vector<DataArray> arrays;
  for (pugi::xml_node element : section.children()) {
    const std::string_view tag = element.name();
    if (tag != "DataArray" && tag != "Array") continue;
    const std::string name = element.attribute("Name").value();
    if (tag == "Array" || element.attribute("type").value() == std::string_view("String")) {
      notes.push_back("the array of strings \"" + name + "\" was left out");
    } else if (name.empty()) {
      notes.push_back("a data array without a name was left out");
    } else {
      add_array(arrays, read_data_array(element, name, rows), notes);
    }
  }
  return arrays;
}

DataArray VtuReader::read_data_array(pugi::xml_node element, const std::string& name,
                                     std::size_t rows) {
  const std::string title = "data array " + detail::quoted(name);
  const int n_components = components(element, 1);
  DataArray array =
      read_vtu_values(document_, element, title, type_of(element, title), rows * n_components)
          .array;
  array.name = name;
  array.components = n_components;
  const bool is_bit = array.kind == ValueKind::integer && element.attribute(kVtuBit).as_bool() &&
                      std::all_of(array.integers.begin(), array.integers.end(),
                                  [](auto x) { return x == 0 || x == 1; });
  if (is_bit) array.kind = ValueKind::bit;
  return array;
}

}  // namespace

bool is_vtu(std::string_view text) {
  constexpr std::size_t kFarEnough = 2000;  // for a declaration and a comment before the root
  std::string_view start = text.substr(0, kFarEnough);
  start.remove_prefix(std::min(start.find('<'), start.size()));
  const bool is_xml = start.starts_with("<?xml") || start.starts_with("<!--");
  return start.starts_with("<VTKFile") ||
         (is_xml && start.find("<VTKFile") != std::string_view::npos);
}

MeshData read_vtu(std::string_view text, const std::string& path) {
  return VtuReader(text, path).read();
}

}  // namespace hexweft
