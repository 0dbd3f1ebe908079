#include "io/byte_scanner.h"
#include "io/polygon_soup.h"
#include "io/text_scanner.h"

namespace hexweft::detail {
namespace {

constexpr std::size_t kHeader = 84, kTriangle = 50;  // bytes of a binary file

/// Triangles come with the coordinates of their corners, so that each has points of its own.
int add_point(const Eigen::Vector3d& p, PolygonSoup& soup) {
  soup.points.push_back(p);
  return static_cast<int>(soup.points.size()) - 1;
}

/// \pre the size of the file is that of so many triangles
PolygonSoup read_binary(std::string_view bytes, const std::string& path) {
  PolygonSoup soup;
  ByteScanner in(bytes, path);
  in.take(kHeader, "a header");
  const std::size_t n = in.remaining() / kTriangle;
  for (std::size_t i = 0; i < n; ++i) {
    in.take(12, "a normal");
    std::vector<int> triangle;
    for (int k = 0; k < 3; ++k) {
      const std::size_t at = in.offset();
      const char* numbers = in.take(12, "a point").data();
      const Eigen::Vector3d p(load_real(numbers, 4), load_real(numbers + 4, 4),
                              load_real(numbers + 8, 4));
      if (!p.allFinite()) {
        in.fail(at, "expected finite coordinates of triangle " + std::to_string(i) +
                        ", found another value");
      }
      triangle.push_back(add_point(p, soup));
    }
    soup.polygons.push_back(std::move(triangle));
    in.take(2, "an attribute");
  }
  return soup;
}

class StlTextReader {
 public:
  StlTextReader(std::string_view text, const std::string& path) : in_(text, path) {}

  PolygonSoup read() {
    do {
      expect("solid");
      in_.rest_of_line();  // its name
      while (lower_case(in_.peek()) != "endsolid") read_triangle();
      in_.rest_of_line();
    } while (!in_.at_end());
    return std::move(soup_);
  }

 private:
  void expect(const char* word) {
    if (lower_case(in_.peek()) != word) in_.fail_expected(word);
    in_.next();
  }
  void read_triangle() {
    expect("facet");
    expect("normal");
    for (int k = 0; k < 3; ++k) in_.next();  // which may be no numbers
    expect("outer");
    expect("loop");
    std::vector<int> triangle;
    for (int k = 0; k < 3; ++k) {
      expect("vertex");
      triangle.push_back(add_point(read_point(), soup_));
    }
    expect("endloop");
    expect("endfacet");
    soup_.polygons.push_back(std::move(triangle));
  }
  Eigen::Vector3d read_point() {
    Eigen::Vector3d p;
    for (double& x : p) {
      x = in_.read_finite([&] {
        return "a finite coordinate of triangle " + std::to_string(soup_.polygons.size());
      });
    }
    return p;
  }

  TextScanner in_;
  PolygonSoup soup_;
};

}  // namespace

// The header of a binary file may begin like a text; but the number of triangles at its end, if it is
// below 2^24, has a byte that no text has.
PolygonSoup read_stl(std::string_view text, const std::string& path) {
  if (text.size() < kHeader) return StlTextReader(text, path).read();
  const std::string_view count = text.substr(kHeader - 4, 4);
  const std::size_t n = load_unsigned(count.data(), 4), size = kHeader + kTriangle * n;
  if (text.size() == size) return read_binary(text, path);
  if (count.find('\0') == count.npos) return StlTextReader(text, path).read();
  throw FormatError(path + ": expected " + std::to_string(size) + " bytes of " + std::to_string(n) +
                    " triangles, found " + std::to_string(text.size()) + " bytes");
}

}  // namespace hexweft::detail
