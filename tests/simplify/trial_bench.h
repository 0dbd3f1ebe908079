/// \file
/// A mesh with all that a trial needs.
#pragma once

#include <utility>

#include "simplify/trial.h"

namespace hexweft {

struct TrialBench {
  explicit TrialBench(HexMesh m, double limit_rel = 0.01, FeatureMode features = FeatureMode::off)
      : mesh(std::move(m)),
        reference(make_reference_surface(mesh, 40, {.mode = features})),
        distance(mesh, reference),
        context{mesh,
                reference,
                distance,
                summarize_topology(mesh),
                limit_rel * reference.bounding_box_diagonal(),
                limit_rel * reference.bounding_box_diagonal()},
        bc(extract_base_complex(mesh)) {}
  HexMesh mesh;
  ReferenceSurface reference;
  SurfaceDistance distance;
  TrialContext context;
  BaseComplex bc;  ///< of the mesh as it was at first
};

}  // namespace hexweft
