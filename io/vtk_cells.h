/// \file
/// The cell lists of a legacy VTK file and the hexahedra among them.
#pragma once

#include <vector>

#include "io/mesh_data.h"
#include "io/vtk_grid.h"
#include "io/vtk_values.h"

namespace hexweft::detail {

class VtkCells {
 public:
  std::size_t size() const { return list_.size(); }  ///< cells of all types in the file
  /// Which cells of the file became the cells of the mesh, in order.
  const std::vector<int>& hexahedra() const { return hexahedra_; }

  /// Reads CELLS; the cursor is behind the keyword, which stands at `section`.
  void read_corners(TextScanner& in, bool binary, std::size_t section);
  /// Reads CELL_TYPES and appends the hexahedra to `data.cells`, whose points are there.
  void read_types(TextScanner& in, bool binary, std::size_t section, MeshData& data);

 private:
  void split_records(TextScanner& in, const std::vector<std::int64_t>& values,
                     std::int64_t n_cells);
  void read_offsets(TextScanner& in, std::int64_t n_offsets, std::int64_t n_corners);
  [[noreturn]] void fail_at_cell(const TextScanner& in, int cell, const std::string& problem) const;

  VtkBlock corner_block_;
  bool corners_have_counts_ = false;  // each cell's corners follow their number in the block
  VtkCellList list_;
  std::vector<int> hexahedra_;
};

}  // namespace hexweft::detail
