/// \file
/// Numbers as text, and the numbers of the vertices in a file.
#pragma once

#include <charconv>
#include <concepts>
#include <optional>
#include <string>
#include <vector>

#include "ovm/hex_mesh.h"

namespace hexweft::detail {

/// Appends the shortest text that reads back as the same double, or one of `precision` significant
/// digits.
inline void append_number(std::string& out, double value, std::optional<int> precision = {}) {
  char text[40];
  const auto [end, error] = precision ? std::to_chars(text, text + sizeof(text), value,
                                                      std::chars_format::general, *precision)
                                      : std::to_chars(text, text + sizeof(text), value);
  out.append(text, static_cast<std::size_t>(end - text));
}

template <std::integral T>
void append_number(std::string& out, T value, std::optional<int> = {}) {
  char text[24];
  const char* end = std::to_chars(text, text + sizeof(text), value).ptr;
  out.append(text, static_cast<std::size_t>(end - text));
}

/// Where each vertex comes among the live ones, by slot; -1 for deleted ones.
inline std::vector<int> vertex_numbers(const HexMesh& mesh) {
  std::vector<int> numbers(mesh.vertex_slots(), -1);
  int n = 0;
  for (VertexHandle v : mesh.vertices()) numbers[v.idx] = n++;
  return numbers;
}

}  // namespace hexweft::detail
