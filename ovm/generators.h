/// \file
/// Meshes made in code: grids, O-grids, tori, voxel shapes, octree-like meshes, inserted sheets.
///
/// All results are valid (topology_check.h) with every scaled Jacobian positive, and depend on
/// their arguments alone, not on the machine.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "ovm/generators_solids.h"
#include "ovm/hex_mesh.h"

namespace hexweft {

/// nx × ny × nz cells; vertex (i, j, k) has handle i + (nx + 1)(j + (ny + 1)k), cell (i, j, k) has
/// handle i + nx(j + ny k). The default box has unit cells.
/// \throws InputError unless all counts are positive
HexMesh make_grid(const std::array<int, 3>& cells,
                  const std::optional<Eigen::AlignedBox3d>& box = std::nullopt);

/// A cylinder round the z axis: a core of n_core × n_core cells in each layer, and n_ring rings of
/// cells from it to the circle. Four singular edges of valence 3 run along it.
struct OGridOptions {
  int n_core = 2, n_ring = 2, n_layers = 4;  ///< all >= 1
  double radius = 1, height = 2;             ///< model units, > 0
};
HexMesh make_o_grid(const OGridOptions& options = {});

/// A ring round the z axis. A square section has four closed singular edges of valence 1 on the
/// boundary, a round one (an O-grid) has four of valence 3 inside.
struct TorusOptions {
  int n_core = 2, n_around = 16;              ///< >= 1, >= 3
  int n_ring = 1;                             ///< >= 1, for the round section
  double major_radius = 3, minor_radius = 1;  ///< model units, major > minor > 0
  bool round_section = true;
  /// By how many quarter turns the section twists on its way round; an odd number makes the sheets
  /// along the ring cross themselves, and a single closed singular edge of the four.
  int n_quarter_turns = 0;
};
HexMesh make_torus(const TorusOptions& options = {});

/// Three n × n × n grids round an edge of valence 3 on the boundary: an L.
HexMesh make_l_shape(int n);

/// Voxels by index, all within `size`; unit cells.
struct VoxelSet {
  std::array<int, 3> size;
  std::vector<char> filled;  ///< x fastest
  VoxelSet(const std::array<int, 3>& n, const std::function<bool(int, int, int)>& is_filled);
  bool operator()(int x, int y, int z) const;  ///< false outside
};

/// Unit cells at the filled voxels.
HexMesh make_voxels(const VoxelSet& voxels);

/// Fills voxels until the union is a manifold with manifold boundary and its boundary is nowhere
/// seen from both sides at one vertex, so that a layer can be laid under it.
void fill_to_manifold(VoxelSet& voxels);

/// Shapes with a smooth or piecewise smooth implicit function, all about 2 across.
enum class Shape { sphere, blob, torus, dumbbell, double_torus, block_with_hole };
inline constexpr std::array kShapes{Shape::sphere,   Shape::blob,         Shape::torus,
                                    Shape::dumbbell, Shape::double_torus, Shape::block_with_hole};
std::string_view name(Shape shape);

/// Negative inside. The seed bends the blob; the other shapes ignore it.
double signed_distance_like(Shape shape, const Eigen::Vector3d& p, unsigned seed);

Solid solid_of(Shape shape, unsigned seed = 0);

struct OctreeLikeOptions {
  int resolution = 16;  ///< >= 6, voxels along the longest side
  /// >= 1, cells along a side of a voxel. Many in few voxels are like what polycube meshers give:
  /// large blocks, singular edges along the steps between them.
  int cells_per_voxel = 1;
};

/// What octree meshers give: the voxels inside the solid with a layer of cells under their
/// boundary, drawn onto the surface and smoothed as far as every cell stays valid. It has many
/// singular edges that nothing needs. Voxels that touch along an edge or at a point are filled up
/// round it, so that thin gaps may close at a low resolution.
HexMesh make_octree_like(const Solid& solid, const OctreeLikeOptions& options = {});
HexMesh make_octree_like(Shape shape, int resolution, unsigned seed = 0);

/// Inserts up to n sheets round random ball-like sets of cells (radius 1 to 3 cells); a sheet that
/// is refused or makes a cell worse than a scaled Jacobian of 0.02 is taken back and another is
/// tried.
/// \return how many were inserted
int insert_random_sheets(HexMesh& mesh, int n, unsigned seed);

/// Adds a copy of all of `other`, moved by `offset`; nothing is glued.
void append_copy(HexMesh& mesh, const HexMesh& other, const Eigen::Vector3d& offset);

/// Moves every vertex. A map that mirrors turns the cells inside out.
void transform(HexMesh& mesh, const Eigen::Affine3d& map);

}  // namespace hexweft
