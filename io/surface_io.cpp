#include "io/surface_io.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "io/file.h"
#include "io/polygon_soup.h"
#include "io/text_scanner.h"
#include "ovm/errors.h"

namespace hexweft {
namespace {

using namespace detail;

constexpr std::array<std::string_view, 4> kExtensions{".obj", ".off", ".ply", ".stl"};
constexpr std::array kReaders{read_obj, read_off, read_ply, read_stl};  // in the same order

auto find_extension(const std::filesystem::path& path) {
  return std::find(kExtensions.begin(), kExtensions.end(), lower_case(path.extension().string()));
}

/// Points in the same place become the first of them: what is next to what goes by points, and some
/// writers give each polygon its own.
void join_equal_points(PolygonSoup& soup) {
  const auto& points = soup.points;
  const auto place = [&](int i) { return std::tie(points[i][0], points[i][1], points[i][2]); };
  std::vector<int> order(points.size()), first(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](int i, int j) { return place(i) < place(j) || (place(i) == place(j) && i < j); });
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool again = k > 0 && place(order[k]) == place(order[k - 1]);
    first[order[k]] = again ? first[order[k - 1]] : order[k];
  }
  std::vector<Eigen::Vector3d> kept;
  for (int i = 0; i < static_cast<int>(first.size()); ++i) {
    if (first[i] == i) kept.push_back(points[i]);
    first[i] = first[i] == i ? static_cast<int>(kept.size()) - 1 : first[first[i]];
  }
  soup.points = std::move(kept);
  for (std::vector<int>& polygon : soup.polygons) {
    for (int& v : polygon) v = first[v];
  }
}

std::vector<std::array<int, 3>> cut_into_triangles(const PolygonSoup& soup,
                                                   std::vector<std::string>& notes) {
  std::vector<std::array<int, 3>> triangles;
  int without_area = 0;
  for (const std::vector<int>& p : soup.polygons) {
    for (std::size_t i = 2; i < p.size(); ++i) {
      if (p[0] == p[i - 1] || p[i - 1] == p[i] || p[i] == p[0]) {
        ++without_area;
      } else {
        triangles.push_back({p[0], p[i - 1], p[i]});
      }
    }
  }
  if (without_area > 0) {
    notes.push_back(std::to_string(without_area) +
                    " triangles that use a point twice were left out");
  }
  return triangles;
}

/// The points that a triangle uses; the triangles are numbered anew.
Eigen::Matrix3Xd used_points(const std::vector<Eigen::Vector3d>& points, SurfaceMesh& surface) {
  std::vector<int> number(points.size(), -1);
  for (const auto& triangle : surface.triangles) {
    for (int v : triangle) number[v] = 0;
  }
  int n = 0;
  for (int& i : number) {
    if (i == 0) i = n++;
  }
  Eigen::Matrix3Xd used(3, n);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (number[i] >= 0) used.col(number[i]) = points[i];
  }
  for (auto& triangle : surface.triangles) {
    for (int& v : triangle) v = number[v];
  }
  if (const std::size_t unused = points.size() - n) {
    surface.notes.push_back(std::to_string(unused) + " points that no face uses were left out");
  }
  return used;
}

}  // namespace

bool is_surface_file(const std::filesystem::path& path) {
  return find_extension(path) != kExtensions.end();
}

SurfaceMesh read_surface_mesh_text(std::string_view text, const std::filesystem::path& name) {
  const auto extension = find_extension(name);
  if (extension == kExtensions.end()) {
    throw FormatError(name.string() + ": expected a surface: .obj, .off, .ply or .stl");
  }
  PolygonSoup soup = kReaders[extension - kExtensions.begin()](text, name.string());
  join_equal_points(soup);
  SurfaceMesh surface;
  surface.notes = std::move(soup.notes);
  surface.triangles = cut_into_triangles(soup, surface.notes);
  if (surface.triangles.empty()) {
    throw FormatError(name.string() + ": expected a surface, found no triangles");
  }
  surface.points = used_points(soup.points, surface);
  return surface;
}

SurfaceMesh read_surface_mesh(const std::filesystem::path& path) {
  return read_surface_mesh_text(read_file(path), path);
}

}  // namespace hexweft
