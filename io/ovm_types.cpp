#include "io/ovm_types.h"

#include <algorithm>
#include <array>
#include <limits>

#include "io/text_scanner.h"

namespace hexweft::detail {
namespace {

constexpr ValueKind kBit = ValueKind::bit, kInteger = ValueKind::integer, kReal = ValueKind::real;

// Of types alike in kind and components the first is the one to write.
constexpr std::array<OvmType, 29> kTypes{{{"bool", "b", kBit, 1, 0, false},
                                          {"int", "i32", kInteger, 1, 4, true},
                                          {"long", "i64", kInteger, 1, 8, true},
                                          {"uint", "u32", kInteger, 1, 4, false},
                                          {"ulong", "u64", kInteger, 1, 8, false},
                                          {"short", "i16", kInteger, 1, 2, true},
                                          {"", "u16", kInteger, 1, 2, false},
                                          {"", "i8", kInteger, 1, 1, true},
                                          {"", "u8", kInteger, 1, 1, false},
                                          {"double", "d", kReal, 1, 8, true},
                                          {"float", "f", kReal, 1, 4, true},
                                          {"vec2i", "2i32", kInteger, 2, 4, true},
                                          {"vec3i", "3i32", kInteger, 3, 4, true},
                                          {"vec4i", "4i32", kInteger, 4, 4, true},
                                          {"vec2ui", "2u32", kInteger, 2, 4, false},
                                          {"vec3ui", "3u32", kInteger, 3, 4, false},
                                          {"vec4ui", "4u32", kInteger, 4, 4, false},
                                          {"vec2d", "2d", kReal, 2, 8, true},
                                          {"vec3d", "3d", kReal, 3, 8, true},
                                          {"vec4d", "4d", kReal, 4, 8, true},
                                          {"vec2f", "2f", kReal, 2, 4, true},
                                          {"vec3f", "3f", kReal, 3, 4, true},
                                          {"vec4f", "4f", kReal, 4, 4, true},
                                          {"", "9d", kReal, 9, 8, true},
                                          {"", "9f", kReal, 9, 4, true},
                                          {"", "3x3d", kReal, 9, 8, true},
                                          {"", "3x3f", kReal, 9, 4, true},
                                          {"", "4x4d", kReal, 16, 8, true},
                                          {"", "4x4f", kReal, 16, 4, true}}};

struct EntityName {
  std::string_view word, plural;
};
constexpr std::array<EntityName, kOvmEntities> kEntities{{{"vprop", "vertices"},
                                                          {"eprop", "edges"},
                                                          {"fprop", "faces"},
                                                          {"cprop", "cells"},
                                                          {"heprop", "half-edges"},
                                                          {"hfprop", "half-faces"},
                                                          {"mprop", "the whole mesh"}}};

bool holds(const OvmType& type, const DataArray& array) {
  if (type.kind != array.kind || type.components != array.components) return false;
  if (array.kind != kInteger || type.bytes == 8) return true;
  return std::all_of(array.integers.begin(), array.integers.end(), [](std::int64_t x) {
    return x >= std::numeric_limits<std::int32_t>::min() &&
           x <= std::numeric_limits<std::int32_t>::max();
  });
}

// It stands in quotation marks at the end of a line, of which readers drop as many as there are.
bool fits_header(const std::string& name) {
  return name.find_first_of("\r\n") == std::string::npos && !name.ends_with('"');
}

}  // namespace

std::optional<OvmEntity> find_ovm_entity(std::string_view word) {
  const std::string lower = lower_case(word);
  for (int i = 0; i < kOvmEntities; ++i) {
    if (kEntities[i].word == lower) return OvmEntity(i);
  }
  return std::nullopt;
}

std::string left_out_note(OvmEntity of, std::string_view type, std::string_view name) {
  return "property \"" + std::string(name) + "\" of " + std::string(kEntities[int(of)].plural) +
         " (" + std::string(type) + ") was left out";
}

const OvmType* find_ovm_type(OvmFile file, std::string_view name) {
  if (name.empty()) return nullptr;
  const auto it = std::find_if(kTypes.begin(), kTypes.end(),
                               [&](const OvmType& type) { return type.name(file) == name; });
  return it == kTypes.end() ? nullptr : &*it;
}

template <class Tag>
std::vector<OvmProperty> ovm_properties(const HexMesh& mesh, OvmFile file,
                                        std::vector<std::string>& notes) {
  std::vector<OvmProperty> result;
  for (DataArray& array : property_arrays<Tag>(mesh, notes)) {
    const auto type = std::find_if(kTypes.begin(), kTypes.end(), [&](const OvmType& t) {
      return !t.name(file).empty() && holds(t, array);
    });
    const auto leave_out = [&](const char* why) { notes.push_back(left_out(array.name, why)); };
    if (type == kTypes.end()) {
      leave_out("OpenVolumeMesh files have no type for its rows");
    } else if (file == OvmFile::text && !fits_header(array.name)) {
      leave_out("its name does not fit into a line of the file");
    } else {
      result.push_back({std::move(array), &*type});
    }
  }
  return result;
}

template std::vector<OvmProperty> ovm_properties<VertexTag>(const HexMesh&, OvmFile,
                                                            std::vector<std::string>&);
template std::vector<OvmProperty> ovm_properties<CellTag>(const HexMesh&, OvmFile,
                                                          std::vector<std::string>&);

}  // namespace hexweft::detail
