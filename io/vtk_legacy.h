/// \file
/// Legacy VTK files (.vtk) of an UNSTRUCTURED_GRID, versions 1.0 to 5.1, text and binary.
///
/// Read: VTK_HEXAHEDRON and VTK_VOXEL cells (the latter renumbered), point data and cell data of
/// every numeric type (data_array.h says what they become). Left out, with a note: cells of lower
/// dimension, colour tables, field data of the whole file, arrays of strings. Other solid cells are
/// an error. Written: version 3.0, reals as double with the fewest digits that read back the same.
/// Source: "VTK File Formats", vtk.org; version 5.1 as VTK 9 writes it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/hex_mesh_io.h"
#include "io/mesh_data.h"

namespace hexweft {

/// \param text  the whole file
/// \param path  for messages
/// \throws FormatError "path:line: ..."; in a binary block the line is that of its header
MeshData read_vtk_legacy(std::string_view text, const std::string& path);

/// Appends the file to `out`. Live vertices and cells are numbered in order of their handles.
void write_vtk_legacy(const HexMesh& mesh, const WriteOptions& options, std::string& out,
                      std::vector<std::string>& notes);

/// True if the file starts as a legacy VTK file does.
bool is_vtk_legacy(std::string_view text);

}  // namespace hexweft
