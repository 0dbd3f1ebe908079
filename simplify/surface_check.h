/// \file
/// Whether a change of the mesh stays on the surface, and relief where the mesh is close to the limit.
#pragma once

#include <span>
#include <utility>

#include "simplify/options.h"
#include "simplify/trial_context.h"

namespace hexweft {

/// Brings the distance up to the mesh after a change of these cells, dead or alive, and checks it
/// against the limits; where it is close, at full sampling of what changed. Over one, the distance is rolled back.
bool stays_on_surface(TrialContext& context, std::span<const CellHandle> touched);

/// The boundary side that is farthest from the surface or has the farthest sample of it nearest, and
/// how far that is, model units.
std::pair<HalfFaceHandle, double> farthest_side(const SurfaceDistance& distance);

/// Relaxes round the place farthest from the surface if that is close to the limit: later trials there
/// would fail for it, whatever they do. Kept only if it brings the distance down.
/// \return whether it did
bool relieve_farthest(TrialContext& context, const SimplifyOptions& options);

}  // namespace hexweft
