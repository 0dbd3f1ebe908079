/// \file
/// The distortion of hexahedra on flat arrays: energy, gradient, preconditioner, quality.
///
/// A hexahedron counts as the mean of an energy over its 8 corner tetrahedra, each compared with
/// the corner of a target cuboid. The eight corners are the eight lanes of one vector, and the
/// instruction set is chosen at run time. Everything is relative to the target, so the unit of
/// length cancels.
///
/// The Jacobian at a corner has as columns the three mesh edges there, each taken along its axis
/// and divided by the target's length; its determinant is positive in a valid hexahedron.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "optimize/energies/table.h"
#include "optimize/hex_batch.h"
#include "ovm/hex_mesh.h"

namespace hexweft {

/// Σ weight · mean over corners of the energy. Infinite where a barrier energy meets a corner with
/// det ≤ 0; the gradient is then unspecified.
/// \param points      3 × #points
/// \param gradient    null, or 3 × #points to which the gradient is *added*
/// \param stay_valid  treat any energy as a barrier energy
/// \throws InputError if the machine lacks the instruction set asked for
double hex_energy(const Energy& energy, const Eigen::Matrix3Xd& points,
                  std::span<const HexCorners> hexes, std::span<const TargetCuboid> targets,
                  Eigen::Matrix3Xd* gradient, InstructionSet set = InstructionSet::automatic,
                  bool stay_valid = false);

/// Adds to `blocks` a positive model of each vertex's 3 × 3 diagonal block of the second
/// derivative. \param blocks  6 × #points: xx, xy, xz, yy, yz, zz
void add_hex_curvature(const Energy& energy, const Eigen::Matrix3Xd& points,
                       std::span<const HexCorners> hexes, std::span<const TargetCuboid> targets,
                       Eigen::Matrix<double, 6, Eigen::Dynamic>& blocks);

/// A column an edge: the derivative of the energy by the edge vector (x, y, z), which runs along its
/// axis, and a positive model of the second derivative (xx, xy, xz, yy, yz, zz).
using EdgeTerms = Eigen::Matrix<double, 9, Eigen::Dynamic>;

/// Adds the terms of every mesh edge. Each column of a corner's Jacobian is an edge vector, so an
/// energy of the Jacobians is one of the edges, and the model needs no more than a metric an edge.
/// \param edges  one a hexahedron
/// \return the energy; infinite as with hex_energy(), the terms are then unspecified
double hex_edge_terms(const Energy& energy, const Eigen::Matrix3Xd& points,
                      std::span<const HexCorners> hexes, std::span<const TargetCuboid> targets,
                      std::span<const HexEdges> edges, EdgeTerms& terms,
                      InstructionSet set = InstructionSet::automatic, bool stay_valid = false);

/// Least corner determinant of every hexahedron over its target's volume: positive means valid
/// corners.
std::vector<double> min_relative_determinants(const Eigen::Matrix3Xd& points,
                                              std::span<const HexCorners> hexes,
                                              std::span<const TargetCuboid> targets);

/// Scaled Jacobian of every hexahedron, [-1, 1]: the least over its 8 corners and its centre, as
/// Verdict defines it. A corner with an edge of no length counts -1.
std::vector<double> scaled_jacobians(const Eigen::Matrix3Xd& points,
                                     std::span<const HexCorners> hexes);
/// The same of cells of a mesh: scaled_jacobian() (quality.h) of many at once, several times as fast.
std::vector<double> scaled_jacobians(const HexMesh& mesh, std::span<const CellHandle> cells);

/// Least and mean scaled Jacobian of some cells; of none 1.
struct Quality {
  double least = 1, mean = 1;
};
Quality quality_of(std::span<const double> scaled_jacobians);
Quality measure_quality(const HexMesh& mesh, std::span<const CellHandle> cells);

/// shape_metric() (quality.h) of many cells at once, several times as fast.
std::vector<double> shape_metrics(const HexMesh& mesh, std::span<const CellHandle> cells);

}  // namespace hexweft
