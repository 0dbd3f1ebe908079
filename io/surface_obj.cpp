#include <cmath>

#include "io/polygon_soup.h"
#include "io/text_scanner.h"

namespace hexweft::detail {
namespace {

/// Wavefront OBJ: of its lines those of points, `v`, and of faces, `f`; the rest is for other uses.
class ObjReader {
 public:
  ObjReader(std::string_view text, const std::string& path) : in_(text, path) {}

  PolygonSoup read() {
    while (!in_.at_end()) read_line();
    const auto n_points = static_cast<std::int64_t>(soup_.points.size());
    if (greatest_ > n_points) {
      in_.fail(greatest_at_, "expected the number of a point in [1, " + std::to_string(n_points) +
                                 "], found " + std::to_string(greatest_));
    }
    return std::move(soup_);
  }

 private:
  void read_line();
  void split(std::string_view line);
  void read_point();
  void read_face();

  TextScanner in_;
  PolygonSoup soup_;
  std::size_t line_ = 0;                 // where it starts
  std::string joined_;                   // a line that goes on in the next ones
  std::vector<std::string_view> words_;  // of the line
  std::int64_t greatest_ = 0;            // number of a point, and the line of it
  std::size_t greatest_at_ = 0;
};

// A backslash at its end lets a line go on in the next one.
void ObjReader::read_line() {
  line_ = in_.offset();
  std::string_view line = in_.rest_of_line();
  if (line.ends_with('\\')) {
    joined_.clear();
    for (; line.ends_with('\\'); line = in_.rest_of_line()) {
      line.remove_suffix(1);
      joined_.append(line).append(" ");
    }
    line = joined_.append(line);
  }
  split(line.substr(0, line.find('#')));
  if (words_.empty()) return;
  if (words_[0] == "v") read_point();
  if (words_[0] == "f") read_face();
}

void ObjReader::split(std::string_view line) {
  constexpr std::string_view kBlanks = " \t\r\v\f";
  words_.clear();
  for (std::size_t at = line.find_first_not_of(kBlanks); at != line.npos;
       at = line.find_first_not_of(kBlanks, at)) {
    const std::size_t end = std::min(line.find_first_of(kBlanks, at), line.size());
    words_.push_back(line.substr(at, end - at));
    at = end;
  }
}

// Weights and colours may follow.
void ObjReader::read_point() {
  Eigen::Vector3d p;
  for (int k = 0; k < 3; ++k) {
    const std::string_view word = words_.size() > std::size_t(k) + 1 ? words_[k + 1] : "";
    const char* end = word.data() + word.size();
    if (parse_number(word.data(), end, p[k]) != end || !std::isfinite(p[k])) {
      in_.fail(line_, "expected three finite coordinates of point " +
                          std::to_string(soup_.points.size() + 1) + ", found " +
                          (word.empty() ? "the end of the line" : quoted(word)));
    }
  }
  soup_.points.push_back(p);
}

// A corner is the number of a point, from 1, or back from the last point if negative; behind a slash
// there are those of other things.
void ObjReader::read_face() {
  if (words_.size() < 4) {
    in_.fail(line_,
             "expected a face of three points or more, found " + std::to_string(words_.size() - 1));
  }
  const auto n_points = static_cast<std::int64_t>(soup_.points.size());
  std::vector<int> face;
  for (std::size_t i = 1; i < words_.size(); ++i) {
    const std::string_view word = words_[i].substr(0, words_[i].find('/'));
    std::int64_t number = 0;
    const char* end = word.data() + word.size();
    if (parse_number(word.data(), end, number) != end || number == 0 || number < -n_points ||
        number > kMostOfSurface) {
      in_.fail(line_, "expected the number of a point of face " +
                          std::to_string(soup_.polygons.size() + 1) + ", found " +
                          quoted(words_[i]));
    }
    if (number > greatest_) {
      greatest_ = number;
      greatest_at_ = line_;
    }
    face.push_back(static_cast<int>(number > 0 ? number - 1 : n_points + number));
  }
  soup_.polygons.push_back(std::move(face));
}

}  // namespace

PolygonSoup read_obj(std::string_view text, const std::string& path) {
  return ObjReader(text, path).read();
}

}  // namespace hexweft::detail
