#include "optimize/reference_surface.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <new>
#include <numbers>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>

#include <Eigen/Geometry>
#include <embree3/rtcore.h>

#include "optimize/box.h"
#include "optimize/closest_point.h"
#include "optimize/triangle_mesh.h"
#include "ovm/errors.h"
#include "ovm/hex_mesh.h"

namespace hexweft {
namespace {

/// Embree's spatial index over triangles, in single precision about a centre and in units of the
/// size. Only a filter. It knows them by their boxes, and offers those alone whose box is near enough;
/// with triangles of its own kind it would offer all that lie in a leaf together, twice as many.
class TriangleIndex {
 public:
  TriangleIndex(const Eigen::Matrix3Xd& points, const std::vector<std::array<int, 3>>& triangles,
                const Eigen::Vector3d& centre, double size);
  RTCScene scene() const { return scene_.get(); }

 private:
  struct Release {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  };
  template <class Handle>
  using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Release>;

  Owned<RTCDevice> device_;
  Owned<RTCScene> scene_;
};

/// \param device  may be null, if there is none for the error
void expect_no_error(RTCDevice device) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  if (error != RTC_ERROR_NONE)
    throw SolverError("Embree failed with error " + std::to_string(error));
}

void check(const Eigen::Matrix3Xd& points, const std::vector<std::array<int, 3>>& triangles) {
  if (triangles.empty()) throw InputError("the reference surface has no triangles");
  if (!points.allFinite()) throw InputError("a point of the reference surface is not finite");
  for (const auto& t : triangles) {
    for (int v : t) {
      if (v < 0 || v >= points.cols()) {
        throw InputError("triangle vertex " + std::to_string(v) + ", expected [0, " +
                         std::to_string(points.cols()) + ")");
      }
    }
  }
}

/// Sixth powers of distances must neither vanish nor overflow.
double check_size(double diagonal) {
  constexpr double kLeast = 1e-45, kMost = 1e45;
  if (diagonal >= kLeast && diagonal <= kMost) return diagonal;
  std::ostringstream message;
  message << "the diagonal of the reference surface's bounding box is " << diagonal << ", expected "
          << kLeast << " to " << kMost;
  throw InputError(message.str());
}

TriangleIndex::TriangleIndex(const Eigen::Matrix3Xd& points,
                             const std::vector<std::array<int, 3>>& triangles,
                             const Eigen::Vector3d& centre, double size)
    : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_.get())) {
  expect_no_error(device_.get());
  std::vector<RTCBounds> boxes;  // read by the commit only
  boxes.reserve(triangles.size());
  for (const auto& t : triangles) {
    const std::array<Eigen::Vector3d, 3> corners = {points.col(t[0]), points.col(t[1]),
                                                    points.col(t[2])};
    const Box3 box = box_of(corners);
    const Eigen::Vector3f lower = ((box.lower - centre) / size).cast<float>();
    const Eigen::Vector3f upper = ((box.upper - centre) / size).cast<float>();
    boxes.push_back({lower[0], lower[1], lower[2], 0, upper[0], upper[1], upper[2], 0});
  }
  RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(boxes.size()));
  rtcSetGeometryUserData(geometry, boxes.data());
  rtcSetGeometryBoundsFunction(
      geometry,
      [](const RTCBoundsFunctionArguments* args) {
        *args->bounds_o = static_cast<const RTCBounds*>(args->geometryUserPtr)[args->primID];
      },
      nullptr);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene(), geometry);
  rtcReleaseGeometry(geometry);
  rtcSetSceneBuildQuality(scene(), RTC_BUILD_QUALITY_MEDIUM);
  rtcCommitScene(scene());
  expect_no_error(device_.get());
}

/// What a query reads of a triangle, in one place and in that order.
struct alignas(64) Facet {
  Eigen::Vector3d a, b, c, normal;
  bool at_feature;
};

/// The state of one query while Embree offers triangles.
struct Search {
  const std::vector<Facet>& facets;
  Eigen::Vector3d p;
  const Eigen::Vector3d* hint;
  double size;     // unit of the index, model units
  double slack;    // bounds the rounding of the index, model units
  double squared;  // of the best distance so far
  double enough;   // squared: what is nearer ends the search
  int triangle = -1;
  TrianglePoint best{};

