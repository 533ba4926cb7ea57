#include "core/ocp/costs/tracking_cost.h"

namespace rollgait::cost {

CostIntegral Make(const Tracking& term, const CostContext& context) {
  TrackingCost tracking;
  for (const Tracking::Channel& channel : term.channels) {
    const int joint = context.problem.model.Find(channel.joint);
    ROLLGAIT_CHECK(joint >= 0);
    tracking.channels.push_back({joint, channel.weight.value(), CubicSpline(channel.positions)});
  }
  return tracking;
}

}  // namespace rollgait::cost
