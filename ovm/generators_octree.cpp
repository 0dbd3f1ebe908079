// Octree-like meshes: voxels of an implicit shape, a layer under their boundary, drawn onto the
// surface.
#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <random>

#include "ovm/detail/fit_to_solid.h"
#include "ovm/edit/insert_sheet.h"
#include "ovm/errors.h"
#include "ovm/generators.h"
#include "ovm/neighborhood.h"

namespace hexweft {
namespace {

using Eigen::Vector3d;

double torus(const Vector3d& p, double major, double minor) {
  return std::hypot(std::hypot(p.x(), p.y()) - major, p.z()) - minor;
}

// Union of two shapes with the seam rounded over the length k.
double smooth_union(double a, double b, double k) {
  const double h = std::max(k - std::abs(a - b), 0.0) / k;
  return std::min(a, b) - h * h * k / 4;
}

double segment(const Vector3d& p, double half_length, double radius) {
  const double x = std::clamp(p.x(), -half_length, half_length);
  return (p - Vector3d(x, 0, 0)).norm() - radius;
}

double blob(const Vector3d& p, unsigned seed) {
  std::mt19937_64 random(seed);
  const auto phase = [&] {
    return 2 * std::numbers::pi * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  double bumps = 0;
  for (int a = 0; a < 3; ++a) {
    const double along = phase(), across = phase();
    bumps += std::sin(3 * p[a] + along) * std::cos(2 * p[(a + 1) % 3] + across);
  }
  return p.norm() - 0.85 - 0.08 * bumps;
}

double block_with_hole(const Vector3d& p) {
  const Vector3d q = p.cwiseAbs() - Vector3d(1, 0.8, 0.5);
  const double box = q.cwiseMax(0).norm() + std::min(q.maxCoeff(), 0.0);
  return std::max(box, 0.4 - std::hypot(p.x(), p.y()));
}

// Half the sides of a box round the shape.
Vector3d half_extent(Shape shape) {
  switch (shape) {
    case Shape::torus:
      return {1.05, 1.05, 0.4};
    case Shape::dumbbell:
      return {1.1, 0.55, 0.55};
    case Shape::double_torus:
      return {1.35, 0.8, 0.3};
    case Shape::block_with_hole:
      return {1.0, 0.8, 0.5};
    default:
      return {1.1, 1.1, 1.1};
  }
}

// ---- Voxels ----

// Filled voxels of the 2 × 2 × 2 block below a lattice point, bit x + 2y + 4z.
unsigned block_mask(const VoxelSet& voxels, int x, int y, int z) {
  unsigned mask = 0;
  for (int i = 0; i < 8; ++i) {
    if (voxels(x - 1 + (i & 1), y - 1 + (i >> 1 & 1), z - 1 + (i >> 2))) mask |= 1u << i;
  }
  return mask;
}

bool is_connected(unsigned mask) {
  unsigned reached = mask & (~mask + 1);
  for (int round = 0; round < 8; ++round) {
    for (int i = 0; i < 8; ++i) {
      if (reached >> i & 1) reached |= mask & (1u << (i ^ 1) | 1u << (i ^ 2) | 1u << (i ^ 4));
    }
  }
  return reached == mask;
}

// Filled and empty voxels each hang together, and no axis is crossed by the boundary both ways.
bool can_carry_layer(unsigned mask) {
  if (!is_connected(mask) || !is_connected(~mask & 0xffu)) return false;
  for (int axis = 1; axis < 8; axis *= 2) {
    bool up = false, down = false;
    for (int i = 0; i < 8; ++i) {
      if (i & axis) continue;
      const bool low = mask >> i & 1, high = mask >> (i | axis) & 1;
      up |= low && !high;
      down |= high && !low;
    }
    if (up && down) return false;
  }
  return true;
}

bool fill_block(VoxelSet& voxels, int x, int y, int z) {
  bool changed = false;
  for (int i = 0; i < 8; ++i) {
    const int p[3] = {x - 1 + (i & 1), y - 1 + (i >> 1 & 1), z - 1 + (i >> 2)};
    bool in_set = true;
    for (int a = 0; a < 3; ++a) in_set &= p[a] >= 0 && p[a] < voxels.size[a];
    if (!in_set || voxels(p[0], p[1], p[2])) continue;
    const std::size_t row = p[1] + static_cast<std::size_t>(voxels.size[1]) * p[2];
    voxels.filled[p[0] + voxels.size[0] * row] = 1;
    changed = true;
  }
  return changed;
}

VoxelSet subdivided(const VoxelSet& coarse, int k) {
  const auto& n = coarse.size;
  return VoxelSet({k * n[0], k * n[1], k * n[2]},
                  [&](int x, int y, int z) { return coarse(x / k, y / k, z / k); });
}

}  // namespace

std::string_view name(Shape shape) {
  switch (shape) {
    case Shape::sphere:
      return "sphere";
    case Shape::blob:
      return "blob";
    case Shape::torus:
      return "torus";
    case Shape::dumbbell:
      return "dumbbell";
    case Shape::double_torus:
      return "double-torus";
    default:
      return "block-with-hole";
  }
}

double signed_distance_like(Shape shape, const Vector3d& p, unsigned seed) {
  switch (shape) {
    case Shape::sphere:
      return p.norm() - 1;
    case Shape::blob:
      return blob(p, seed);
    case Shape::torus:
      return torus(p, 0.68, 0.32);
    case Shape::dumbbell: {
      const double balls =
          std::min((p - Vector3d(0.6, 0, 0)).norm(), (p + Vector3d(0.6, 0, 0)).norm()) - 0.45;
      return smooth_union(balls, segment(p, 0.6, 0.2), 0.2);
    }
    case Shape::double_torus:
      return smooth_union(torus(p - Vector3d(0.58, 0, 0), 0.5, 0.24),
                          torus(p + Vector3d(0.58, 0, 0), 0.5, 0.24), 0.1);
    default:
      return block_with_hole(p);
  }
}

void fill_to_manifold(VoxelSet& voxels) {
  // Only fills, hence ends.
  for (bool changed = true; changed;) {
    changed = false;
    for (int z = 0; z <= voxels.size[2]; ++z) {
      for (int y = 0; y <= voxels.size[1]; ++y) {
        for (int x = 0; x <= voxels.size[0]; ++x) {
          if (can_carry_layer(block_mask(voxels, x, y, z))) continue;
          changed |= fill_block(voxels, x, y, z);
        }
      }
    }
  }
}

Solid solid_of(Shape shape, unsigned seed) {
  const Vector3d half = half_extent(shape);
  return {[=](const Vector3d& p) { return signed_distance_like(shape, p, seed); },
          Eigen::AlignedBox3d(Vector3d(-half), half), false};
}

HexMesh make_octree_like(const Solid& solid, const OctreeLikeOptions& options) {
  if (options.resolution < 6) {
    throw InputError("an octree-like mesh needs a resolution of at least 6");
  }
  if (options.cells_per_voxel < 1) throw InputError("a voxel needs at least one cell a side");
  const Vector3d sides = solid.box.sizes();
  const double h = sides.maxCoeff() / options.resolution;
  std::array<int, 3> n;
  for (int a = 0; a < 3; ++a) n[a] = std::max(1, static_cast<int>(std::ceil(sides[a] / h - 1e-9)));
  const Vector3d low = solid.box.center() - 0.5 * h * Vector3d(n[0], n[1], n[2]);
  VoxelSet voxels(n, [&](int x, int y, int z) {
    return solid.distance(low + h * Vector3d(x + 0.5, y + 0.5, z + 0.5)) < 0;
  });
  fill_to_manifold(voxels);
  const int k = options.cells_per_voxel;
  HexMesh mesh = make_voxels(k == 1 ? voxels : subdivided(voxels, k));
  if (mesh.n_cells() == 0) throw InputError("the resolution is too low to show any of the solid");
  const double edge_length = h / k;
  for (VertexHandle v : mesh.vertices()) mesh.set_point(v, low + edge_length * mesh.point(v));

  insert_sheet(mesh, all_cells(mesh), {.depth_rel = 0.6, .include_boundary = true});
  mesh.collect_garbage();
  detail::fit_to_solid(mesh, solid, edge_length);
  return mesh;
}

HexMesh make_octree_like(Shape shape, int resolution, unsigned seed) {
  return make_octree_like(solid_of(shape, seed), {.resolution = resolution});
}

}  // namespace hexweft
