/// \file
/// Relaxes the cells round a collapse: untangles them, then spreads the distortion while the
/// surface slides.
///
///     Transaction trial(mesh);
///     ...merge vertices...
///     const auto report = parametrize(mesh, region, reference);
///     if (report.valid()) trial.commit();
///
/// Source [Gao2017, §4.3; Xu2021, §4.3]. Differs: L-BFGS in place of SLIM's linear solves, an
/// untangling stage in front, back-off of the projection.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "optimize/reference_surface.h"
#include "optimize/region.h"
#include "optimize/surface_constraint.h"
#include "optimize/target_shape.h"
#include "ovm/hex_mesh.h"

namespace hexweft {

struct ParametrizationOptions {
  Energy energy = InverseScaledJacobian{};  ///< one without a barrier is kept from inverting
  int max_iterations = 5;                   ///< > 0, each with new target shapes and a projection
  int relaxation_iterations = 10;           ///< > 0, L-BFGS steps in each
  int untangling_rounds = 15;  ///< ≥ 0, each with a smaller ε; 0: an inverted start fails
  /// Where moving what lies round the flat hexahedra does not untangle them, all of the region moves.
  bool untangle_widely = true;
  double min_scaled_jacobian = 0;  ///< [-1, 1), below it the result is not valid
  double quality_goal = 0.8;       ///< (0, 1], hexahedra below it do not weigh 1
  /// Below the goal a hexahedron of scaled Jacobian SJ weighs (goal / SJ) to the power of this:
  /// positive raises the least scaled Jacobian, negative the mean.
  int quality_exponent = 2;
  double quality_weight_limit = 30;   ///< ≥ 1, the most one hexahedron may weigh; 1 / the least
  double least_on_projection = 0.15;  ///< [-1, 1], no projection takes a scaled Jacobian below it
  double goal_weight = 10;            ///< > 0, of vertex goals; one hexahedron's distortion is 1
  SurfaceOptions surface = {};
  TargetShapeOptions target = {};
};
void validate(const ParametrizationOptions& options);  ///< \throws InputError

/// A place a vertex is drawn to, as before a merge.
struct VertexGoal {
  VertexHandle vertex;
  Eigen::Vector3d point;
};

enum class ParametrizationFailure { none, still_inverted, low_quality };
std::string_view name(ParametrizationFailure failure);

struct ParametrizationReport {
  ParametrizationFailure failure = ParametrizationFailure::none;
  double min_scaled_jacobian = 1, mean_scaled_jacobian = 1;  ///< of the region, when done
  double initial_min_scaled_jacobian = 1;
  double max_move = 0;    ///< model units
  double on_surface = 1;  ///< fraction of surface vertices whose last projection went all the way
  int iterations = 0;     ///< outer ones
  int relaxation_iterations = 0;  ///< L-BFGS steps altogether
  bool untangled = false;         ///< the start was inverted
  bool valid() const { return failure == ParametrizationFailure::none; }
};

/// The cells of one region, to be parametrized as often as is wanted: what belongs to the region and
/// not to its points is found out once, as which features its vertices stand for.
class RegionParametrization {
 public:
  /// \param region     live cells, each once; must stay as they are but for their points
  /// \param reference  must outlive this
  /// \throws InputError for a cell that is not live or occurs twice
  RegionParametrization(const HexMesh& mesh, std::span<const CellHandle> region,
                        const ReferenceSurface& reference);

  /// Moves the vertices all of whose cells are in the region; the others stay. Surface vertices slide
  /// on the reference's tangent planes and are projected back after each iteration, as far as nothing
  /// inverts. What an energy without a barrier leaves below the least scaled Jacobian is mended with
  /// one that has it. The start may hold inverted and degenerate cells, as right after a merge.
  /// Writes points only, through mesh.set_point. Independent of the unit of length.
  /// \throws InputError on bad options
  ParametrizationReport run(HexMesh& mesh, const ParametrizationOptions& options = {},
                            std::span<const VertexGoal> goals = {});

 private:
  Region region_;
  SurfaceConstraint constraint_;
};

/// The same once.
ParametrizationReport parametrize(HexMesh& mesh, std::span<const CellHandle> region,
                                  const ReferenceSurface& reference,
                                  const ParametrizationOptions& options = {},
                                  std::span<const VertexGoal> goals = {});

}  // namespace hexweft
