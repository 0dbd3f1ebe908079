#include "simplify/trial_context.h"

namespace hexweft {

const std::vector<FeatureLabel>& TrialContext::feature_labels() {
  if (!labels) labels = feature_of(reference, mesh, near_lines);
  return *labels;
}

void commit(TrialContext& context, Transaction& change) {
  context.distance.commit();
  change.commit();
}

}  // namespace hexweft
