/// \file
/// Hexahedra on flat arrays: what the kernels over eight lanes are given.
#pragma once

#include <array>
#include <span>

#include <Eigen/Core>

namespace hexweft {

/// Corners of a hexahedron as columns of a point matrix, in the order of ovm/hex_numbering.h.
using HexCorners = std::array<int, 8>;

/// The twelve edges of a hexahedron as indices into an array of edges, in the order of
/// kEdgeCorners (ovm/hex_numbering.h); ~index where the mesh edge runs the other way.
using HexEdges = std::array<int, 12>;

/// What a hexahedron should look like.
struct TargetCuboid {
  Eigen::Vector3d lengths = Eigen::Vector3d::Ones();  ///< > 0, along the local axes, model units
  double weight = 1;                                  ///< > 0, of this hexahedron in the sum
};

/// Instruction sets the evaluation is compiled for. `automatic` takes the best the machine has.
enum class InstructionSet { automatic, portable, avx2, avx512 };

/// The instruction set to use. \throws InputError if the machine lacks the one asked for
InstructionSet available(InstructionSet wanted);

/// Hexahedra, their targets and their points (3 × #points).
struct HexBatch {
  const double* points;
  std::span<const HexCorners> hexes;
  std::span<const TargetCuboid> targets;
  bool stay_valid = false;  ///< a corner with det ≤ 0 makes any energy infinite
};

}  // namespace hexweft
