/// \file
/// Polylines as a legacy VTK file of POLYDATA, for ParaView.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "ovm/hex_mesh.h"

namespace hexweft::cli {

/// Lines along vertices of a mesh, with numbers on each.
struct Polylines {
  std::vector<std::vector<VertexHandle>> lines;
  std::vector<std::pair<std::string, std::vector<int>>> data;  ///< by name, one a line
};

/// The file's text; only vertices on lines are written. \pre every list of numbers is as long as
/// the list of lines
std::string polyline_vtk(const HexMesh& mesh, const Polylines& polylines);

}  // namespace hexweft::cli
