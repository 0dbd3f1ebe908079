/// \file
/// Bytes as base64 text. Source: RFC 4648, §4.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace hexweft::detail {

/// Appends the text of the bytes, padded to whole groups of four characters.
void append_base64(std::string& out, std::string_view bytes);

/// Reads the bytes of a text bit by bit. Blanks are skipped. Padding may stand anywhere: files put
/// the texts of several pieces of data behind each other.
class Base64Reader {
 public:
  explicit Base64Reader(std::string_view text) : text_(text) {}

  /// Appends `n` bytes; false if there are fewer to the end or to what is no base64 (rest()), after
  /// which `out` holds what there was.
  bool read(std::size_t n, std::string& out);

  /// The text behind the last whole group that was read.
  std::string_view rest() const { return text_.substr(at_); }

 private:
  bool read_group();

  std::string_view text_;
  std::size_t at_ = 0;
  char bytes_[3] = {};  // of the last group; those from used_ on have not been taken
  std::size_t n_bytes_ = 0, used_ = 0;
};

}  // namespace hexweft::detail
