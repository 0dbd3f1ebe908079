#include "io/text_scanner.h"

#include <algorithm>
#include <cstdlib>

#include "ovm/errors.h"

namespace hexweft::detail {

std::string_view TextScanner::peek() {
  skip_blanks();
  return peek_raw();
}

std::string_view TextScanner::peek_raw() {
  while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
  std::size_t end = at_;
  while (end < text_.size() && !is_blank(text_[end])) ++end;
  return text_.substr(at_, end - at_);
}

std::string_view TextScanner::next() {
  const std::string_view word = peek();
  at_ += word.size();
  return word;
}

std::string_view TextScanner::next_raw() {
  const std::string_view word = peek_raw();
  at_ += word.size();
  return word;
}

std::string_view TextScanner::rest_of_line() {
  const std::size_t end = std::min(text_.find('\n', at_), text_.size());
  std::string_view line = text_.substr(at_, end - at_);
  at_ = std::min(end + 1, text_.size());
  while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
  while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
  return line;
}

std::int64_t TextScanner::read_count(const std::string& what, std::int64_t most) {
  const std::string range = what + " in [0, " + std::to_string(most) + "]";
  const std::size_t before = (peek(), at_);
  std::int64_t n;
  if (!read(n)) fail_expected(range);
  if (n < 0 || n > most) {
    at_ = before;
    fail_expected(range);
  }
  return n;
}

template <class T>
bool TextScanner::read_number(T& value) {
  skip_blanks();
  T number{};
  const char* stop = parse_number(text_.data() + at_, text_.data() + text_.size(), number);
  if (!stop || !ends_word(stop)) return false;
  value = number;
  at_ = stop - text_.data();
  return true;
}

bool TextScanner::read(std::int64_t& value) { return read_number(value); }
bool TextScanner::read(double& value) { return read_number(value); }

void TextScanner::fail(std::size_t offset, const std::string& message) const {
  const auto begin = text_.begin();
  const auto line = 1 + std::count(begin, begin + std::min(offset, text_.size()), '\n');
  throw FormatError(path_ + ":" + std::to_string(line) + ": " + message);
}

void TextScanner::fail_expected(const std::string& what) {
  const std::string_view found = peek();
  // The end is reported on the last line that has something on it.
  std::size_t where = at_;
  if (found.empty()) {
    while (where > 0 && is_blank(text_[where - 1])) --where;
  }
  fail(where,
       "expected " + what + ", found " + (found.empty() ? std::string(end_) : quoted(found)));
}

const char* parse_number(const char* begin, const char* end, std::int64_t& value) {
  if (begin != end && *begin == '+') ++begin;
  const auto [stop, error] = std::from_chars(begin, end, value);
  return error == std::errc() ? stop : nullptr;
}

const char* parse_number(const char* begin, const char* end, double& value) {
  if (begin != end && *begin == '+') ++begin;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error == std::errc::invalid_argument) return nullptr;
  if (error == std::errc::result_out_of_range) {
    // from_chars leaves the value alone here; strtod tells overflow from underflow.
    value = std::strtod(std::string(begin, stop).c_str(), nullptr);
  }
  return stop;
}

std::string lower_case(std::string_view word) {
  std::string result(word);
  for (char& c : result) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return result;
}

std::string quoted(std::string_view word) {
  constexpr std::size_t kLongest = 40;
  std::string result = "\"";
  for (char c : word.substr(0, kLongest)) result += c < ' ' || c > '~' ? '?' : c;
  result += word.size() > kLongest ? "...\"" : "\"";
  return result;
}

}  // namespace hexweft::detail
