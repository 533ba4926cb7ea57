#include "core/ocp/cost_description.h"

namespace rollgait {

double TrackingCost::Typical() const {
  // A reference is met to about 0.1 rad.
  double sum = 0;
  for (const Channel& channel : channels) sum += channel.weight;
  return 0.01 * sum;
}

double CostDescription::Typical() const {
  if (const PointCost* point = integrand()) return point->Typical();
  if (const auto* rate = std::get_if<RateCost>(&term)) return rate->Typical();
  return std::get<TrackingCost>(term).Typical();
}

}  // namespace rollgait
