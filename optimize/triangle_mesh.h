/// \file
/// Triangles as an OpenMesh, which knows what is next to what. For the sources of optimize/ only.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

namespace hexweft {

struct TriangleMeshTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using TriangleMesh = OpenMesh::TriMesh_ArrayKernelT<TriangleMeshTraits>;

inline OpenMesh::Vec3d to_openmesh(const Eigen::Vector3d& p) { return {p[0], p[1], p[2]}; }
inline Eigen::Vector3d to_eigen(const OpenMesh::Vec3d& p) { return {p[0], p[1], p[2]}; }

/// While there is one, on whatever thread, OpenMesh does not report on the console what it does not like.
class SilentOpenMesh {
 public:
  SilentOpenMesh();
  SilentOpenMesh(const SilentOpenMesh&) = delete;
  SilentOpenMesh& operator=(const SilentOpenMesh&) = delete;
  ~SilentOpenMesh();
};

/// The triangles as an OpenMesh. A triangle that would make it non-manifold gets vertices of its
/// own. \param first_vertex  set to the vertex of every face that is its triangle's first corner
TriangleMesh make_triangle_mesh(const Eigen::Matrix3Xd& points,
                                const std::vector<std::array<int, 3>>& triangles,
                                std::vector<TriangleMesh::VertexHandle>& first_vertex);

/// Normals of the three corners of every triangle: angle-weighted over the triangles round the
/// vertex that lie within the feature angle of this one.
std::vector<Eigen::Matrix3d> corner_normals(
    const TriangleMesh& mesh, const std::vector<TriangleMesh::VertexHandle>& first_vertex,
    double feature_angle_deg);

}  // namespace hexweft
