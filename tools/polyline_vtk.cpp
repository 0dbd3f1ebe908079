#include "tools/polyline_vtk.h"

#include <fmt/format.h>

namespace hexweft::cli {

std::string polyline_vtk(const HexMesh& mesh, const Polylines& polylines) {
  std::vector<int> number(mesh.vertex_slots(), -1);
  std::string points, lines;
  int n_points = 0;
  std::size_t n_numbers = 0;
  for (const auto& line : polylines.lines) {
    lines += std::to_string(line.size());
    for (const VertexHandle v : line) {
      if (number[v.idx] < 0) {
        number[v.idx] = n_points++;
        const Eigen::Vector3d& p = mesh.point(v);
        points += fmt::format("{} {} {}\n", p.x(), p.y(), p.z());
      }
      lines += fmt::format(" {}", number[v.idx]);
    }
    lines += '\n';
    n_numbers += line.size() + 1;
  }
  const std::size_t n = polylines.lines.size();
  std::string out = "# vtk DataFile Version 3.0\nlines of a hexahedral mesh\nASCII\n";
  out += fmt::format("DATASET POLYDATA\nPOINTS {} double\n{}LINES {} {}\n{}", n_points, points, n,
                     n_numbers, lines);
  if (n > 0) out += fmt::format("CELL_DATA {}\n", n);
  for (const auto& [name, values] : polylines.data) {
    if (n == 0) break;
    out += fmt::format("SCALARS {} int 1\nLOOKUP_TABLE default\n", name);
    for (const int x : values) out += fmt::format("{}\n", x);
  }
  return out;
}

}  // namespace hexweft::cli
