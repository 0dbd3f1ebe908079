#include "simplify/simplify.h"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include "optimize/hausdorff.h"
#include "optimize/smooth.h"
#include "ovm/errors.h"
#include "ovm/quality.h"
#include "ovm/topology_check.h"
#include "simplify/candidates.h"
#include "simplify/refine.h"
#include "simplify/trial.h"

namespace hexweft {
namespace {

using Clock = std::chrono::steady_clock;

void check_input(const HexMesh& mesh) {
  for (const TopologyViolation& v : check_topology(mesh)) {
    if (severity(v.defect) == Severity::invalid)
      throw InputError("the mesh is not valid: " + v.message);
  }
  if (mesh.n_cells() == 0) throw InputError("the mesh has no cells");
  for (CellHandle c : mesh.cells()) {
    const double sj = scaled_jacobian(mesh, c);
    if (!(sj > 0)) {
      throw InputError(fmt::format("cell {} has scaled Jacobian {:.4g}, expected > 0", c.idx, sj));
    }
  }
}

// Normals are averaged across edges less sharp than this; it has no say in what is a feature line.
constexpr double kNormalAngle = 40;
// The loop samples the surface less densely than the last check: it keeps this share of the limit.
constexpr double kLoopShare = 0.95;
// Below this share of the wanted count of cells sheets that are as long across as the mean edge are
// split, a few at a time: with too few cells nothing stays on the surface, but every one costs time.
constexpr double kRefineBelow = 0.9;
constexpr double kLongAcross = 1.0;
constexpr int kSplitsAtOnce = 5;
// Up to this share sheets are split when nothing else goes on.
constexpr double kMostCells = 1.1;
// A verified copy of the mesh is kept whenever the components have fallen by this factor.
constexpr double kVerifyEvery = 0.5;

// One run: the mesh, what belongs to it, and the state of the loop.
class Run {
 public:
  Run(HexMesh& mesh, const SimplifyOptions& options)
      : mesh_(mesh),
        options_(options),
        start_(Clock::now()),
        reference_(make_reference_surface(mesh, kNormalAngle, options.features)),
        distance_(mesh, reference_),
        context_{mesh,
                 reference_,
                 distance_,
                 summarize_topology(mesh),
                 kLoopShare * options.hausdorff_limit_rel * reference_.bounding_box_diagonal(),
                 options.hausdorff_limit_rel * reference_.bounding_box_diagonal(),
                 options.threads > 1},
        bc_(extract_base_complex(mesh)) {
    if (bc_.irregular > 0) {
      throw InputError(fmt::format("{} regions of the base complex are no cuboids", bc_.irregular));
    }
    report_.before = measure_mesh(mesh);
    verified_ = mesh;
    verified_components_ = report_.before.components;
  }

  SimplifyReport run() {
    // Splitting a sheet comes before a second look at what failed lately: it gives that more room.
    const double long_enough = RefineOptions().min_length_rel;
    while (!should_stop()) {
      for (int i = 0; i < kSplitsAtOnce && is_short_of_cells(kRefineBelow); ++i) {
        if (!refine(kLongAcross)) break;
      }
      if (!collapse_one(true) && !refine(long_enough, kMostCells) && !collapse_one(false)) break;
    }
    if (report_.stopped != StopReason::interrupted) {
      while (is_short_of_cells(kRefineBelow) && refine(0)) {
      }
    }
    finish();
    return report_;
  }

 private:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  bool should_stop() {
    const auto components = static_cast<int>(bc_.components.size());
    const double rate = 1 - static_cast<double>(components) / report_.before.components;
    if (options_.stop.stop_requested()) {
      report_.stopped = StopReason::interrupted;
    } else if (options_.max_seconds && seconds() >= *options_.max_seconds) {
      report_.stopped = StopReason::out_of_time;
    } else if ((options_.target_rate && rate >= *options_.target_rate) ||
               (options_.target_components && components <= *options_.target_components)) {
      report_.stopped = StopReason::target_reached;
    } else if (failed_in_a_row_ >= options_.max_failed_trials) {
      report_.stopped = StopReason::no_progress;
    } else {
      return false;
    }
    return true;
  }

  // Tries candidates in order until one is accepted. A patient round leaves out what failed lately.
  bool collapse_one(bool patient) {
    const CandidateQueues q = make_queues(mesh_, bc_, options_, options_.ranking);
    return collapse_sheet(q, patient) || collapse_chord(q, patient);
  }

  bool collapse_sheet(const CandidateQueues& q, bool patient) {
    for (const Candidate& c : q.sheet_queue) {
      if (should_stop()) return true;
      if (attempt(plan_sheet_collapse(mesh_, bc_, q.sheets[c.index]), report_.sheets, patient))
        return true;
    }
    return false;
  }

