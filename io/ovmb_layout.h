/// \file
/// The numbers and words of an .ovmb file: a header of 48 bytes, then chunks, each with a header of 16
/// bytes and padded with zeros to a multiple of eight.
///
///     header  "OVMB\r\n.." | version, header version, dimension, topology | 0 (4) | four counts (8 each)
///     chunk   type (4) | version, padding, compression, mandatory | length with padding (8)
///     VERT    span | encoding (1), 0 (3) | coordinates
///     TOPO    span | entity, valence or 0, width of valences, width of indices | offset (8) |
///             valences if they vary | indices
///     DIRP    entity (1) | name | type | default, each with its length (4) in front; again and again
///     PROP    span | which of DIRP (4) | values
///     EOF     nothing
///
/// A span is the first element (8) and their number (4).
#pragma once

#include <string_view>

namespace hexweft::detail {

inline constexpr std::string_view kOvmbMagic = "OVMB\n\r\n\xFF";
inline constexpr std::size_t kOvmbHeader = 48, kOvmbChunkHeader = 16;
inline constexpr int kOvmbVersion = 1;
inline constexpr int kOvmbPolyhedral = 0, kOvmbTetrahedral = 1, kOvmbHexahedral = 2;
inline constexpr int kOvmbMandatory = 1;
inline constexpr int kOvmbFloat = 1, kOvmbDouble = 2;  // coordinates
inline constexpr std::string_view kOvmbVertices = "VERT", kOvmbTopology = "TOPO",
                                  kOvmbDirectory = "DIRP", kOvmbValues = "PROP", kOvmbEnd = "EOF ";

}  // namespace hexweft::detail
