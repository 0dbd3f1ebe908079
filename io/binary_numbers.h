/// \file
/// Numbers in binary files, of either byte order.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>

namespace hexweft::detail {

/// Of 1 to 8 bytes.
inline std::uint64_t load_unsigned(const char* p, int bytes,
                                   std::endian order = std::endian::little) {
  std::uint64_t value = 0;
  for (int i = 0; i < bytes; ++i) {
    value =
        value << 8 | static_cast<unsigned char>(p[order == std::endian::big ? i : bytes - 1 - i]);
  }
  return value;
}

inline std::int64_t load_signed(const char* p, int bytes, std::endian order = std::endian::little) {
  const int unused_bits = 64 - 8 * bytes;
  return static_cast<std::int64_t>(load_unsigned(p, bytes, order) << unused_bits) >> unused_bits;
}

/// Of 4 or 8 bytes.
inline double load_real(const char* p, int bytes, std::endian order = std::endian::little) {
  const std::uint64_t bits = load_unsigned(p, bytes, order);
  return bytes == 4 ? std::bit_cast<float>(static_cast<std::uint32_t>(bits))
                    : std::bit_cast<double>(bits);
}

/// The lowest `bytes` bytes of the value, the lowest first.
inline void append_little_endian(std::string& out, std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i, value >>= 8) out += static_cast<char>(value & 0xff);
}

/// All bytes of a number.
template <class T>
void append_bytes(std::string& out, T value, std::endian order) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  if (order != std::endian::native) std::reverse(bytes, bytes + sizeof(T));
  out.append(bytes, sizeof(T));
}

}  // namespace hexweft::detail
