#include "optimize/problem_part.h"

#include <algorithm>

namespace hexweft {

ProblemPart::ProblemPart(const RelaxationProblem& whole, std::span<const char> moves)
    : local_(moves.size(), -1) {
  for (int v = 0; v < whole.n_free; ++v) {
    if (!moves[v]) continue;
    local_[v] = static_cast<int>(vertices_.size());
    vertices_.push_back(v);
  }
  part_.n_free = static_cast<int>(vertices_.size());
  const auto is_moved = [&](int v) { return v < whole.n_free && moves[v]; };
  for (int h = 0; h < static_cast<int>(whole.hexes.size()); ++h) {
    HexCorners corners = whole.hexes[h];
    if (std::none_of(corners.begin(), corners.end(), is_moved)) continue;
    for (int& v : corners) {
      if (local_[v] < 0) {
        local_[v] = static_cast<int>(vertices_.size());
        vertices_.push_back(v);
      }
      v = local_[v];
    }
    hexes_.push_back(h);
    part_.hexes.push_back(corners);
  }
}

RelaxationReport ProblemPart::relax(RelaxationProblem& whole, const Energy& energy,
                                    const RelaxationOptions& options) {
  part_.points.resize(3, static_cast<Eigen::Index>(vertices_.size()));
  for (std::size_t i = 0; i < vertices_.size(); ++i)
    part_.points.col(i) = whole.points.col(vertices_[i]);
  part_.targets.clear();
  for (int h : hexes_) part_.targets.push_back(whole.targets[h]);
  part_.pulls.clear();
  for (const VertexPull& pull : whole.pulls) {
    const int v = local_[pull.vertex];
    if (v < 0 || v >= part_.n_free) continue;
    part_.pulls.push_back(pull);
    part_.pulls.back().vertex = v;
  }
  part_.stay_valid = whole.stay_valid;
  const RelaxationReport report = hexweft::relax(part_, energy, options);
  for (int i = 0; i < part_.n_free; ++i) whole.points.col(vertices_[i]) = part_.points.col(i);
  return report;
}

std::vector<char> vertices_round(std::span<const HexCorners> hexes, int n_vertices,
                                 std::span<const int> seeds, int rings) {
  std::vector<char> marked(n_vertices, 0);
  for (int h : seeds) {
    for (int v : hexes[h]) marked[v] = 1;
  }
  for (int ring = 0; ring < rings; ++ring) {
    const std::vector<char> before = marked;
    for (const HexCorners& hex : hexes) {
      if (std::none_of(hex.begin(), hex.end(), [&](int v) { return before[v] != 0; })) continue;
      for (int v : hex) marked[v] = 1;
    }
  }
  return marked;
}

}  // namespace hexweft
