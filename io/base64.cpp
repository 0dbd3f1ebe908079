#include "io/base64.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace hexweft::detail {
namespace {

constexpr std::string_view kDigits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr int kNone = -1, kBlank = -2, kPadding = -3;

constexpr std::array<int, 256> kValues = [] {
  std::array<int, 256> values{};
  values.fill(kNone);
  for (std::size_t i = 0; i < kDigits.size(); ++i) {
    values[static_cast<unsigned char>(kDigits[i])] = static_cast<int>(i);
  }
  for (char blank : {' ', '\t', '\n', '\r'}) values[static_cast<unsigned char>(blank)] = kBlank;
  values['='] = kPadding;
  return values;
}();

}  // namespace

void append_base64(std::string& out, std::string_view bytes) {
  out.reserve(out.size() + (bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t n = std::min<std::size_t>(bytes.size() - i, 3);
    std::uint32_t bits = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      bits = bits << 8 | (j < n ? static_cast<unsigned char>(bytes[i + j]) : 0);
    }
    for (std::size_t j = 0; j < 4; ++j) {
      out += j <= n ? kDigits[bits >> (18 - 6 * j) & 63] : '=';
    }
  }
}

bool Base64Reader::read(std::size_t n, std::string& out) {
  out.reserve(out.size() + std::min(n, text_.size() - at_));  // a lying n must not cost memory
  while (n > 0) {
    if (used_ == n_bytes_ && !read_group()) return false;
    const std::size_t some = std::min(n, n_bytes_ - used_);
    out.append(bytes_ + used_, some);
    used_ += some;
    n -= some;
  }
  return true;
}

bool Base64Reader::read_group() {
  std::uint32_t bits = 0;
  int n_digits = 0, n_padding = 0;
  std::size_t at = at_;
  for (; at < text_.size() && n_digits + n_padding < 4; ++at) {
    const int value = kValues[static_cast<unsigned char>(text_[at])];
    if (value == kBlank) continue;
    const bool fits = value == kPadding ? n_digits >= 2 : value != kNone && n_padding == 0;
    if (!fits) return false;
    bits = bits << 6 | static_cast<std::uint32_t>(std::max(value, 0));
    ++(value == kPadding ? n_padding : n_digits);
  }
  if (n_digits + n_padding < 4) return false;
  for (int i = 0; i < 3; ++i) bytes_[i] = static_cast<char>(bits >> (16 - 8 * i));
  n_bytes_ = 3 - n_padding;
  used_ = 0;
  at_ = at;
  return true;
}

}  // namespace hexweft::detail
