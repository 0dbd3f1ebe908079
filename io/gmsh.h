/// \file
/// Gmsh files (.msh) of versions 2.0 to 2.2, 4.0 and 4.1, text and binary of either byte order.
///
/// Read: nodes under any tags, hexahedra of 8 nodes, $NodeData and $ElementData of 1, 3 or 9
/// components (0 where the file has no value). The tags of a hexahedron's physical group and volume
/// become the named int properties "gmsh:physical" and "gmsh:geometrical" of cells where any is not
/// 0. Left out, with a note: points, lines and faces, names of groups, every other section. Other
/// solid elements are an error. Written: version 2.2, which more programs read than 4.1, and which
/// keeps the order of the cells and the tags of each without volumes made up for them.
/// Source: C. Geuzaine, J.-F. Remacle, "Gmsh Reference Manual", "MSH file format".
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/hex_mesh_io.h"
#include "io/mesh_data.h"

namespace hexweft {

inline constexpr const char* kGmshPhysical = "gmsh:physical";
inline constexpr const char* kGmshGeometrical = "gmsh:geometrical";

/// As read_vtk_legacy, is_vtk_legacy (vtk_legacy.h).
MeshData read_gmsh(std::string_view text, const std::string& path);
bool is_gmsh(std::string_view text);

/// As write_vtk_legacy. Nodes and elements are numbered from 1 in order of their handles. Data of
/// Gmsh are reals: integers and bits are written as such, with a note. Without "gmsh:physical" the
/// references of Medit are the physical groups. Without "gmsh:geometrical" each physical group is a
/// volume of its own, for Gmsh puts whole volumes into groups.
void write_gmsh(const HexMesh& mesh, const WriteOptions& options, std::string& out,
                std::vector<std::string>& notes);

}  // namespace hexweft
