/// \file
/// The types of property values in OpenVolumeMesh files, text and binary.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/data_array.h"

namespace hexweft::detail {

enum class OvmFile { text, binary };

/// What a property belongs to; binary files number them so.
enum class OvmEntity { vertex, edge, face, cell, half_edge, half_face, mesh };
inline constexpr int kOvmEntities = 7;

/// By the first word of a property in a text file, as VProp, in any case; empty if it is none.
std::optional<OvmEntity> find_ovm_entity(std::string_view word);

/// One that a DataArray can hold.
struct OvmType {
  std::string_view text_name, binary_name;  ///< empty where that kind of file has no such type
  ValueKind kind;
  int components;
  int bytes;  ///< of one number in a binary file; 0: bits, packed
  bool is_signed;
  std::string_view name(OvmFile file) const {
    return file == OvmFile::text ? text_name : binary_name;
  }
};

/// Null if there is none, or if it is one that no DataArray holds, as strings and handles are.
const OvmType* find_ovm_type(OvmFile file, std::string_view name);

/// A property and what a file has it as.
struct OvmProperty {
  DataArray array;
  const OvmType* type;
};

/// Those of the live vertices or cells that such a file can hold; the others are named in `notes`.
template <class Tag>
std::vector<OvmProperty> ovm_properties(const HexMesh& mesh, OvmFile file,
                                        std::vector<std::string>& notes);

/// That a property of a file was left out.
std::string left_out_note(OvmEntity of, std::string_view type, std::string_view name);

}  // namespace hexweft::detail
