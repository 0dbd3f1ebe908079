#include "ovm/detail/fit_to_solid.h"

#include <cmath>
#include <vector>

#include <Eigen/Dense>

#include "ovm/detail/guarded_smoothing.h"

namespace hexweft::detail {
namespace {

using Eigen::Vector3d;

class Fitter {
 public:
  Fitter(HexMesh& mesh, const Solid& solid, double edge_length)
      : mesh_(mesh),
        solid_(solid),
        edge_length_(edge_length),
        on_boundary_(mesh.vertex_slots(), 0),
        edge_on_boundary_(mesh.edge_slots(), 0) {
    for (VertexHandle v : mesh.vertices()) on_boundary_[v.idx] = mesh.is_boundary(v);
    for (EdgeHandle e : mesh.edges()) edge_on_boundary_[e.idx] = mesh.is_boundary(e);
  }

  void sweep(double floor) {
    if (solid_.sharp) find_tangent_planes();
    for (VertexHandle v : mesh_.vertices()) {
      const bool boundary = on_boundary_[v.idx];
      const Vector3d mean = mean_of_neighbors(
          mesh_, v, [&](EdgeHandle e) { return !boundary || edge_on_boundary_[e.idx]; });
      if (!boundary) {
        move_guarded(mesh_, v, mean, floor);
        continue;
      }
      const Vector3d target = place((mean + mesh_.point(v)) / 2, v);
      // Where smoothing is refused, at least draw the vertex to the surface.
      if (move_guarded(mesh_, v, target, floor) < 1) {
        move_guarded(mesh_, v, place(mesh_.point(v), v), floor);
      }
    }
  }

  // Frees vertices that no mean moves: the best of some steps of about this length.
  void search(double length) {
    for (VertexHandle v : mesh_.vertices()) {
      double best = min_scaled_jacobian_round(mesh_, v);
      if (best > 0.2) continue;
      const Vector3d from = mesh_.point(v);
      Vector3d to = from;
      for (int i = 0; i < 54; ++i) {
        const Vector3d direction(i % 3 - 1, i / 3 % 3 - 1, i / 9 % 3 - 1);
        const Vector3d p = from + (i < 27 ? length : length / 4) * direction;
        mesh_.set_point(v, on_boundary_[v.idx] ? project(p) : p);
        const double least = min_scaled_jacobian_round(mesh_, v);
        if (least <= best) continue;
        best = least;
        to = mesh_.point(v);
      }
      mesh_.set_point(v, to);
    }
  }

 private:
  struct Plane {
    Vector3d point, normal;
  };

  Vector3d gradient(const Vector3d& p) const {
    constexpr double h = 1e-5;
    Vector3d result;
    for (int a = 0; a < 3; ++a) {
      const Vector3d d = h * Vector3d::Unit(a);
      result[a] = (solid_.distance(p + d) - solid_.distance(p - d)) / (2 * h);
    }
    return result;
  }

  Vector3d project(Vector3d p) const {
    for (int i = 0; i < 8; ++i) {
      const double f = solid_.distance(p);
      if (std::abs(f) < 1e-9) break;
      const Vector3d g = gradient(p);
      if (g.squaredNorm() < 1e-6) break;
      p -= f / g.squaredNorm() * g;
    }
    return p;
  }

  // The planes that touch the surface near the middle of each boundary face, by vertex.
  void find_tangent_planes() {
    planes_.assign(mesh_.vertex_slots(), {});
    for (HalfFaceHandle hf : mesh_.boundary_halffaces()) {
      const auto corners = mesh_.vertices(hf);
      Vector3d middle = Vector3d::Zero();
      for (VertexHandle v : corners) middle += mesh_.point(v) / 4;
      const Vector3d p = project(middle), g = gradient(p);
      if (g.squaredNorm() < 1e-6) continue;
      for (VertexHandle v : corners) planes_[v.idx].push_back({p, g.normalized()});
    }
  }

  // Where on the surface a boundary vertex wanted near p should lie. On a sharp solid this is near
  // all the planes round it: on the edge or the corner in which they meet, if they do.
  Vector3d place(const Vector3d& p, VertexHandle v) const {
    if (!solid_.sharp || planes_[v.idx].empty()) return project(p);
    constexpr double kStay = 0.02;  // weight of p itself, for what the planes leave open
    Eigen::Matrix3d normal_matrix = kStay * Eigen::Matrix3d::Identity();
    Vector3d right = Vector3d::Zero();
    for (const Plane& plane : planes_[v.idx]) {
      normal_matrix += plane.normal * plane.normal.transpose();
      right += plane.normal * plane.normal.dot(plane.point - p);
    }
    const Vector3d step = normal_matrix.ldlt().solve(right);
    if (step.norm() > 1.5 * edge_length_) return project(p);  // the planes meet far away
    return project(p + step);
  }

  HexMesh& mesh_;
  const Solid& solid_;
  double edge_length_;
  std::vector<char> on_boundary_, edge_on_boundary_;
  std::vector<std::vector<Plane>> planes_;
};

}  // namespace

void fit_to_solid(HexMesh& mesh, const Solid& solid, double edge_length) {
  Fitter fitter(mesh, solid, edge_length);
  for (double floor : {0.2, 0.2, 0.2, 0.2, 0.1, 0.1, 0.05, 0.05, 0.1, 0.1, 0.2, 0.2, 0.3, 0.3}) {
    fitter.sweep(floor);
    fitter.search(0.3 * edge_length);
  }
}

}  // namespace hexweft::detail
