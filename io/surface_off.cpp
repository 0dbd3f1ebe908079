#include <algorithm>

#include "io/polygon_soup.h"
#include "io/text_scanner.h"

namespace hexweft::detail {
namespace {

/// Object file format, text: OFF, and with more numbers a point COFF, NOFF, STOFF.
class OffReader {
 public:
  OffReader(std::string_view text, const std::string& path) : in_(text, path) {}

  PolygonSoup read() {
    read_header();
    const std::int64_t n_points = in_.read_count("a number of points", kMostOfSurface),
                       n_faces = in_.read_count("a number of faces", kMostOfSurface);
    in_.rest_of_line();  // the number of edges
    for (std::int64_t i = 0; i < n_points; ++i) read_point(i, n_points);
    for (std::int64_t i = 0; i < n_faces; ++i) read_face(i, n_faces);
    if (!in_.at_end()) in_.fail_expected("the end of the file after " + of(n_faces, "faces"));
    return std::move(soup_);
  }

 private:
  static std::string of(std::int64_t n, const char* what) { return std::to_string(n) + " " + what; }

  void read_header() {
    const std::string word(in_.peek());
    if (word != "OFF" && word != "COFF" && word != "NOFF" && word != "CNOFF" && word != "STOFF") {
      in_.fail_expected("OFF");
    }
    in_.next();
    has_more_ = word != "OFF";
    if (in_.peek() == "BINARY") in_.fail_expected("a text file");
  }

  void read_point(std::int64_t i, std::int64_t n) {
    Eigen::Vector3d p;
    for (double& x : p) {
      x = in_.read_finite([&] {
        return "a finite coordinate of point " + std::to_string(i) + " of " + std::to_string(n);
      });
    }
    if (has_more_) in_.rest_of_line();
    soup_.points.push_back(p);
  }

  // A colour may follow.
  void read_face(std::int64_t i, std::int64_t n) {
    const std::string face = "face " + std::to_string(i) + " of " + std::to_string(n);
    const auto read = [&](std::int64_t least, std::int64_t most, const std::string& what) {
      const std::size_t before = (in_.peek(), in_.offset());
      std::int64_t value;
      if (!in_.read(value) || value < least || value > most) {
        in_.seek(before);
        in_.fail_expected(what + " in [" + std::to_string(least) + ", " + std::to_string(most) +
                          "] of " + face);
      }
      return static_cast<int>(value);
    };
    const auto n_points = static_cast<std::int64_t>(soup_.points.size());
    const int corners = read(3, std::max<std::int64_t>(n_points, 3), "a number of points");
    std::vector<int> polygon;
    for (int k = 0; k < corners; ++k) polygon.push_back(read(0, n_points - 1, "a point"));
    in_.rest_of_line();
    soup_.polygons.push_back(std::move(polygon));
  }

  TextScanner in_;
  PolygonSoup soup_;
  bool has_more_ = false;
};

}  // namespace

PolygonSoup read_off(std::string_view text, const std::string& path) {
  return OffReader(text, path).read();
}

}  // namespace hexweft::detail
