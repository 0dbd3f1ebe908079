#include "optimize/triangle_mesh.h"

#include <cmath>
#include <mutex>
#include <numbers>

#include <Eigen/Geometry>

namespace hexweft {
namespace {

std::mutex silence_mutex;
int n_silent = 0;

}  // namespace

SilentOpenMesh::SilentOpenMesh() {
  const std::lock_guard lock(silence_mutex);
  if (n_silent++ > 0) return;
  omerr().disable();
  omlog().disable();
}

SilentOpenMesh::~SilentOpenMesh() {
  const std::lock_guard lock(silence_mutex);
  if (--n_silent > 0) return;
  omerr().enable();
  omlog().enable();
}

TriangleMesh make_triangle_mesh(const Eigen::Matrix3Xd& points,
                                const std::vector<std::array<int, 3>>& triangles,
                                std::vector<TriangleMesh::VertexHandle>& first_vertex) {
  TriangleMesh mesh;
  mesh.request_face_normals();
  std::vector<TriangleMesh::VertexHandle> vertex(points.cols());
  for (Eigen::Index v = 0; v < points.cols(); ++v)
    vertex[v] = mesh.add_vertex(to_openmesh(points.col(v)));
  const SilentOpenMesh silence;  // about refused triangles
  for (const auto& t : triangles) {
    const bool loop = t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
    first_vertex.push_back(vertex[t[0]]);
    if (!loop && mesh.add_face(vertex[t[0]], vertex[t[1]], vertex[t[2]]).is_valid()) continue;
    const auto a = mesh.add_vertex(to_openmesh(points.col(t[0])));
    const auto b = mesh.add_vertex(to_openmesh(points.col(t[1])));
    mesh.add_face(a, b, mesh.add_vertex(to_openmesh(points.col(t[2]))));
    first_vertex.back() = a;
  }
  for (const auto f : mesh.faces()) {
    const auto& t = triangles[f.idx()];
    const Eigen::Vector3d ab = points.col(t[1]) - points.col(t[0]),
                          ac = points.col(t[2]) - points.col(t[0]);
    mesh.set_normal(f, to_openmesh(ab.cross(ac).normalized()));
  }
  return mesh;
}

std::vector<Eigen::Matrix3d> corner_normals(
    const TriangleMesh& mesh, const std::vector<TriangleMesh::VertexHandle>& first_vertex,
    double feature_angle_deg) {
  const double least = std::cos(feature_angle_deg * std::numbers::pi / 180);
  std::vector<Eigen::Matrix3d> normals(mesh.n_faces());
  for (const auto f : mesh.faces()) {
    auto h = mesh.halfedge_handle(f);
    while (mesh.from_vertex_handle(h) != first_vertex[f.idx()]) h = mesh.next_halfedge_handle(h);
    for (int corner = 0; corner < 3; ++corner, h = mesh.next_halfedge_handle(h)) {
      const auto v = mesh.from_vertex_handle(h);
      OpenMesh::Vec3d sum(0, 0, 0);
      for (auto out = mesh.cvoh_iter(v); out.is_valid(); ++out) {
        if (mesh.is_boundary(*out)) continue;
        const OpenMesh::Vec3d normal = mesh.normal(mesh.face_handle(*out));
        if ((normal | mesh.normal(f)) < least) continue;
        const auto before = mesh.from_vertex_handle(mesh.prev_halfedge_handle(*out));
        const OpenMesh::Vec3d a = mesh.point(mesh.to_vertex_handle(*out)) - mesh.point(v);
        const OpenMesh::Vec3d b = mesh.point(before) - mesh.point(v);
        sum += normal * std::atan2((a % b).norm(), a | b);
      }
      normals[f.idx()].col(corner) = to_eigen(sum.norm() > 0 ? sum.normalized() : mesh.normal(f));
    }
  }
  return normals;
}

}  // namespace hexweft
