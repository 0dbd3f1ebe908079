#include "simplify/options.h"

#include <string>

#include <fmt/format.h>

#include "ovm/errors.h"

namespace hexweft {
namespace {

template <class T>
void expect(bool holds, const char* name, T value, const char* expected) {
  if (!holds) throw InputError(fmt::format("{} = {}, expected {}", name, value, expected));
}

}  // namespace

void validate(const SimplifyOptions& o) {
  const auto expect_floor = [](const char* name, double value) {
    expect(value >= 0 && value < 1, name, value, "[0, 1)");
  };
  expect(o.hausdorff_limit_rel > 0 && o.hausdorff_limit_rel <= 1, "hausdorff_limit_rel",
         o.hausdorff_limit_rel, "(0, 1]");
  expect_floor("min_scaled_jacobian", o.min_scaled_jacobian);
  expect_floor("mean_scaled_jacobian", o.mean_scaled_jacobian);
  expect_floor("careful.min_scaled_jacobian", o.careful.min_scaled_jacobian);
  expect_floor("careful.mean_scaled_jacobian", o.careful.mean_scaled_jacobian);
  const auto expect_angle = [](const char* name, double angle) {
    expect(angle > 0 && angle <= 360, name, angle, "(0, 360]");
  };
  expect_angle("valence.max_angle_deg", o.valence.max_angle_deg);
  expect_angle("bold.max_angle_deg", o.bold.max_angle_deg);
  expect(o.target_hexahedra_rel > 0 && o.target_hexahedra_rel <= 1000, "target_hexahedra_rel",
         o.target_hexahedra_rel, "(0, 1000]");
  expect(o.threads > 0, "threads", o.threads, "> 0");
  expect(o.attempts > 0, "attempts", o.attempts, "> 0");
  expect(o.attempts == 1 || !o.checkpoint, "attempts", o.attempts, "1 where checkpoints are kept");
  expect(o.compare > 0, "compare", o.compare, "> 0");
  expect(o.splits_per_trial >= 0, "splits_per_trial", o.splits_per_trial, ">= 0");
  expect(o.bold.max_interior_valence > 2, "bold.max_interior_valence", o.bold.max_interior_valence,
         "> 2");
  expect(o.bold.splits_per_trial >= 0, "bold.splits_per_trial", o.bold.splits_per_trial, ">= 0");
  expect(o.rings > 0, "rings", o.rings, "> 0");
  expect(o.smoothing_trials >= 0, "smoothing_trials", o.smoothing_trials, ">= 0");
  expect(o.give_up_factor >= 1, "give_up_factor", o.give_up_factor, ">= 1");
  expect(o.merged_give_up_factor >= 1, "merged_give_up_factor", o.merged_give_up_factor, ">= 1");
  expect(o.bold.merged_give_up_factor >= 1, "bold.merged_give_up_factor",
         o.bold.merged_give_up_factor, ">= 1");
  expect(o.max_chord_deviation > 0, "max_chord_deviation", o.max_chord_deviation, "> 0");
  expect(o.bold.max_chord_deviation > 0, "bold.max_chord_deviation", o.bold.max_chord_deviation,
         "> 0");
  expect(o.max_failed_trials > 0, "max_failed_trials", o.max_failed_trials, "> 0");
  if (o.target_rate) {
    expect(*o.target_rate >= 0 && *o.target_rate <= 1, "target_rate", *o.target_rate, "[0, 1]");
  }
  if (o.target_components) {
    expect(*o.target_components > 0, "target_components", *o.target_components, "> 0");
  }
  if (o.max_seconds) expect(*o.max_seconds > 0, "max_seconds", *o.max_seconds, "> 0");
  expect(o.checkpoint_every_s >= 0, "checkpoint_every_s", o.checkpoint_every_s, ">= 0");
  validate(o.weights);
  validate(o.features);
  validate(o.parametrization);
}

}  // namespace hexweft
