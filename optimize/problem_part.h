/// \file
/// A relaxation of a few vertices of a large problem, at the cost of what lies round them.
#pragma once

#include <span>
#include <vector>

#include "optimize/relaxation.h"

namespace hexweft {

class ProblemPart {
 public:
  /// \param whole  without groups; its points and pulls do not matter yet
  /// \param moves  by vertex, as many as the problem has points; fixed ones stay fixed
  ProblemPart(const RelaxationProblem& whole, std::span<const char> moves);

  int n_hexes() const { return static_cast<int>(hexes_.size()); }

  /// Relaxes the part within the problem it was made from: points, targets and pulls are taken from
  /// there as they are now, and the points written back.
  RelaxationReport relax(RelaxationProblem& whole, const Energy& energy,
                         const RelaxationOptions& options);

 private:
  std::vector<int> hexes_;     // of the whole
  std::vector<int> vertices_;  // of the whole, those that move first
  std::vector<int> local_;     // by vertex of the whole, -1 if not in the part
  RelaxationProblem part_;
};

/// The vertices of these hexahedra and of those within `rings` of them.
/// \return by vertex
std::vector<char> vertices_round(std::span<const HexCorners> hexes, int n_vertices,
                                 std::span<const int> seeds, int rings);

}  // namespace hexweft
