/// \file
/// The meshes that property tests run over, made in code. Small, so that a test may visit each
/// element of each of them; together they have closed singular edges, cavities, several parts,
/// every genus up to 2, deleted slots, sheets that cross themselves.
///
///     class EveryMeshFamily : public testing::TestWithParam<MeshFamily> {};
///     INSTANTIATE_TEST_SUITE_P(, EveryMeshFamily, testing::ValuesIn(mesh_families()),
///     family_name);
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "ovm/generators.h"
#include "ovm/hex_mesh.h"

namespace hexweft {

struct MeshFamily {
  std::string name;
  HexMesh (*make)();
  friend std::ostream& operator<<(std::ostream& out, const MeshFamily& f) { return out << f.name; }
};

/// A grid with a cell missing in its middle: the boundary has two components.
inline HexMesh make_hollow_box() {
  return make_voxels(
      VoxelSet({3, 3, 3}, [](int x, int y, int z) { return x != 1 || y != 1 || z != 1; }));
}

inline HexMesh make_two_boxes() {
  return make_voxels(VoxelSet({5, 2, 2}, [](int x, int, int) { return x != 2; }));
}

/// A grid that has lost cells and vertices and was not compacted.
inline HexMesh make_grid_with_deleted_slots() {
  HexMesh mesh = make_grid({4, 4, 4});
  for (int i = 0; i < 16; ++i) mesh.delete_cell(CellHandle(i));  // the lowest layer
  for (int i = 0; i < 25; ++i) mesh.delete_vertex(VertexHandle(i));
  return mesh;
}

inline HexMesh make_grid_with_sheets() {
  HexMesh mesh = make_grid({6, 6, 6});
  insert_random_sheets(mesh, 6, 3);
  return mesh;
}

inline HexMesh make_o_grid_with_sheets() {
  HexMesh mesh = make_o_grid({.n_core = 3, .n_ring = 3, .n_layers = 5});
  insert_random_sheets(mesh, 6, 5);
  mesh.collect_garbage();
  return mesh;
}

inline std::vector<MeshFamily> mesh_families() {
  return {
      {"cube",
       [] {
         return make_grid({1, 1, 1});
       }},
      {"grid",
       [] {
         return make_grid({4, 3, 2});
       }},
      {"grid_with_deleted_slots", make_grid_with_deleted_slots},
      {"two_boxes", make_two_boxes},
      {"hollow_box", make_hollow_box},
      {"l_shape", [] { return make_l_shape(2); }},
      {"o_grid", [] { return make_o_grid(); }},
      {"round_torus", [] { return make_torus(); }},
      {"square_torus", [] { return make_torus({.n_around = 7, .round_section = false}); }},
      {"twisted_torus",
       [] { return make_torus({.n_around = 16, .round_section = false, .n_quarter_turns = 1}); }},
      {"grid_with_sheets", make_grid_with_sheets},
      {"o_grid_with_sheets", make_o_grid_with_sheets},
      {"octree_sphere", [] { return make_octree_like(Shape::sphere, 7); }},
      {"octree_blob", [] { return make_octree_like(Shape::blob, 9, 4); }},
      {"octree_dumbbell", [] { return make_octree_like(Shape::dumbbell, 12); }},
      {"octree_torus", [] { return make_octree_like(Shape::torus, 12); }},
      {"octree_double_torus", [] { return make_octree_like(Shape::double_torus, 16); }},
      {"octree_block_with_hole", [] { return make_octree_like(Shape::block_with_hole, 10); }},
  };
}

inline std::string family_name(const testing::TestParamInfo<MeshFamily>& info) {
  return info.param.name;
}

}  // namespace hexweft
