#include "server/convert/cost_convert.h"

#include "server/convert/field_decoding.h"

namespace rollgait::server {
namespace {

GaitRequest::Tracking DecodeTracking(const v1::CostTerm::Tracking& tracking) {
  GaitRequest::Tracking decoded;
  for (const v1::CostTerm::Tracking::Channel& channel : tracking.channels()) {
    decoded.channels.push_back({channel.joint(),
                                {channel.positions().begin(), channel.positions().end()},
                                ROLLGAIT_OPTIONAL(channel, weight)});
  }
  return decoded;
}

GaitRequest::MuscleWork DecodeMuscleWork(const v1::CostTerm::MuscleWork& work) {
  return {ROLLGAIT_OPTIONAL(work, positive_efficiency), ROLLGAIT_OPTIONAL(work, negative_efficiency),
          ROLLGAIT_OPTIONAL(work, smoothing_w), DecodeNumbers(work.joint_weights())};
}

}  // namespace

GaitRequest::CostTerm DecodeCost(const std::string& field, const v1::CostTerm& cost, Violations* violations) {
  GaitRequest::CostTerm decoded;
  decoded.weight = ROLLGAIT_OPTIONAL(cost, weight);
  switch (cost.term_case()) {
    case v1::CostTerm::kSquaredTorque:
      decoded.term = GaitRequest::SquaredTorque{DecodeNumbers(cost.squared_torque().joint_weights())};
      break;
    case v1::CostTerm::kSquaredTorqueRate:
      decoded.term = GaitRequest::SquaredTorqueRate{DecodeNumbers(cost.squared_torque_rate().joint_weights())};
      break;
    case v1::CostTerm::kMechanicalWork:
      decoded.term = GaitRequest::MechanicalWork{ROLLGAIT_OPTIONAL(cost.mechanical_work(), smoothing_w)};
      break;
    case v1::CostTerm::kTime:
      decoded.term = GaitRequest::Time{};
      break;
    case v1::CostTerm::kTracking:
      decoded.term = DecodeTracking(cost.tracking());
      break;
    case v1::CostTerm::kMuscleEffort:
      decoded.term = GaitRequest::MuscleEffort{ROLLGAIT_OPTIONAL(cost.muscle_effort(), exponent),
                                               DecodeNumbers(cost.muscle_effort().joint_weights())};
      break;
    case v1::CostTerm::kMuscleWork:
      decoded.term = DecodeMuscleWork(cost.muscle_work());
      break;
    case v1::CostTerm::kPassiveLoad:
      decoded.term = GaitRequest::PassiveLoad{DecodeNumbers(cost.passive_load().joint_weights())};
      break;
    case v1::CostTerm::kSquaredAcceleration:
      decoded.term = GaitRequest::SquaredAcceleration{DecodeNumbers(cost.squared_acceleration().joint_weights())};
      break;
    case v1::CostTerm::kSquaredForceRate:
      decoded.term = GaitRequest::SquaredForceRate{};
      break;
    case v1::CostTerm::TERM_NOT_SET:
      violations->push_back({field, "no term; set one, for example squared_torque"});
  }
  return decoded;
}

}  // namespace rollgait::server
