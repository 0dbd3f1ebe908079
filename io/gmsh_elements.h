/// \file
/// The elements of a Gmsh file, the hexahedra among them, and the groups these belong to.
#pragma once

#include <map>
#include <vector>

#include "io/gmsh_tags.h"
#include "io/gmsh_values.h"
#include "io/mesh_data.h"

namespace hexweft::detail {

class GmshElements {
 public:
  /// \param nodes  tags of the points of `data`, sorted
  GmshElements(const GmshTags& nodes, MeshData& data) : nodes_(nodes), data_(data) {}

  /// Reads $Entities, which versions from 4 on have: the physical groups of the volumes.
  void read_entities(GmshValues& in);
  /// Reads $Elements: appends the hexahedra to the cells of the data and their groups to the cell
  /// data. \throws FormatError also if there are none
  void read(GmshValues& in);
  /// Tags of the hexahedra, sorted.
  const GmshTags& tags() const { return tags_; }

 private:
  struct Row {  // an element before its nodes are read
    std::size_t where = 0;
    std::int64_t type = 0, tag = 0, physical = 0, geometrical = 0;
  };
  void read_entity(GmshValues& in, int dimension);
  void read_text_rows(GmshValues& in, std::int64_t n);
  void read_binary_blocks(GmshValues& in, std::int64_t n);
  void read_entity_blocks(GmshValues& in);
  void read_groups(GmshValues& in, Row& row, std::int64_t n_groups);
  void read_nodes(GmshValues& in, const Row& row);
  void add_hexahedron(const std::array<int, 8>& cell, const Row& row);
  void check(const GmshValues& in) const;
  void add_notes_and_groups();

  const GmshTags& nodes_;
  MeshData& data_;
  GmshTags tags_;
  std::map<std::int64_t, std::int64_t> physical_of_volume_;
  std::vector<std::int64_t> physical_, geometrical_;  // of each cell
  std::vector<std::size_t> where_;                    // of each cell, for messages
  std::int64_t n_rows_ = 0;                           // elements of all types so far
  std::int64_t n_without_volume_ = 0, n_repeated_ = 0, n_volumes_in_several_groups_ = 0;
};

}  // namespace hexweft::detail
