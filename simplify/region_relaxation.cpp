#include "simplify/region_relaxation.h"

#include <algorithm>

#include "ovm/dual.h"
#include "ovm/edit/split_sheet.h"
#include "ovm/quality.h"

namespace hexweft {
namespace {

Refusal refusal_of(ParametrizationFailure failure) {
  switch (failure) {
    case ParametrizationFailure::none:
      return Refusal::none;
    case ParametrizationFailure::still_inverted:
      return Refusal::inverted;
    case ParametrizationFailure::low_quality:
      return Refusal::quality;
  }
  return Refusal::inverted;
}

EdgeHandle longest_edge(const HexMesh& mesh, HalfFaceHandle side) {
  const auto length = [&](EdgeHandle e) {
    const auto [a, b] = mesh.vertices(e);
    return (mesh.point(a) - mesh.point(b)).norm();
  };
  const auto edges = mesh.edges(side);
  return *std::max_element(edges.begin(), edges.end(),
                           [&](EdgeHandle a, EdgeHandle b) { return length(a) < length(b); });
}

class RegionRelaxation {
 public:
  RegionRelaxation(TrialContext& context, const CollapsePlan& plan,
                   std::span<const VertexHandle> merged, const Quality& old,
                   const SimplifyOptions& options)
      : context_(context),
        options_(options),
        width_(plan.width),
        most_cells_(std::max(context.mesh.n_cells() + static_cast<int>(plan.removed.size()),
                             context.most_cells)),
        seeds_(merged.begin(), merged.end()),
        region_(cells_around(context.mesh, merged, rings_round(plan, options))),
        touched_(region_),
        least_(std::max(std::min(options.min_scaled_jacobian, old.least), 1e-3)),
        mean_(std::min(options.mean_scaled_jacobian, old.mean)) {
    touched_.insert(touched_.end(), plan.removed.begin(), plan.removed.end());
  }

  RegionResult run() {
    const Refusal refusal = relax();
    if (refusal == Refusal::none) return {};
    // Where it failed first: what splits have left elsewhere is not the cause.
    RegionResult failed = {
        refusal, refusal == Refusal::hausdorff ? context_.distance.too_far_at() : worst_cell_};
    if (refusal != Refusal::hausdorff || !is_thorough()) return failed;
    return split_until_near() ? RegionResult{} : failed;
  }

 private:
  // In two parts, so that what ends far off the surface is given up early.
  Refusal relax() {
    const Refusal early = move_halfway();
    if (early != Refusal::none) return early;
    const double far = options_.give_up_factor * context_.distance_limit;
    const double halfway = distance(far);
    if (halfway > far) return Refusal::hausdorff;
    const SurfaceTreatment wanted = options_.parametrization.surface.treatment;
    Transaction second(context_.mesh);
    const Refusal refusal = finish(iterations_left(), wanted);
    const bool was_near = refusal == Refusal::hausdorff && halfway <= context_.distance_limit;
    if (!was_near || wanted == SurfaceTreatment::project) {
      second.commit();
      return refusal;
    }
    // Where sharp edges run across the quadrilaterals, fitting them does harm.
    second.rollback();
    return finish(iterations_left(), SurfaceTreatment::project);
  }

  // A collapse leaves the cells beside it long, and a long side strays from a curved surface: its
  // sheet is split across, which adds no component, as long as that helps and there is room for
  // the cells.
  bool split_until_near() {
    // Of the limit, after so many splits: what is farther hardly ever comes near with more of them.
    const auto hopeless = [](int splits) { return 1 + 3.0 / (1 + splits * splits); };
    constexpr int kSlow = 3;  // splits that need not help at once
    HexMesh& mesh = context_.mesh;
    double last = 0;  // distance, before the last split
    const int most = std::min(options_.splits_per_trial, 2 * width_ + 2);
    for (int i = 0; i < most; ++i) {
      const auto [side, d] = farthest();
      if (d > hopeless(i) * context_.distance_limit || (i >= kSlow && d > last)) return false;
      last = d;
      const DualSheet sheet = dual_sheet(mesh, longest_edge(mesh, side));
      if (mesh.n_cells() + static_cast<int>(sheet.crossings.size()) > most_cells_) return false;
      split(sheet);
      const Refusal refusal = relax_after_split();
      if (refusal == Refusal::none) return true;
      if (refusal != Refusal::hausdorff) return false;
    }
    return false;
  }

