#include "core/gait/rate_costs.h"

#include <algorithm>
#include <variant>

namespace rollgait {

bool HasRates(const GaitSpec& spec) {
  return std::any_of(spec.costs.begin(), spec.costs.end(), [](const GaitSpec::CostTerm& cost) {
    return std::holds_alternative<GaitRequest::SquaredTorqueRate>(cost.term) ||
           std::holds_alternative<GaitRequest::SquaredForceRate>(cost.term);
  });
}

}  // namespace rollgait
