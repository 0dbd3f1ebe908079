/// \file
/// OpenVolumeMesh files, text (.ovm) and binary (.ovmb, version 1), of hexahedra.
///
/// Read: cells of six quadrilaterals, in any order of their half-faces; numbers on vertices and on
/// cells. Values of other elements, of the whole mesh, or that are no numbers are left out with a note,
/// and so are faces without a cell. Written: edges and faces in the order in which the cells meet them
/// (ovm_topology.h), coordinates and reals in double precision. Source: the file managers of
/// OpenVolumeMesh 3.4, https://www.graphics.rwth-aachen.de/software/openvolumemesh/.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/hex_mesh_io.h"
#include "io/mesh_data.h"

namespace hexweft {

/// As read_vtk_legacy, write_vtk_legacy, is_vtk_legacy (vtk_legacy.h).
MeshData read_ovm(std::string_view text, const std::string& path);
void write_ovm(const HexMesh& mesh, const WriteOptions& options, std::string& out,
               std::vector<std::string>& notes);
bool is_ovm(std::string_view text);

/// The same for binary files. Errors tell the byte instead of the line: "path: byte 48: ...".
MeshData read_ovmb(std::string_view bytes, const std::string& path);
void write_ovmb(const HexMesh& mesh, const WriteOptions& options, std::string& out,
                std::vector<std::string>& notes);
bool is_ovmb(std::string_view bytes);

}  // namespace hexweft
