/// \file
/// Reads and writes hexahedral meshes. The formats are listed in formats.h.
///
///     HexMesh mesh = read_hex_mesh("in.vtk");
///     write_hex_mesh("out.mesh", mesh);
///
/// Named properties of vertices and cells travel with the mesh where the format has a place for
/// them (data_array.h). The value read back is the value written, to the last bit, unless a
/// precision is asked for.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ovm/errors.h"
#include "ovm/hex_mesh.h"

namespace hexweft {

struct ReadOptions {
  /// A name of formats.h; empty: by the extension, else (and for "-") by what the file starts with.
  std::string format = {};
  /// Points that no hexahedron uses. Left out by default: to a mesh they mean nothing, and they
  /// would look like inner vertices without edges.
  bool keep_isolated_vertices = false;
};

struct ReadReport {
  std::string format;  ///< a name of formats.h
  std::vector<std::string>
      notes;  ///< what the file has that the mesh does not, and what was changed
};

struct WriteOptions {
  std::string format = {};         ///< a name of formats.h; empty: by the extension, "vtk" for "-"
  bool binary = false;             ///< where the format knows both
  std::optional<int> precision{};  ///< [1, 17] significant digits in text; empty: as few as read
                                   ///< back the same
};

struct WriteReport {
  std::string format;
  std::vector<std::string> notes;  ///< properties for which the format has no place
};

/// \param path    "-" is standard input
/// \param report  filled if given
/// \throws FormatError if the file cannot be read or is not what it claims to be ("path:line: ...",
///         or "path: byte N: ..." where a file has no lines); InputError for an unknown format name
/// A mesh that is read need not be valid: check_topology() (ovm/topology_check.h) tells.
HexMesh read_hex_mesh(const std::filesystem::path& path, const ReadOptions& options = {},
                      ReadReport* report = nullptr);

/// As read_hex_mesh, from the content of a file. \param name  for messages
HexMesh read_hex_mesh_text(std::string_view text, const std::string& name,
                           const ReadOptions& options = {}, ReadReport* report = nullptr);

/// Writes to a file beside the target which then takes its place, so that the target is never half
/// written. Deleted elements are not written; the order is that of the handles.
/// \param path  "-" is standard output
/// \throws FormatError if the file cannot be written, which leaves an existing one as it was;
///         InputError for an unknown format, or options that it does not have
WriteReport write_hex_mesh(const std::filesystem::path& path, const HexMesh& mesh,
                           const WriteOptions& options = {});

/// Throws what write_hex_mesh would throw of what can be known before there is a mesh: an unknown
/// format, a folder that is not there. For programs that compute long before they write.
void check_hex_mesh_output(const std::filesystem::path& path, const WriteOptions& options = {});

/// As write_hex_mesh; `options.format` empty means "vtk".
std::string write_hex_mesh_text(const HexMesh& mesh, const WriteOptions& options = {},
                                WriteReport* report = nullptr);

}  // namespace hexweft
