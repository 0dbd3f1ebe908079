/// \file
/// The hash function FNV-1a of Fowler, Noll and Vo, 64 bits.
#pragma once

#include <cstdint>
#include <string_view>

namespace hexweft::detail {

class Fnv {
 public:
  /// Of a byte, as the function is defined; a larger number at a time is faster and as good for tables.
  void take(std::uint64_t unit) { hash_ = (hash_ ^ unit) * 1099511628211ull; }
  void take_bytes(std::uint64_t x) {
    for (int i = 0; i < 8; ++i, x >>= 8) take(x & 0xff);
  }
  void take_bytes(std::string_view text) {
    for (const char c : text) take(static_cast<unsigned char>(c));
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 14695981039346656037ull;
};

}  // namespace hexweft::detail
