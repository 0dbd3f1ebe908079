/// \file
/// Element quality: scaled Jacobian, shape, volume, and what they amount to over a mesh.
///
///     const QualitySummary q = summarize_quality(mesh);
///     if (q.n_inverted > 0) inspect(q.worst_cells.front());
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "ovm/hex_mesh.h"

namespace hexweft {

/// The corners of a hexahedron in VTK order, model units.
using HexPoints = std::array<Eigen::Vector3d, 8>;

HexPoints points(const HexMesh& mesh, CellHandle c);

/// Least normalized determinant over the 8 corners and the centre, in [-1, 1]; 1 for a box, -1
/// where an edge has no length. Source [Verdict, V_HexScaledJacobian].
double scaled_jacobian(const HexPoints& p);
double scaled_jacobian(const HexMesh& mesh, CellHandle c);

/// Volume of the 24 tetrahedra that fan out from the mean of the corners over the triangles at the
/// mean of each side; negative for a cell inside out.
double volume(const HexPoints& p);
double volume(const HexMesh& mesh, CellHandle c);

/// 24 / sum over the corners of |A|^2 / det(A)^(2/3), A the matrix of the corner's edges: 1 for a
/// cube, towards 0 as the cell degenerates, 0 where a corner is flat or inverted. Free of scale.
/// Source [Knupp2003, hexahedral shape metric].
double shape_metric(const HexPoints& p);
double shape_metric(const HexMesh& mesh, CellHandle c);

/// Quality of a whole mesh.
struct QualitySummary {
  double min_scaled_jacobian = 1, mean_scaled_jacobian = 1, std_scaled_jacobian = 0;
  int n_inverted = 0;                   ///< cells of scaled Jacobian not > 0
  std::vector<CellHandle> worst_cells;  ///< by scaled Jacobian, worst first
  double total_volume = 0;
  double mean_volume_deviation = 0;  ///< AVDR
  double max_volume_deviation = 0;   ///< MVDR
  double mean_edge_length = 0;
};

/// The volume deviation ratio of a cell is the root mean square of its volume's difference from its
/// face neighbours' volumes over the mean volume of the mesh; 0 for a cell without neighbours.
/// \param n_worst  how many cells to list at most
QualitySummary summarize_quality(const HexMesh& mesh, int n_worst = 10);

double edge_length(const HexMesh& mesh, EdgeHandle e);  ///< model units
/// \return 0 for a mesh without edges
double mean_edge_length(const HexMesh& mesh);

/// Least scaled Jacobian of the live cells, 1 if there is none.
double min_scaled_jacobian(const HexMesh& mesh);

}  // namespace hexweft
