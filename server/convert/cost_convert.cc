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

void EncodeNumbers(const std::map<std::string, double>& numbers, google::protobuf::Map<std::string, double>* encoded) {
  for (const auto& [name, number] : numbers) (*encoded)[name] = number;
}

struct TermEncoder {
  v1::CostTerm& cost;

  void operator()(const GaitRequest::SquaredTorque& term) const {
    EncodeNumbers(term.joint_weights, cost.mutable_squared_torque()->mutable_joint_weights());
  }
  void operator()(const GaitRequest::SquaredTorqueRate& term) const {
    EncodeNumbers(term.joint_weights, cost.mutable_squared_torque_rate()->mutable_joint_weights());
  }
  void operator()(const GaitRequest::SquaredForceRate&) const { cost.mutable_squared_force_rate(); }
  void operator()(const GaitRequest::MechanicalWork& term) const {
    v1::CostTerm::MechanicalWork& work = *cost.mutable_mechanical_work();
    if (term.smoothing) work.set_smoothing_w(*term.smoothing);
  }
  void operator()(const GaitRequest::Time&) const { cost.mutable_time(); }
  void operator()(const GaitRequest::Tracking& term) const {
    v1::CostTerm::Tracking& tracking = *cost.mutable_tracking();
    for (const GaitRequest::Tracking::Channel& channel : term.channels) {
      v1::CostTerm::Tracking::Channel& encoded = *tracking.add_channels();
      encoded.set_joint(channel.joint);
      encoded.mutable_positions()->Add(channel.positions.begin(), channel.positions.end());
      if (channel.weight) encoded.set_weight(*channel.weight);
    }
  }
  void operator()(const GaitRequest::MuscleEffort& term) const {
    v1::CostTerm::MuscleEffort& effort = *cost.mutable_muscle_effort();
    if (term.exponent) effort.set_exponent(*term.exponent);
    EncodeNumbers(term.joint_weights, effort.mutable_joint_weights());
  }
  void operator()(const GaitRequest::MuscleWork& term) const {
    v1::CostTerm::MuscleWork& work = *cost.mutable_muscle_work();
    if (term.positive_efficiency) work.set_positive_efficiency(*term.positive_efficiency);
    if (term.negative_efficiency) work.set_negative_efficiency(*term.negative_efficiency);
    if (term.smoothing) work.set_smoothing_w(*term.smoothing);
    EncodeNumbers(term.joint_weights, work.mutable_joint_weights());
  }
  void operator()(const GaitRequest::PassiveLoad& term) const {
    EncodeNumbers(term.joint_weights, cost.mutable_passive_load()->mutable_joint_weights());
  }
  void operator()(const GaitRequest::SquaredAcceleration& term) const {
    EncodeNumbers(term.joint_weights, cost.mutable_squared_acceleration()->mutable_joint_weights());
  }
};

}  // namespace

v1::CostTerm EncodeCost(const GaitRequest::CostTerm& cost) {
  v1::CostTerm encoded;
  std::visit(TermEncoder{encoded}, cost.term);
  if (cost.weight) encoded.set_weight(*cost.weight);
  return encoded;
}

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
