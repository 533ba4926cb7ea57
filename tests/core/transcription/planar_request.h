#ifndef ROLLGAIT_TESTS_CORE_TRANSCRIPTION_PLANAR_REQUEST_H_
#define ROLLGAIT_TESTS_CORE_TRANSCRIPTION_PLANAR_REQUEST_H_

#include <algorithm>

#include "core/gait/gait_spec.h"

namespace rollgait {

// A planar walk with every kind of row and cost term that the scheme allows, weighted to similar size.
inline GaitRequest PlanarRequestWithEveryTerm(Scheme scheme = Scheme::kRadau2) {
  GaitRequest request;
  request.discretization.scheme = scheme;
  request.body.model = "planar";
  request.slope = 0.1;
  request.motion.speed = 1.3;
  request.motion.duty_factor = GaitRequest::Range{0.55, 0.65};
  request.ground_contact.touch_down_point = GaitRequest::Range{-0.95, -0.2};
  request.ground_contact.lift_off_point = GaitRequest::Range{0.2, 0.95};
  request.costs.push_back({cost::SquaredTorque{{{"hip_l", 2.0}}}, 1.0});
  request.costs.push_back({cost::SquaredTorqueRate{}, 1e-3});
  request.costs.push_back({cost::MechanicalWork{5.0}, 30.0});
  request.costs.push_back({cost::Time{}, 100.0});
  request.costs.push_back(
      {cost::Tracking{{{"hip_l", {0.3, 0.2, -0.1, -0.3}, 2.0}, {"base_z", {0.9, 0.95}, 0.5}}}, 5e4});
  request.costs.push_back({cost::MuscleEffort{3.0, {{"knee_r", 0.5}}}, 5e3});
  request.costs.push_back({cost::MuscleWork{{}, {}, 5.0, {}}, 10.0});
  request.costs.push_back({cost::PassiveLoad{}, 1e4});
  request.costs.push_back({cost::SquaredAcceleration{{{"base_z", 0.5}}}, 0.1});
  request.costs.push_back({cost::SquaredForceRate{}, 1e-3});
  // Of a kind that is not among these, one with its defaults.
  ForEachCost([&request]<typename Term>(const CostRow<Term>&) {
    const bool given = std::any_of(request.costs.begin(), request.costs.end(), [](const GaitRequest::CostTerm& cost) {
      return std::holds_alternative<Term>(cost.term);
    });
    if (!given) request.costs.push_back({Term{}, 1.0});
  });
  if (!HasRatesOfEfforts(scheme)) {
    std::erase_if(request.costs, [](const GaitRequest::CostTerm& cost) { return TraitsOf(cost.term).is_rate; });
  }
  return request;
}

}  // namespace rollgait

#endif  // ROLLGAIT_TESTS_CORE_TRANSCRIPTION_PLANAR_REQUEST_H_
