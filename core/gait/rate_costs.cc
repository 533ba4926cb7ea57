#include "core/gait/rate_costs.h"

#include <algorithm>

namespace rollgait {

namespace {

bool IsRate(const GaitSpec::CostTerm& cost) { return cost.weight > 0 && TraitsOf(cost.term).is_rate; }

}  // namespace

bool HasRates(const std::vector<GaitSpec::CostTerm>& costs) { return std::any_of(costs.begin(), costs.end(), IsRate); }

std::string NamesOfRates(const std::vector<GaitSpec::CostTerm>& costs) {
  std::string names;
  for (const GaitSpec::CostTerm& cost : costs) {
    if (IsRate(cost)) names.append(names.empty() ? "" : " and ").append(TraitsOf(cost.term).field);
  }
  return names;
}

}  // namespace rollgait
