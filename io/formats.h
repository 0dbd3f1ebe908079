/// \file
/// The one table of mesh formats. A new format is one file and one row.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/hex_mesh_io.h"
#include "io/mesh_data.h"

namespace hexweft {

struct Format {
  std::string_view name;         ///< as in ReadOptions::format
  std::string_view extension;    ///< with its dot, lower case
  std::string_view description;  ///< one line for --help
  bool has_binary;               ///< whether WriteOptions::binary may be set, or always is
  bool (*starts_like)(std::string_view text);
  MeshData (*read)(std::string_view text, const std::string& path);
  void (*write)(const HexMesh& mesh, const WriteOptions& options, std::string& out,
                std::vector<std::string>& notes);
};

std::span<const Format> formats();

/// \throws InputError naming the formats there are
const Format& format_named(std::string_view name);

/// The format of the path's extension; null if there is none.
const Format* format_of_extension(const std::filesystem::path& path);

}  // namespace hexweft
