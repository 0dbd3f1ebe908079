#include "simplify/surface_check.h"

#include <algorithm>

#include "optimize/hex_energy.h"
#include "ovm/neighborhood.h"

namespace hexweft {
namespace {

// Of the limit: where a sample of the loop is farther, what lies between the samples is looked at.
constexpr double kClose = 0.5;

}  // namespace

bool stays_on_surface(TrialContext& context, std::span<const CellHandle> touched) {
  const StageTimer timer(context.clock, Stage::distance);
  const double limit = context.distance_limit;
  const double d = context.distance.after_change(context.mesh, touched, limit);
  if (d <= kClose * limit) return true;
  if (d <= limit) {
    const StageTimer full(context.clock, Stage::full_distance);
    if (context.distance.change_is_within(context.final_limit, kClose)) return true;
  }
  context.distance.rollback();
  return false;
}

std::pair<HalfFaceHandle, double> farthest_side(const SurfaceDistance& distance) {
  const std::vector<double> by_side = distance.distance_by_halfface();
  const auto worst = std::max_element(by_side.begin(), by_side.end());
  return {HalfFaceHandle(static_cast<int>(worst - by_side.begin())), *worst};
}

bool relieve_farthest(TrialContext& context, const SimplifyOptions& options) {
  constexpr double kCloseToLimit = 0.7;
  const double before = context.distance.distance();
  if (before < kCloseToLimit * context.distance_limit) return false;
  HexMesh& mesh = context.mesh;
  const auto side = mesh.vertices(farthest_side(context.distance).first);
  const std::vector<CellHandle> region = cells_around(mesh, side, options.rings);
  const Quality old = measure_quality(mesh, region);
  ParametrizationOptions p = options.parametrization;
  p.min_scaled_jacobian = std::min(options.min_scaled_jacobian, old.least);
  Transaction attempt(mesh);
  if (!parametrize(mesh, region, context.reference, p).valid()) return false;
  const bool nearer = context.distance.after_change(mesh, region, before) < before &&
                      context.distance.distance() < before &&
                      context.distance.change_is_within(context.final_limit, kClose);
  if (!nearer) {
    context.distance.rollback();
    return false;
  }
  commit(context, attempt);
  return true;
}

}  // namespace hexweft