  bool collapse_chord(const CandidateQueues& q, bool patient) {
    for (const Candidate& c : q.chord_queue) {
      if (should_stop()) return true;
      const CollapsePlan plan = plan_chord_collapse(mesh_, bc_, q.chords[c.index],
                                                    q.chord_terms[c.index].diagonal, q.sheets);
      if (attempt(plan, report_.chords, patient)) return true;
    }
    return false;
  }

  bool attempt(const CollapsePlan& plan, TrialCounts& counts, bool patient) {
    const std::size_t key = FailureMemory::key(plan);
    if (memory_.should_wait(key, step_, patient)) return false;
    TrialResult result = try_collapse(context_, bc_, plan, options_);
    if (!result.accepted()) {
      ++counts.refused[static_cast<int>(result.refusal)];
      memory_.failed(key, step_);
      failed_in_a_row_ += is_geometric(result.refusal);
      return false;
    }
    ++counts.accepted;
    accept(std::move(result.base_complex));
    return true;
  }

  void accept(BaseComplex bc) {
    bc_ = std::move(bc);
    ++step_;
    failed_in_a_row_ = 0;
    relieve_farthest(context_, options_);
    not_refinable_.clear();
    if (static_cast<double>(bc_.components.size()) <= kVerifyEvery * verified_components_) verify();
    if (mesh_.cell_slots() > 4 * mesh_.n_cells()) compact();
    if (options_.observer) observe();
  }

  void observe() const {
    std::vector<CellHandle> all;
    for (CellHandle c : mesh_.cells()) all.push_back(c);
    const Quality now = measure_quality(mesh_, all);
    options_.observer({step_, mesh_.n_cells(), static_cast<int>(bc_.components.size()),
                       report_.before.components, distance_.ratio(), now.least, now.mean,
                       seconds()});
  }

  bool within_limit() const { return is_within(mesh_, reference_, context_.final_limit); }

  // Keeps a copy that is within the limit at full sampling; where this one is not, keeps more
  // distance.
  void verify() {
    verified_components_ = static_cast<int>(bc_.components.size());
    if (within_limit()) {
      verified_ = mesh_;
    } else {
      context_.distance_limit *= 0.95;
    }
  }

  // Handles change: what is known by handle is made anew.
  void compact() {
    mesh_.collect_garbage();
    bc_ = extract_base_complex(mesh_);
    distance_ = SurfaceDistance(mesh_, reference_);
    memory_.forget_all();
  }

  void finish() {
    if (!within_limit()) mesh_ = verified_;
    if (options_.smooth && report_.stopped != StopReason::interrupted) {
      const SmoothingOptions smoothing = {.hausdorff_limit_rel = options_.hausdorff_limit_rel,
                                          .local_trials = options_.smoothing_trials,
                                          .parametrization = options_.parametrization};
      report_.hausdorff_ratio = smooth(mesh_, reference_, smoothing).hausdorff_rel;
    } else {
      report_.hausdorff_ratio = hausdorff_distance(mesh_, reference_).ratio();
    }
    mesh_.collect_garbage();
    report_.after = measure_mesh(mesh_);
    report_.seconds = seconds();
  }

  bool is_short_of_cells(double share) const {
    return mesh_.n_cells() < share * options_.target_hexahedra_rel * report_.before.hexahedra;
  }

  // Splits one sheet if there is room for it.
  bool refine(double min_length_rel, double most_cells_rel = 1) {
    RefineOptions refine;
    refine.min_length_rel = min_length_rel;
    const double target = options_.target_hexahedra_rel * report_.before.hexahedra;
    refine.max_cells = static_cast<int>(
        std::max(1.5 * (target - mesh_.n_cells()), most_cells_rel * target - mesh_.n_cells()));
    constexpr int kTries = 4;  // what makes one split fail holds for most others
    for (int i = 0; i < kTries; ++i) {
      const auto sheet = choose_sheet_to_refine(mesh_, distance_, refine, not_refinable_);
      if (!sheet) break;
      if (try_refine(context_, *sheet, options_)) {
        ++report_.refined;
        not_refinable_.clear();
        bc_ = extract_base_complex(mesh_);
        ++step_;
        return true;
      }
      ++report_.refinement_failed;
      not_refinable_.push_back(sheet->edges.front());
    }
    return false;
  }

  HexMesh& mesh_;
  const SimplifyOptions& options_;
  Clock::time_point start_;
  ReferenceSurface reference_;
  SurfaceDistance distance_;
  TrialContext context_;
  BaseComplex bc_;
  FailureMemory memory_;
  std::vector<EdgeHandle> not_refinable_;  // lowest edges of sheets whose split failed on this mesh
  SimplifyReport report_;
  HexMesh verified_;  // the last mesh within the limit at full sampling
  int verified_components_ = 0;
  int step_ = 0;
  int failed_in_a_row_ = 0;  // trials that came as far as the geometry, since the last accepted one
};

}  // namespace

SimplifyReport simplify(HexMesh& mesh, const SimplifyOptions& options) {
  validate(options);
  check_input(mesh);
  return Run(mesh, options).run();
}

}  // namespace hexweft
