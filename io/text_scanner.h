/// \file
/// Reads blank-separated words and numbers of a text held in memory, and says where it went wrong.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace hexweft::detail {

/// A cursor over the text of a file. `#` at the start of a word begins a comment that runs to the
/// end of its line. Lines are counted only when an error is reported.
class TextScanner {
 public:
  /// \param end  what the end of the text is, for messages
  TextScanner(std::string_view text, std::string path, const char* end = "the end of the file")
      : text_(text), path_(std::move(path)), end_(end) {}

  std::size_t offset() const { return at_; }
  void seek(std::size_t offset) { at_ = offset; }
  std::size_t remaining() const { return text_.size() - at_; }
  std::string_view text() const { return text_; }

  /// True when only blanks and comments are left, which are skipped.
  bool at_end() {
    skip_blanks();
    return at_ == text_.size();
  }
  std::string_view peek();  ///< the next word without moving past it; empty at the end
  std::string_view next();  ///< the next word; empty at the end
  /// As peek() and next(), but a word may start with `#`.
  std::string_view peek_raw();
  std::string_view next_raw();
  /// What is left of the line, without its blanks at either end; the cursor moves to the next line.
  std::string_view rest_of_line();

  /// Reads a number. False, without moving past it, when the next word is none or does not fit.
  /// Reals too large for a double become infinite, too small ones zero.
  bool read(std::int64_t& value);
  bool read(double& value);

  /// An integer from 0 to `most`. \throws FormatError "expected <what> in [0, <most>], found ..."
  std::int64_t read_count(const std::string& what, std::int64_t most);
  /// A number that is neither infinite nor none. \param what  gives its name for the message
  template <class What>
  double read_finite(const What& what) {
    skip_blanks();
    const std::size_t before = at_;
    double value;
    if (!read(value) || !std::isfinite(value)) {
      at_ = before;
      fail_expected(what());
    }
    return value;
  }
  /// How many rows of so many numbers to make room for, if there are to be n: a lying count must not
  /// cost memory.
  std::size_t room_for(std::int64_t n, int numbers) const {
    return std::min<std::size_t>(n, remaining() / (2 * numbers) + 1);
  }

  /// \throws FormatError "path:line: message", the line being that of the offset
  [[noreturn]] void fail(std::size_t offset, const std::string& message) const;
  /// \throws FormatError "path:line: expected <what>, found <the next word>"
  [[noreturn]] void fail_expected(const std::string& what);

 private:
  static bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
  void skip_blanks() {
    for (; at_ < text_.size(); ++at_) {
      if (is_blank(text_[at_])) continue;
      if (text_[at_] != '#') return;
      at_ = std::min(text_.find('\n', at_), text_.size() - 1);
    }
  }
  template <class T>
  bool read_number(T& value);
  bool ends_word(const char* p) const { return p == text_.data() + text_.size() || is_blank(*p); }

  std::string_view text_;
  std::string path_;
  const char* end_;
  std::size_t at_ = 0;
};

/// Reads the number that [begin, end) starts with, as TextScanner::read. \return  where it ends, or
/// null, which leaves the value alone
const char* parse_number(const char* begin, const char* end, std::int64_t& value);
const char* parse_number(const char* begin, const char* end, double& value);

/// A copy in lower case (ASCII letters only).
std::string lower_case(std::string_view word);

/// A word of a file as it may stand in a message: quoted, cut at 40 characters, printable.
std::string quoted(std::string_view word);

}  // namespace hexweft::detail
