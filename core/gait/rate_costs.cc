#include "core/gait/rate_costs.h"

#include <algorithm>

namespace rollgait {

bool HasRates(const GaitSpec& spec) {
  return std::any_of(spec.costs.begin(), spec.costs.end(),
                     [](const GaitSpec::CostTerm& cost) { return TraitsOf(cost.term).is_rate; });
}

}  // namespace rollgait
