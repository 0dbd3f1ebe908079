#include "ovm/quality.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace hexweft {
namespace {

using Eigen::Vector3d;

double determinant(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  return a.dot(b.cross(c));
}

double normalized_determinant(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const double lengths = a.norm() * b.norm() * c.norm();
  return lengths > 0 ? determinant(a, b, c) / lengths : -1.0;
}

// Edge vectors at the centre, four times the mean over the parallel edges.
Vector3d principal_axis(const HexPoints& p, int axis) {
  Vector3d sum = Vector3d::Zero();
  for (int k = 4 * axis; k < 4 * axis + 4; ++k)
    sum += p[kEdgeCorners[k][1]] - p[kEdgeCorners[k][0]];
  return sum;
}

double volume_deviation(const HexMesh& mesh, const std::vector<double>& volumes, CellHandle c) {
  double sum = 0;
  int n = 0;
  for (HalfFaceHandle hf : mesh.halffaces(c)) {
    const CellHandle neighbor = mesh.cell(mesh.opposite(hf));
    if (!neighbor.valid()) continue;
    const double difference = volumes[neighbor.idx] - volumes[c.idx];
    sum += difference * difference;
    ++n;
  }
  return n > 0 ? std::sqrt(sum / n) : 0.0;
}

void summarize_scaled_jacobians(const HexMesh& mesh, int n_worst, QualitySummary& q) {
  std::vector<std::pair<double, CellHandle>> ranked;
  ranked.reserve(mesh.n_cells());
  double sum = 0, sum_of_squares = 0;
  for (CellHandle c : mesh.cells()) {
    const double sj = scaled_jacobian(mesh, c);
    ranked.emplace_back(sj, c);
    sum += sj;
    sum_of_squares += sj * sj;
    q.n_inverted += !(sj > 0);
  }
  const double n = mesh.n_cells();
  q.mean_scaled_jacobian = sum / n;
  q.std_scaled_jacobian = std::sqrt(
      std::max(0.0, sum_of_squares / n - q.mean_scaled_jacobian * q.mean_scaled_jacobian));
  const auto n_listed = std::clamp<std::size_t>(n_worst, 1, ranked.size());
  std::partial_sort(ranked.begin(), ranked.begin() + n_listed, ranked.end());
  q.min_scaled_jacobian = ranked.front().first;
  for (std::size_t i = 0; i < n_listed && n_worst > 0; ++i)
    q.worst_cells.push_back(ranked[i].second);
}

}  // namespace

HexPoints points(const HexMesh& mesh, CellHandle c) {
  const CellVertices& v = mesh.vertices(c);
  return {mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3]),
          mesh.point(v[4]), mesh.point(v[5]), mesh.point(v[6]), mesh.point(v[7])};
}

double scaled_jacobian(const HexPoints& p) {
  double least = 1;
  const auto take = [&least](double sj) {
    least = std::isnan(sj) ? -1.0 : std::min(least, sj);  // a coordinate that is not finite
  };
  for (int i = 0; i < kCorners; ++i) {
    const auto& n = kCornerNeighbors[i];
    take(normalized_determinant(p[n[0]] - p[i], p[n[1]] - p[i], p[n[2]] - p[i]));
  }
  take(normalized_determinant(principal_axis(p, 0), principal_axis(p, 1), principal_axis(p, 2)));
  return least;
}

double volume(const HexPoints& p) {
  Vector3d center = Vector3d::Zero();
  for (const Vector3d& x : p) center += x / 8;
  double sum = 0;
  for (const auto& side : kSideCorners) {
    Vector3d middle = Vector3d::Zero();
    for (int k : side) middle += p[k] / 4;
    for (int i = 0; i < 4; ++i) {
      sum += determinant(middle - center, p[side[i]] - center, p[side[(i + 1) % 4]] - center) / 6;
    }
  }
  return sum;
}

double shape_metric(const HexPoints& p) {
  double sum = 0;
  for (int i = 0; i < kCorners; ++i) {
    const auto& n = kCornerNeighbors[i];
    const Vector3d a = p[n[0]] - p[i], b = p[n[1]] - p[i], c = p[n[2]] - p[i];
    const double det = determinant(a, b, c);
    if (!(det > 0)) return 0;
    const double root = std::cbrt(det);
    sum += (a.squaredNorm() + b.squaredNorm() + c.squaredNorm()) / (root * root);
  }
  return 24 / sum;
}

double scaled_jacobian(const HexMesh& mesh, CellHandle c) {
  return scaled_jacobian(points(mesh, c));
}
double volume(const HexMesh& mesh, CellHandle c) { return volume(points(mesh, c)); }
double shape_metric(const HexMesh& mesh, CellHandle c) { return shape_metric(points(mesh, c)); }

double edge_length(const HexMesh& mesh, EdgeHandle e) {
  const auto [a, b] = mesh.vertices(e);
  return (mesh.point(b) - mesh.point(a)).norm();
}

double mean_edge_length(const HexMesh& mesh) {
  double sum = 0;
  for (EdgeHandle e : mesh.edges()) sum += edge_length(mesh, e);
  return mesh.n_edges() > 0 ? sum / mesh.n_edges() : 0.0;
}

double min_scaled_jacobian(const HexMesh& mesh) {
  double least = 1;
  for (CellHandle c : mesh.cells()) least = std::min(least, scaled_jacobian(mesh, c));
  return least;
}

QualitySummary summarize_quality(const HexMesh& mesh, int n_worst) {
  QualitySummary q;
  if (mesh.n_cells() == 0) return q;
  summarize_scaled_jacobians(mesh, n_worst, q);
  std::vector<double> volumes(mesh.cell_slots(), 0.0);
  for (CellHandle c : mesh.cells()) q.total_volume += volumes[c.idx] = volume(mesh, c);
  const double mean_volume = q.total_volume / mesh.n_cells();
  for (CellHandle c : mesh.cells()) {
    const double deviation = volume_deviation(mesh, volumes, c) / mean_volume;
    q.mean_volume_deviation += deviation / mesh.n_cells();
    q.max_volume_deviation = std::max(q.max_volume_deviation, deviation);
  }
  q.mean_edge_length = mean_edge_length(mesh);
  return q;
}

}  // namespace hexweft
