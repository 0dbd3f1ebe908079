#include "simplify/region_relaxation.h"

#include <algorithm>
#include <iterator>

#include "optimize/hex_energy.h"
#include "ovm/detail/sort_unique.h"
#include "ovm/dual.h"
#include "ovm/edit/split_sheet.h"
#include "ovm/neighborhood.h"
#include "ovm/quality.h"
#include "simplify/surface_check.h"

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
  const auto edges = mesh.edges(side);
  return *std::max_element(edges.begin(), edges.end(), [&](EdgeHandle a, EdgeHandle b) {
    return edge_length(mesh, a) < edge_length(mesh, b);
  });
}

class RegionRelaxation {
  // Of the floors of quality.
  struct Shares {
    double of_least, of_mean;
  };

 public:
  RegionRelaxation(TrialContext& context, const CollapsePlan& plan,
                   std::span<const VertexHandle> merged, std::span<const CellHandle> gone,
                   const Quality& old, const Outlook& outlook, const SimplifyOptions& options)
      : context_(context),
        options_(options),
        merged_distance_(outlook.distance_rel * context.distance_limit),
        width_(plan.width),
        most_cells_(std::max(context.mesh.n_cells() + static_cast<int>(plan.removed.size()),
                             context.most_cells)),
        region_(cells_around(context.mesh, merged, rings_round(plan, options))),
        touched_(region_),
        least_(std::max(std::min(options.min_scaled_jacobian, old.least), 1e-3)),
        mean_(std::min(options.mean_scaled_jacobian, old.mean)) {
    touched_.insert(touched_.end(), gone.begin(), gone.end());
  }

  RegionResult run() {
    const Refusal refusal = relax();
    if (refusal == Refusal::none) return {.quality = moved_};
    // Where it failed first: what splits have left elsewhere is not the cause.
    RegionResult failed = {
        refusal, refusal == Refusal::hausdorff ? context_.distance.too_far_at() : worst_cell_};
    if (refusal != Refusal::hausdorff || !is_thorough()) return failed;
    return split_until_near() ? RegionResult{.quality = moved_} : failed;
  }

 private:
  // In two parts, so that what ends far off the surface is given up early.
  Refusal relax() {
    const Refusal early = move_halfway();
    if (early != Refusal::none) return early;
    const double far = options_.give_up_factor * context_.distance_limit;
    const double halfway = is_surely_near() ? merged_distance_ : distance(far);
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

  // Of 780 trials on real meshes that the merge left so near none was too far away halfway, and one
  // that is can still come near in the end.
  bool is_surely_near() const {
    constexpr double kNear = 0.5;
    return merged_distance_ <= kNear * context_.distance_limit;
  }

  // A collapse leaves the cells beside it long, and a long side strays from a curved surface: its
  // sheet is split across, which adds no component, as long as that helps and there is room for
  // the cells.
  bool split_until_near() {
    // Of the limit, after so many splits: what is farther hardly ever comes near with more of them.
    const auto hopeless = [](int splits) { return 1 + 2.2 / (1 + splits * splits); };
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
      if (!split(sheet)) return false;
      const Refusal refusal = relax_after_split();
      if (refusal == Refusal::none) return true;
      if (refusal != Refusal::hausdorff) return false;
    }
    return false;
  }

  // What a split changes is little: quality that is far off now stays so.
  Refusal relax_after_split() {
    const Refusal early = move(1, SurfaceTreatment::project, {0.5, 0.98});
    if (early != Refusal::none) return early;
    return finish(iterations_left(), options_.parametrization.surface.treatment);
  }

  // Ends with a refusal where the floors are so far off that the iterations left are not worth their
  // time. What a thorough trial changes at once may be so much that one iteration says little.
  Refusal move_halfway() {
    const Shares shares = is_thorough() ? Shares{0.3, 0.94} : Shares{0.5, 0.97};
    // Fitting asks for several closest points a quadrilateral; it matters in the end only.
    return move(1, SurfaceTreatment::project, shares);
  }

  int iterations_left() const { return std::max(1, options_.parametrization.max_iterations - 1); }

  // As bold trials are: there are few of them.
  bool is_thorough() const { return options_.splits_per_trial > 0; }

