#include "simplify/feature_targets.h"

#include <algorithm>

namespace hexweft {
namespace {

// What the members of a group stand for together.
struct GroupFeature {
  int corner = -1, line = -1;
  Eigen::Vector3d on_line = Eigen::Vector3d::Zero();  // sum of the members on the line
  int n_on_line = 0;
  bool in_conflict = false;

  void take(const FeatureLabel& label, const Eigen::Vector3d& point) {
    if (label.is_corner()) {
      in_conflict |= corner >= 0 && corner != label.corner;
      corner = label.corner;
    } else if (label.is_line()) {
      in_conflict |= line >= 0 && line != label.line;
      line = label.line;
      on_line += point;
      ++n_on_line;
    }
  }
};

bool ends_at(const FeatureCurves& curves, int line, int corner) {
  return curves.ends(line)[0] == corner || curves.ends(line)[1] == corner;
}

}  // namespace

std::optional<std::vector<Eigen::Vector3d>> feature_targets(const HexMesh& mesh,
                                                            const SingularityGraph& graph,
                                                            const CollapsePlan& plan,
                                                            std::span<const FeatureLabel> labels,
                                                            const FeatureCurves& curves) {
  std::vector<Eigen::Vector3d> targets = default_targets(mesh, graph, plan);
  for (int g = 0; g < plan.n_groups(); ++g) {
    GroupFeature f;
    for (VertexHandle v : plan.group(g)) f.take(labels[v.idx], mesh.point(v));
    if (f.corner >= 0 && f.line >= 0) f.in_conflict |= !ends_at(curves, f.line, f.corner);
    if (f.in_conflict) return std::nullopt;
    if (f.corner >= 0) {
      targets[g] = curves.corner(f.corner);
    } else if (f.line >= 0) {
      targets[g] = curves.closest(f.on_line / f.n_on_line, f.line).point;
    }
  }
  return targets;
}

std::vector<char> base_edges_on_features(const BaseComplex& bc,
                                         std::span<const FeatureLabel> labels) {
  const auto off_line = [&](VertexHandle a, VertexHandle b) {
    const FeatureLabel &x = labels[a.idx], &y = labels[b.idx];
    const bool either_is_corner = x.is_corner() || y.is_corner();
    return !x.is_any() || !y.is_any() || (!either_is_corner && x.line != y.line);
  };
  std::vector<char> result(bc.edges.size(), 0);
  for (std::size_t i = 0; i < bc.edges.size(); ++i) {
    const auto chain = bc.chain(bc.edges[i]);
    result[i] = bc.edges[i].boundary &&
                std::adjacent_find(chain.begin(), chain.end(), off_line) == chain.end();
  }
  return result;
}

}  // namespace hexweft