  Refusal relax_after_split() {
    const Refusal early = move_halfway();
    if (early != Refusal::none) return early;
    return finish(iterations_left(), options_.parametrization.surface.treatment);
  }

  // Ends with a refusal where the floors are so far off that the iterations left are not worth their
  // time. What a thorough trial changes at once may be so much that one iteration says little.
  Refusal move_halfway() {
    const double share = is_thorough() ? 0.3 : 0.5, share_of_mean = is_thorough() ? 0.94 : 0.97;
    // Fitting asks for several closest points a quadrilateral; it matters in the end only.
    return move(1, SurfaceTreatment::project, share, share_of_mean);
  }

  int iterations_left() const { return std::max(1, options_.parametrization.max_iterations - 1); }

  // As bold trials are: there are few of them.
  bool is_thorough() const { return options_.splits_per_trial > 0; }

  void split(const DualSheet& sheet) {
    const SheetSplit split = split_sheet(context_.mesh, sheet);
    for (const SplitVertex& v : split.vertices) seeds_.push_back(v.vertex);
    region_ = cells_around(context_.mesh, seeds_, options_.rings);
    touched_.insert(touched_.end(), split.removed.begin(), split.removed.end());
    touched_.insert(touched_.end(), region_.begin(), region_.end());
    std::sort(touched_.begin(), touched_.end());
    touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
  }

  Refusal move(int iterations, SurfaceTreatment treatment, double share_of_least,
               double share_of_mean) {
    const StageTimer timer(context_.clock, Stage::parametrization);
    ParametrizationOptions p = options_.parametrization;
    p.max_iterations = iterations;
    p.min_scaled_jacobian = share_of_least * least_;
    p.surface.treatment = treatment;
    p.untangle_widely = false;  // as good as never helps
    const ParametrizationReport report = parametrize(context_.mesh, region_, context_.reference, p);
    worst_cell_.reset();
    if (!report.valid()) {
      worst_cell_ = place_of_worst_cell();
      return refusal_of(report.failure);
    }
    return report.mean_scaled_jacobian < share_of_mean * mean_ ? Refusal::quality : Refusal::none;
  }

  Refusal finish(int iterations, SurfaceTreatment treatment) {
    Refusal refusal = move(iterations, treatment, 1, 1);
    // The more a collapse has changed, the longer the quality takes to come back.
    if (refusal == Refusal::quality && is_thorough()) refusal = move(iterations, treatment, 1, 1);
    if (refusal != Refusal::none) return refusal;
    return stays_on_surface(context_, touched_) ? Refusal::none : Refusal::hausdorff;
  }

  Eigen::Vector3d place_of_worst_cell() const {
    const HexMesh& mesh = context_.mesh;
    const auto worst =
        std::min_element(region_.begin(), region_.end(), [&](CellHandle a, CellHandle b) {
          return scaled_jacobian(mesh, a) < scaled_jacobian(mesh, b);
        });
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (VertexHandle v : mesh.vertices(*worst)) sum += mesh.point(v);
    return sum / 8;
  }

  double distance(double limit) {
    const StageTimer timer(context_.clock, Stage::distance);
    const double d = context_.distance.after_change(context_.mesh, touched_, limit);
    context_.distance.rollback();
    return d;
  }

  std::pair<HalfFaceHandle, double> farthest() {
    const StageTimer timer(context_.clock, Stage::distance);
    context_.distance.after_change(context_.mesh, touched_);
    const auto found = farthest_side(context_.distance);
    context_.distance.rollback();
    return found;
  }

  TrialContext& context_;
  const SimplifyOptions& options_;
  int width_;                                  // of what was collapsed, layers
  int most_cells_;                             // that the mesh may have
  std::vector<VertexHandle> seeds_;            // of the region
  std::vector<CellHandle> region_;             // moves
  std::vector<CellHandle> touched_;            // moved, or gone
  double least_, mean_;                        // floors of the scaled Jacobian
  std::optional<Eigen::Vector3d> worst_cell_;  // where the last move left it below the floor
};

}  // namespace

// More rings for more layers meant the whole mesh for some, and no better results.
int rings_round(const CollapsePlan& plan, const SimplifyOptions& options) {
  return options.rings * std::min(plan.width, 2);
}

RegionResult relax_region(TrialContext& context, const CollapsePlan& plan,
                          std::span<const VertexHandle> merged, const Quality& old,
                          const SimplifyOptions& options) {
  return RegionRelaxation(context, plan, merged, old, options).run();
}

}  // namespace hexweft