  bool done() const { return triangle >= 0 && squared <= enough; }

  float radius() const {
    return done() ? 0 : static_cast<float>((std::sqrt(squared) * (1 + 1e-6) + slack) / size);
  }

  bool offer(int id) {
    const Facet& t = facets[id];
    if (hint && t.normal.dot(*hint) <= 0) return false;
    const TrianglePoint q = closest_point(p, t.a, t.b, t.c);
    const double d = (q.point - p).squaredNorm();
    if (d > squared || (d == squared && triangle >= 0 && id >= triangle)) return false;
    squared = d;
    triangle = id;
    best = q;
    return true;
  }
};

bool offer_triangle(RTCPointQueryFunctionArguments* args) {
  auto& search = *static_cast<Search*>(args->userPtr);
  if (!search.offer(static_cast<int>(args->primID))) return false;
  args->query->radius = search.radius();
  return true;
}

}  // namespace

struct ReferenceSurface::Impl {
  Impl(Eigen::Matrix3Xd p, std::vector<std::array<int, 3>> t, double feature_angle_deg,
       const FeatureOptions& features)
      : points((check(p, t), std::move(p))),
        triangles(std::move(t)),
        lower(points.rowwise().minCoeff()),
        upper(points.rowwise().maxCoeff()),
        centre((lower + upper) / 2),
        diagonal(check_size((upper - lower).stableNorm())),
        mesh(make_triangle_mesh(points, triangles, first_vertex)),
        normals(corner_normals(mesh, first_vertex, feature_angle_deg)),
        index(points, triangles, centre, diagonal),
        curves(points, triangles, find_features(points, triangles, features)) {
    make_facets(feature_angle_deg);
  }

  void make_facets(double feature_angle_deg);

  /// \param near  a triangle to begin with, or -1
  Search search(const Eigen::Vector3d& p, const Eigen::Vector3d* hint, double reach, int near,
                double enough = 0) const;
  SurfacePoint query(const Eigen::Vector3d& p, const Eigen::Vector3d* hint, double reach,
                     int near) const;

  Eigen::Matrix3Xd points;
  std::vector<std::array<int, 3>> triangles;
  Eigen::Vector3d lower, upper, centre;
  double diagonal;
  std::vector<TriangleMesh::VertexHandle> first_vertex;  // of every face
  TriangleMesh mesh;
  std::vector<Eigen::Matrix3d> normals;  // of the corners, as columns
  std::vector<Facet> facets;
  TriangleIndex index;
  FeatureCurves curves;
};

void ReferenceSurface::Impl::make_facets(double feature_angle_deg) {
  const double least = std::cos(feature_angle_deg * std::numbers::pi / 180);
  std::vector<char> sharp(mesh.n_vertices(), 0);
  for (const auto e : mesh.edges()) {
    const auto h = mesh.halfedge_handle(e, 0), back = mesh.halfedge_handle(e, 1);
    if (mesh.is_boundary(e)) continue;
    if ((mesh.normal(mesh.face_handle(h)) | mesh.normal(mesh.face_handle(back))) >= least) continue;
    sharp[mesh.from_vertex_handle(h).idx()] = sharp[mesh.to_vertex_handle(h).idx()] = 1;
  }
  facets.reserve(triangles.size());
  for (const auto f : mesh.faces()) {
    const auto& [a, b, c] = triangles[f.idx()];
    bool at_feature = false;
    for (auto v = mesh.cfv_iter(f); v.is_valid(); ++v) at_feature |= sharp[v->idx()] != 0;
    facets.push_back(
        {points.col(a), points.col(b), points.col(c), to_eigen(mesh.normal(f)), at_feature});
  }
}

