#include "simplify/attempts.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <exception>
#include <mutex>
#include <optional>
#include <random>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include "simplify/detail/run.h"

namespace hexweft {
namespace {

bool reached_target(const SimplifyReport& r) { return r.stopped == StopReason::target_reached; }

bool is_better(const SimplifyReport& a, const SimplifyReport& b) {
  const auto rank = [](const SimplifyReport& r) {
    const bool reached = reached_target(r);  // of those the first
    return std::tuple(!reached, reached ? 0 : r.after.components,
                      reached ? 0 : -r.after.mean_scaled_jacobian, r.attempt);
  };
  return rank(a) < rank(b);
}

class Attempts {
 public:
  using Clock = std::chrono::steady_clock;
  Attempts(const HexMesh& mesh, const ReferenceSurface& reference, const SimplifyOptions& options,
           Clock::time_point start)
      : mesh_(mesh), reference_(reference), options_(options), start_(start) {}

  Outcome run() {
    {
      std::vector<std::jthread> workers;
      for (int i = 1; i < std::min(options_.threads, options_.attempts); ++i)
        workers.emplace_back([this] { work(); });
      work();
    }
    if (problem_) std::rethrow_exception(problem_);
    SimplifyReport& report = best_->report;
    std::sort(done_.begin(), done_.end(), [](const AttemptFigures& a, const AttemptFigures& b) {
      return a.attempt < b.attempt;
    });
    report.attempts = std::move(done_);
    report.seconds = seconds();
    // A later attempt that is cut short takes nothing from one that has all that was asked for.
    if (cut_short_ && !reached_target(report)) report.stopped = *cut_short_;
    return std::move(*best_);
  }

 private:
  void work() {
    for (int i = next_++; i < options_.attempts; i = next_++) {
      try {
        if (may_begin(i)) take(attempt(i));
      } catch (...) {
        const std::lock_guard lock(mutex_);
        if (!problem_) problem_ = std::current_exception();
        return;
      }
    }
  }

  bool may_begin(int i) {
    const std::lock_guard lock(mutex_);
    if (problem_ || (best_ && reached_target(best_->report) && best_->report.attempt < i))
      return false;
    if (i == 0) return true;
    if (options_.stop.stop_requested()) {
      cut_short_ = StopReason::interrupted;
    } else if (options_.max_seconds && seconds() >= *options_.max_seconds) {
      cut_short_ = StopReason::out_of_time;
    } else {
      return true;
    }
    return false;
  }

  Outcome attempt(int i) {
    SimplifyOptions options = options_;
    options.weights = weights_of_attempt(options.weights, i);
    options.threads = 1;
    if (options.max_seconds) options.max_seconds = std::max(1e-3, *options.max_seconds - seconds());
    if (options.observer) {
      options.observer = [this, i](SimplifyProgress p) {
        const std::lock_guard lock(observer_mutex_);
        p.attempt = i;
        options_.observer(p);
      };
    }
    Outcome outcome = {mesh_, {}};
    outcome.report = detail::Run(outcome.mesh, reference_, options).run();
    outcome.report.attempt = i;
    return outcome;
  }

  void take(Outcome outcome) {
    const std::lock_guard lock(mutex_);
    const SimplifyReport& r = outcome.report;
    done_.push_back({r.attempt, r.after.components, r.after.min_scaled_jacobian,
                     r.after.mean_scaled_jacobian, r.seconds});
    if (r.stopped == StopReason::interrupted || r.stopped == StopReason::out_of_time)
      cut_short_ = r.stopped;
    if (!best_ || is_better(r, best_->report)) best_ = std::move(outcome);
  }

  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  const HexMesh& mesh_;
  const ReferenceSurface& reference_;
  const SimplifyOptions& options_;
  Clock::time_point start_;
  std::atomic<int> next_ = 0;
  std::mutex mutex_, observer_mutex_;
  std::optional<Outcome> best_;
  std::vector<AttemptFigures> done_;
  std::optional<StopReason> cut_short_;
  std::exception_ptr problem_;
};

}  // namespace

RankingWeights weights_of_attempt(const RankingWeights& weights, int attempt) {
  if (attempt == 0) return weights;
  std::mt19937 random(static_cast<unsigned>(attempt));
  RankingWeights w = weights;
  for (double* x :
       {&w.k_valence, &w.k_width, &w.k_distortion, &w.beta, &w.min_width, &w.mean_width}) {
    const double unit = static_cast<double>(random()) / std::mt19937::max();
    *x *= std::pow(1.5, 2 * unit - 1);
  }
  return w;
}

Outcome best_of_attempts(const HexMesh& mesh, const ReferenceSurface& reference,
                         const SimplifyOptions& options,
                         std::chrono::steady_clock::time_point start) {
  return Attempts(mesh, reference, options, start).run();
}

}  // namespace hexweft
