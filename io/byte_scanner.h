/// \file
/// Reads little-endian numbers of a binary file held in memory, and says where it went wrong.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "io/binary_numbers.h"
#include "ovm/errors.h"

namespace hexweft::detail {

/// A cursor over the bytes of a file, or of a part of it. All throw FormatError "path: byte N: ...".
class ByteScanner {
 public:
  ByteScanner(std::string_view bytes, std::string path)
      : bytes_(bytes), path_(std::move(path)), end_(bytes.size()) {}

  std::size_t offset() const { return at_; }
  std::size_t remaining() const { return end_ - at_; }
  /// Up to here can be read: the next `n` bytes, or with unset_end() all there are.
  /// \pre there are so many
  void set_end(std::size_t n) { end_ = at_ + n; }
  void unset_end() { end_ = bytes_.size(); }

  std::string_view peek(std::size_t n, const std::string& what) {
    const std::string_view bytes = take(n, what);
    at_ -= n;
    return bytes;
  }
  std::string_view take(std::size_t n, const std::string& what) {
    if (n > remaining()) {
      fail(at_, "expected " + what + " (" + std::to_string(n) + " bytes), found " +
                    std::to_string(remaining()) + " bytes");
    }
    at_ += n;
    return bytes_.substr(at_ - n, n);
  }
  /// A number of 1 to 8 bytes, in [least, most].
  std::uint64_t number(int bytes, const std::string& what, std::uint64_t least = 0,
                       std::uint64_t most = UINT64_MAX) {
    const std::uint64_t value = load_unsigned(take(bytes, what).data(), bytes);
    if (value < least || value > most) {
      fail(at_ - bytes, "expected " + what +
                            (least == most ? " " + std::to_string(least)
                                           : " in [" + std::to_string(least) + ", " +
                                                 std::to_string(most) + "]") +
                            ", found " + std::to_string(value));
    }
    return value;
  }
  void zeros(std::size_t n, const std::string& what) {
    for (std::size_t i = 0; i < n; ++i) number(1, what, 0, 0);
  }
  [[noreturn]] void fail(std::size_t offset, const std::string& problem) const {
    throw FormatError(path_ + ": byte " + std::to_string(offset) + ": " + problem);
  }

 private:
  std::string_view bytes_;
  std::string path_;
  std::size_t at_ = 0, end_;
};

}  // namespace hexweft::detail
