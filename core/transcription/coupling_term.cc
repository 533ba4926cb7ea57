#include "core/transcription/coupling_term.h"

#include <algorithm>

#include "core/transcription/consecutive_points.h"
#include "core/transcription/tracking_term.h"

namespace rollgait {

void CouplingTerm::SetUnknowns(std::vector<int> unknowns) {
  std::sort(unknowns.begin(), unknowns.end());
  unknowns.erase(std::unique(unknowns.begin(), unknowns.end()), unknowns.end());
  unknowns_ = std::move(unknowns);
}

std::unique_ptr<CouplingTerm> MakeCouplingTerm(const OptimalControlProblem& problem, const CostDescription& cost,
                                               const DecisionLayout& layout, const EliminatedScheme& scheme) {
  struct Maker {
    const OptimalControlProblem& problem;
    const DecisionLayout& layout;
    const EliminatedScheme& scheme;
    using Term = std::unique_ptr<CouplingTerm>;
    Term operator()(const std::unique_ptr<PointCost>&) const { return nullptr; }
    Term operator()(const RateCost& rate) const {
      return std::make_unique<RateTerm>(layout, RateChanges(rate, problem, layout, scheme.tableau().c));
    }
    Term operator()(const TrackingCost& tracking) const {
      return std::make_unique<TrackingTerm>(tracking, layout, scheme);
    }
  };
  return std::visit(Maker{problem, layout, scheme}, cost.term);
}

}  // namespace rollgait
