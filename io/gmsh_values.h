/// \file
/// The sections of a Gmsh file and the numbers in them, as text or as binary of either byte order.
#pragma once

#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "io/text_scanner.h"

namespace hexweft::detail {

enum class GmshVersion { v2, v40, v41 };

struct GmshLayout {
  GmshVersion version = GmshVersion::v2;
  bool is_binary = false;
  std::endian byte_order = std::endian::little;
};

/// What stands between "$Name" and "$EndName".
struct GmshSection {
  std::string name;        ///< without the "$"
  std::size_t header = 0;  ///< where "$Name" starts
  std::size_t begin = 0, end = 0;
  bool is_closed = true;  ///< false: "$EndName" is missing, and all the rest is this section
};

/// \throws FormatError if there is anything but blanks between two sections
std::vector<GmshSection> split_gmsh_sections(TextScanner in);

struct GmshRange {
  std::int64_t least, most;
};
inline constexpr GmshRange kGmshInts{std::numeric_limits<int>::min(),
                                     std::numeric_limits<int>::max()};
inline constexpr GmshRange kGmshCounts{0, std::numeric_limits<int>::max()};
inline constexpr GmshRange kGmshSizes{0, std::numeric_limits<std::int64_t>::max()};
inline constexpr GmshRange kGmshTags{1, std::numeric_limits<std::int64_t>::max()};

/// The point, curve, surface or volume that a block of nodes or elements belongs to.
struct GmshEntity {
  std::int64_t dimension, tag;
};

/// Reads the numbers of one section in turn. `what` names the number in messages: a text, or a
/// function that gives one. In binary a message names the line of the section's header.
class GmshValues {
 public:
  GmshValues(const TextScanner& file, const GmshSection& section, GmshLayout layout)
      : in_(file), section_(section), layout_(layout) {
    in_.seek(section.begin);
  }

  GmshVersion version() const { return layout_.version; }
  bool is_binary() const { return binary_; }
  /// Sections start as text in every file; in a binary one, binary numbers start on the next line.
  void begin_binary() {
    if (!layout_.is_binary) return;
    in_.rest_of_line();
    binary_ = true;
  }
  std::string_view rest_of_line() { return in_.rest_of_line(); }

  /// An integer of the range, in binary of 4 bytes.
  template <class What>
  std::int64_t read_int(GmshRange range, const What& what) {
    return read_integer(4, range, what);
  }
  /// As read_int, in binary of 8 bytes.
  template <class What>
  std::int64_t read_size(GmshRange range, const What& what) {
    return read_integer(8, range, what);
  }
  /// As read_int, in binary of 8 bytes from version 4.1 on.
  template <class What>
  std::int64_t read_tag(GmshRange range, const What& what) {
    return read_integer(layout_.version == GmshVersion::v41 ? 8 : 4, range, what);
  }
  GmshEntity read_entity();
  template <class What>
  double read_real(const What& what) {
    double value = 0;
    if (!load(value)) fail_expected(text_of(what));
    return value;
  }
  template <class What>
  double read_finite(const What& what) {
    const std::size_t before = in_.offset();
    const double value = read_real(what);
    if (!std::isfinite(value)) fail_found(before, text_of(what), std::to_string(value));
    return value;
  }

  std::size_t room_for(std::int64_t n, int numbers) const { return in_.room_for(n, numbers); }
  /// Where the next number is, for fail().
  std::size_t where() { return binary_ ? section_.header : (in_.at_end(), in_.offset()); }
  std::size_t header() const { return section_.header; }
  [[noreturn]] void fail(std::size_t where, const std::string& message) const {
    in_.fail(where, message);
  }
  /// \throws FormatError if the section goes on
  void expect_end();

 private:
  template <class What>
  std::int64_t read_integer(int bytes, GmshRange range, const What& what) {
    const std::size_t before = in_.offset();
    std::int64_t value = 0;
    if (!load(value, bytes)) fail_expected(text_of(what));
    if (value < range.least || value > range.most) {
      fail_found(before, text_of(what), std::to_string(value));
    }
    return value;
  }
  template <class What>
  static std::string text_of(const What& what) {
    if constexpr (std::is_invocable_v<What>) {
      return what();
    } else {
      return what;
    }
  }
  bool load(std::int64_t& value, int n_bytes);
  bool load(double& value);
  const char* take_bytes(std::size_t n);  // null if the section has fewer
  [[noreturn]] void fail_expected(const std::string& what);
  [[noreturn]] void fail_found(std::size_t before, const std::string& what,
                               const std::string& found);

  TextScanner in_;
  const GmshSection& section_;
  GmshLayout layout_;
  bool binary_ = false;
};

}  // namespace hexweft::detail
