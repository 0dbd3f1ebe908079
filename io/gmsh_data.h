/// \file
/// The values that a Gmsh file has on nodes or elements: $NodeData and $ElementData.
#pragma once

#include <string>
#include <vector>

#include "io/data_array.h"
#include "io/gmsh_tags.h"
#include "io/gmsh_values.h"

namespace hexweft::detail {

/// Reads the section and appends its array, with 0 where it has no value, which is noted.
/// \param tags      of the points or cells, sorted
/// \param rows      number of points or cells
/// \param of_nodes  each tag must then be known; elements may be other than hexahedra
void read_gmsh_data(GmshValues& in, const GmshTags& tags, std::size_t rows, bool of_nodes,
                    std::vector<DataArray>& arrays, std::vector<std::string>& notes);

}  // namespace hexweft::detail
