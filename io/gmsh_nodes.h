/// \file
/// The nodes of a Gmsh file: $Nodes, and $ParametricNodes of version 2.
#pragma once

#include <vector>

#include "io/gmsh_tags.h"
#include "io/gmsh_values.h"
#include "io/mesh_data.h"

namespace hexweft::detail {

class GmshNodes {
 public:
  explicit GmshNodes(MeshData& data) : data_(data) {}

  /// Appends the nodes to the points of the data, in the order of the file.
  /// \param parametric  whether each row of version 2 has parameters, which are left out; from
  ///                    version 4 on each block tells
  /// \throws FormatError also if two have the same tag
  void read(GmshValues& in, bool parametric);
  /// Tags of the points, sorted.
  const GmshTags& tags() const { return sorted_tags_; }

 private:
  void read_rows(GmshValues& in, std::int64_t n, bool parametric);
  void read_blocks(GmshValues& in);
  void read_block(GmshValues& in, std::int64_t n);
  void read_tag(GmshValues& in);
  void read_place(GmshValues& in);
  void skip_parameters(GmshValues& in, std::int64_t n);
  std::int64_t tag_of_place() const { return tags_[data_.points.size() - 1]; }

  MeshData& data_;
  GmshTags sorted_tags_;
  std::vector<std::int64_t> tags_;  // in the order of the file; places may come after several tags
  std::vector<std::size_t> where_;  // of each tag, for messages
};

}  // namespace hexweft::detail
