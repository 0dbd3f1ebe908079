/// \file
/// What a program needs that changes a mesh in one place only: the surface, the distance and the
/// options by which a change is judged.
#pragma once

#include <optional>
#include <string>

#include "simplify/trial.h"
#include "tools/cli.h"

namespace hexweft::cli {

/// --surface, --features, --hausdorff, --min-scaled-jacobian, --mean-scaled-jacobian, --rings.
struct TrialArguments {
  SimplifyOptions options;
  std::string surface;  ///< empty: the boundary of the input
  std::string features = "auto";
  void add_to(CLI::App& app);
};

/// The mesh with all that a trial needs beside it.
class SingleTrial {
 public:
  /// Reads the INPUT and the surface. \throws InputError if the mesh cannot be worked on
  SingleTrial(Program& program, const TrialArguments& arguments);
  SingleTrial(const SingleTrial&) = delete;
  SingleTrial& operator=(const SingleTrial&) = delete;

  HexMesh& mesh() { return mesh_; }
  const ReferenceSurface& surface() const { return surface_; }
  const SurfaceDistance& distance() const { return distance_; }
  TrialContext& context() { return context_; }

  /// H, components, least and mean scaled Jacobian, inverted, distance ratio at full sampling.
  nlohmann::ordered_json figures() const;

 private:
  HexMesh mesh_;
  ReferenceSurface surface_;
  SurfaceDistance distance_;
  TrialContext context_;
};

/// A table of the figures before and after.
std::string compare(const nlohmann::ordered_json& before, const nlohmann::ordered_json& after);

/// What a refusal means, as the end of a sentence.
std::string explain(Refusal refusal);

}  // namespace hexweft::cli
