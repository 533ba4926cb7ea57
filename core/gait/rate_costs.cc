#include "core/gait/rate_costs.h"

#include <algorithm>

namespace rollgait {

bool HasRates(const std::vector<GaitSpec::CostTerm>& costs) {
  return std::any_of(costs.begin(), costs.end(),
                     [](const GaitSpec::CostTerm& cost) { return cost.weight > 0 && TraitsOf(cost.term).is_rate; });
}

}  // namespace rollgait