Search ReferenceSurface::Impl::search(const Eigen::Vector3d& p, const Eigen::Vector3d* hint,
                                      double reach, int near, double enough) const {
  const Eigen::Vector3d local = p - centre;
  Search search{.facets = facets,
                .p = p,
                .hint = hint,
                .size = diagonal,
                .slack = 1e-6 * (diagonal + local.norm()),
                .squared = reach * reach,
                .enough = enough > 0 ? enough * enough : -1};
  if (near >= 0) search.offer(near);
  if (search.done()) return search;
  RTCPointQuery query;
  query.x = static_cast<float>(local[0] / diagonal);
  query.y = static_cast<float>(local[1] / diagonal);
  query.z = static_cast<float>(local[2] / diagonal);
  query.time = 0;
  query.radius = search.radius();
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(index.scene(), &query, &context, offer_triangle, &search);
  return search;
}

SurfacePoint ReferenceSurface::Impl::query(const Eigen::Vector3d& p, const Eigen::Vector3d* hint,
                                           double reach, int near) const {
  const Search search = this->search(p, hint, reach, near);
  SurfacePoint found;
  if (search.triangle < 0) return found;
  found.point = search.best.point;
  found.distance = std::sqrt(search.squared);
  found.triangle = search.triangle;
  found.normal = (normals[search.triangle] * search.best.weights).normalized();
  return found;
}

ReferenceSurface::ReferenceSurface(Eigen::Matrix3Xd points,
                                   std::vector<std::array<int, 3>> triangles,
                                   double feature_angle_deg, const FeatureOptions& features)
    : impl_(std::make_shared<const Impl>(std::move(points), std::move(triangles), feature_angle_deg,
                                         features)) {}

SurfacePoint ReferenceSurface::closest(const Eigen::Vector3d& p, int near) const {
  return impl_->query(p, nullptr, std::numeric_limits<double>::infinity(), near);
}

SurfacePoint ReferenceSurface::closest(const Eigen::Vector3d& p, const Eigen::Vector3d& hint,
                                       int near) const {
  const SurfacePoint found = impl_->query(p, &hint, std::numeric_limits<double>::infinity(), near);
  return found.triangle >= 0 ? found : closest(p, near);
}

SurfacePoint ReferenceSurface::closest_within(const Eigen::Vector3d& p, double reach) const {
  return impl_->query(p, nullptr, reach, -1);
}

double ReferenceSurface::distance(const Eigen::Vector3d& p, int& near, double enough) const {
  const Search found =
      impl_->search(p, nullptr, std::numeric_limits<double>::infinity(), near, enough);
  near = found.triangle;
  return std::sqrt(found.squared);
}

const Eigen::Matrix3Xd& ReferenceSurface::points() const { return impl_->points; }
const std::vector<std::array<int, 3>>& ReferenceSurface::triangles() const {
  return impl_->triangles;
}
const FeatureCurves& ReferenceSurface::curves() const { return impl_->curves; }
double ReferenceSurface::bounding_box_diagonal() const { return impl_->diagonal; }
bool ReferenceSurface::at_feature(int triangle) const { return impl_->facets[triangle].at_feature; }
Eigen::Vector3d ReferenceSurface::triangle_normal(int triangle) const {
  return to_eigen(impl_->mesh.normal(TriangleMesh::FaceHandle(triangle)));
}

ReferenceSurface make_reference_surface(const HexMesh& mesh, double feature_angle_deg,
                                        const FeatureOptions& features) {
  std::vector<int> id(mesh.vertex_slots(), -1);
  std::vector<VertexHandle> used;
  std::vector<std::array<int, 3>> triangles;
  for (HalfFaceHandle hf : mesh.boundary_halffaces()) {
    std::array<int, 4> q;
    for (int i = 0; VertexHandle v : mesh.vertices(hf)) {
      if (id[v.idx] < 0) {
        id[v.idx] = static_cast<int>(used.size());
        used.push_back(v);
      }
      q[i++] = id[v.idx];
    }
    triangles.push_back({q[0], q[1], q[2]});
    triangles.push_back({q[2], q[3], q[0]});
  }
  Eigen::Matrix3Xd points(3, used.size());
  for (std::size_t i = 0; i < used.size(); ++i) points.col(i) = mesh.point(used[i]);
  return ReferenceSurface(std::move(points), std::move(triangles), feature_angle_deg, features);
}

}  // namespace hexweft
