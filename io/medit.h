/// \file
/// Medit text files (.mesh) of dimension 3, versions 1 to 4.
///
/// Read: Vertices and Hexahedra; their references become the named int property "medit:ref" of
/// vertices and of cells where any is not 0. Other solid cells are an error; every other section, a
/// word and the numbers up to the next one, is left out with a note. Written: the same two sections,
/// version 2, or 4 where references need more than 32 bits; without "medit:ref" the references are
/// those of "gmsh:physical" (gmsh.h).
/// Source: P. Frey, "MEDIT: an interactive mesh visualization software", INRIA RT-0253.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/hex_mesh_io.h"
#include "io/mesh_data.h"

namespace hexweft {

inline constexpr const char* kMeditReference = "medit:ref";

/// As read_vtk_legacy, write_vtk_legacy, is_vtk_legacy (vtk_legacy.h).
MeshData read_medit(std::string_view text, const std::string& path);
void write_medit(const HexMesh& mesh, const WriteOptions& options, std::string& out,
                 std::vector<std::string>& notes);
bool is_medit(std::string_view text);

}  // namespace hexweft