  // What moves stays the same part of space. Elsewhere the parts of a twisted cell may be worse than it
  // was, even inverted.
  // \return whether they keep the floor
  bool split(const DualSheet& sheet) {
    HexMesh& mesh = context_.mesh;
    const auto is_within = [&](CellHandle c) {
      return std::binary_search(region_.begin(), region_.end(), c);
    };
    std::vector<CellHandle> elsewhere;
    for (const CellAxis& x : sheet.crossings) {
      if (!is_within(x.cell)) elsewhere.push_back(x.cell);
    }
    const double floor = std::min(least_, measure_quality(mesh, elsewhere).least);
    const SheetSplit split = split_sheet(mesh, sheet);
    std::vector<CellHandle> region;
    elsewhere.clear();
    for (std::size_t i = 0; i < split.cells.size(); ++i) {
      (is_within(split.parents[i]) ? region : elsewhere).push_back(split.cells[i]);
    }
    if (measure_quality(mesh, elsewhere).least < floor * (1 - 1e-9)) return false;
    std::copy_if(region_.begin(), region_.end(), std::back_inserter(region),
                 [&](CellHandle c) { return mesh.is_live(c); });
    std::sort(region.begin(), region.end());
    region_ = std::move(region);
    parametrization_.reset();
    touched_.insert(touched_.end(), split.removed.begin(), split.removed.end());
    touched_.insert(touched_.end(), split.cells.begin(), split.cells.end());
    detail::sort_unique(touched_);
    return true;
  }

  Refusal move(int iterations, SurfaceTreatment treatment, const Shares& shares = {1, 1}) {
    const StageTimer timer(context_.clock, Stage::parametrization);
    ParametrizationOptions p = trial_parametrization(options_);
    p.max_iterations = iterations;
    p.min_scaled_jacobian = shares.of_least * least_;
    p.surface.treatment = treatment;
    if (!parametrization_) parametrization_.emplace(context_.mesh, region_, context_.reference);
    const ParametrizationReport report = parametrization_->run(context_.mesh, p);
    moved_ = {report.min_scaled_jacobian, report.mean_scaled_jacobian};
    worst_cell_.reset();
    if (!report.valid()) {
      worst_cell_ = place_of_worst_cell();
      return refusal_of(report.failure);
    }
    return report.mean_scaled_jacobian < shares.of_mean * mean_ ? Refusal::quality : Refusal::none;
  }

  Refusal finish(int iterations, SurfaceTreatment treatment) {
    Refusal refusal = move(iterations, treatment);
    // The more a collapse has changed, the longer the quality takes to come back; but what is not near
    // now hardly ever does.
    constexpr Shares kNear = {0.8, 0.99};
    const bool is_near =
        moved_.least > kNear.of_least * least_ && moved_.mean > kNear.of_mean * mean_;
    if (refusal == Refusal::quality && is_thorough() && is_near)
      refusal = move(iterations, treatment);
    if (refusal != Refusal::none) return refusal;
    return stays_on_surface(context_, touched_) ? Refusal::none : Refusal::hausdorff;
  }

  Eigen::Vector3d place_of_worst_cell() const {
    const HexMesh& mesh = context_.mesh;
    const std::vector<double> sj = scaled_jacobians(mesh, region_);
    const CellHandle worst = region_[std::min_element(sj.begin(), sj.end()) - sj.begin()];
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (VertexHandle v : mesh.vertices(worst)) sum += mesh.point(v);
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
  double merged_distance_;                                // before anything moved, model units
  int width_;                                             // of what was collapsed, layers
  int most_cells_;                                        // that the mesh may have
  std::vector<CellHandle> region_;                        // moves
  std::optional<RegionParametrization> parametrization_;  // of the region
  std::vector<CellHandle> touched_;                       // moved, or gone
  double least_, mean_;                                   // floors of the scaled Jacobian
  Quality moved_;                                         // of the region, after the last move
  std::optional<Eigen::Vector3d> worst_cell_;  // where the last move left it below the floor
};

}  // namespace

ParametrizationOptions trial_parametrization(const SimplifyOptions& options) {
  constexpr int kUntanglingRounds = 2;
  ParametrizationOptions p = options.parametrization;
  p.untangling_rounds = std::min(p.untangling_rounds, kUntanglingRounds);
  p.untangle_widely = false;
  return p;
}

// Still more for more layers gave no better results.
int rings_round(const CollapsePlan& plan, const SimplifyOptions& options) {
  constexpr int kMoreForLayers = 2;
  return options.rings + (plan.width > 1 ? kMoreForLayers : 0);
}

RegionResult relax_region(TrialContext& context, const CollapsePlan& plan,
                          std::span<const VertexHandle> merged, std::span<const CellHandle> gone,
                          const Quality& old, const Outlook& outlook,
                          const SimplifyOptions& options) {
  return RegionRelaxation(context, plan, merged, gone, old, outlook, options).run();
}

}  // namespace hexweft
