/// \file
/// Little-endian numbers in binary files.
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <string>

namespace hexweft::detail {

/// Of 1 to 8 bytes.
inline std::uint64_t load_little_endian(const char* p, int bytes) {
  std::uint64_t value = 0;
  for (int i = bytes - 1; i >= 0; --i) value = value << 8 | static_cast<unsigned char>(p[i]);
  return value;
}

/// The lowest `bytes` bytes of the value.
inline void append_little_endian(std::string& out, std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i, value >>= 8) out += static_cast<char>(value & 0xff);
}

inline void append_little_endian(std::string& out, double value) {
  append_little_endian(out, std::bit_cast<std::uint64_t>(value), 8);
}

}  // namespace hexweft::detail
