/// \file
/// What every output of the loop must be.
#pragma once

#include <vector>

#include <gmock/gmock.h>

#include "optimize/hausdorff.h"
#include "simplify/simplify.h"
#include "tests/simplify/test_meshes.h"

namespace hexweft {

/// Valid, of the input's genus and parts, near the input; and the report says the truth of it.
inline void expect_good_output(const HexMesh& input, const HexMesh& output,
                               const SimplifyReport& report, double limit_rel = 0.01) {
  EXPECT_THAT(check_topology(output), testing::IsEmpty());
  EXPECT_GT(min_scaled_jacobian(output), 0);
  EXPECT_EQ(output.n_cells(), output.cell_slots());
  EXPECT_EQ(output.n_vertices(), output.vertex_slots());
  const TopologySummary a = summarize_topology(input), b = summarize_topology(output);
  EXPECT_EQ(b.n_parts, a.n_parts);
  EXPECT_EQ(b.genus, a.genus);
  EXPECT_EQ(b.n_boundary_components, a.n_boundary_components);
  EXPECT_EQ(b.euler_characteristic, a.euler_characteristic);
  const ReferenceSurface surface = make_reference_surface(input);
  const double ratio = hausdorff_distance(output, surface).ratio();
  EXPECT_LE(ratio, limit_rel);
  EXPECT_EQ(report.hausdorff_ratio, ratio);
  // Nor is it farther between the points that the loop itself looks at.
  EXPECT_LE(hausdorff_distance(output, surface, {.points_per_triangle = 1000}).ratio(),
            1.01 * limit_rel);

  const BaseComplex before = extract_base_complex(input), after = extract_base_complex(output);
  EXPECT_EQ(after.irregular, 0);
  EXPECT_LE(after.components.size(), before.components.size());
  EXPECT_EQ(report.before.components, static_cast<int>(before.components.size()));
  EXPECT_EQ(report.after.components, static_cast<int>(after.components.size()));
  EXPECT_EQ(report.before.hexahedra, input.n_cells());
  EXPECT_EQ(report.after.hexahedra, output.n_cells());
  EXPECT_EQ(report.after.min_scaled_jacobian, min_scaled_jacobian(output));
}

/// What an observer was told, less the steps that were gone back behind.
inline std::vector<SimplifyProgress> without_taken_back(const std::vector<SimplifyProgress>& told) {
  std::vector<SimplifyProgress> steps;
  for (const SimplifyProgress& p : told) {
    if (p.what == StepKind::back)
      std::erase_if(steps, [&](const SimplifyProgress& earlier) { return earlier.step > p.step; });
    steps.push_back(p);
  }
  return steps;
}

/// Simplifies a copy, of which all that must hold.
inline SimplifyReport simplify_well(const HexMesh& input, const SimplifyOptions& options = {}) {
  HexMesh mesh = input;
  const SimplifyReport report = simplify(mesh, options);
  expect_good_output(input, mesh, report, options.hausdorff_limit_rel);
  if (report.stopped == StopReason::target_reached) {
    const bool has_few =
        options.target_components && report.after.components <= *options.target_components;
    const bool has_rate = options.target_rate && report.rate() >= *options.target_rate;
    EXPECT_TRUE(has_few || has_rate) << report.after.components;
  }
  return report;
}

}  // namespace hexweft
