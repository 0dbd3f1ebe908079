/// \file
/// VTK's XML files (.vtu) of an UnstructuredGrid, versions 0.1 to 2.x.
///
/// Read: all number types, byte orders and encodings, with zlib compression or none; the points and
/// cells of several pieces one after the other. Cells and data become what those of a legacy VTK
/// file become (vtk_legacy.h). Left out, with a note: cells of lower dimension, field data, arrays
/// of strings, arrays that not every piece has. Other compressions and other solid cells are an
/// error. Written: version 1.0, one piece, without compression; binary data as base64 within the
/// elements, which every reader takes.
///
/// Few readers know VTK's packed bits (type Bit), so properties of bool are written as UInt8, with
/// an attribute that tells them from integers: Bit="1". Readers that do not know it find 0 and 1.
/// Source: "VTK XML Formats", docs.vtk.org.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/hex_mesh_io.h"
#include "io/mesh_data.h"

namespace hexweft {

/// As read_vtk_legacy, write_vtk_legacy, is_vtk_legacy (vtk_legacy.h).
MeshData read_vtu(std::string_view text, const std::string& path);
void write_vtu(const HexMesh& mesh, const WriteOptions& options, std::string& out,
               std::vector<std::string>& notes);
/// True for every type of VTK's XML files, so that reading can say which it is.
bool is_vtu(std::string_view text);

}  // namespace hexweft
