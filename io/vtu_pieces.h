/// \file
/// The pieces of a .vtu file as one.
#pragma once

#include <vector>

#include "io/mesh_data.h"

namespace hexweft::detail {

/// Puts the points, cells and rows of data of all pieces behind each other. Points that several
/// pieces have are not joined: a file does not tell them from points that only lie in one place.
/// Data arrays that not every piece has, with the same kind and number of values, are left out with
/// a note; pieces without points or hexahedra need have none.
MeshData join_pieces(std::vector<MeshData> pieces);

}  // namespace hexweft::detail
