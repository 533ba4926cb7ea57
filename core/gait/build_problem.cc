#include "core/gait/build_problem.h"

#include "core/ocp/costs/point_costs.h"

namespace rollgait {
namespace {

VectorX JointWeights(const Model& model, const std::map<std::string, double>& named) {
  VectorX weights = VectorX::Ones(static_cast<int>(model.actuated().size()));
  for (int j = 0; j < weights.size(); ++j) {
    const auto it = named.find(model.joint(model.actuated()[j]).name);
    if (it != named.end()) weights(j) = it->second;
  }
  return weights;
}

TrackingCost DescribeTracking(const GaitRequest::Tracking& tracking, const Model& model) {
  TrackingCost cost;
  for (const GaitRequest::Tracking::Channel& channel : tracking.channels) {
    const int joint = model.Find(channel.joint);
    ROLLGAIT_CHECK(joint >= 0);
    cost.channels.push_back({joint, channel.weight.value(), CubicSpline(channel.positions)});
  }
  return cost;
}

CostDescription DescribeCost(const GaitSpec::CostTerm& term, const OptimalControlProblem& problem) {
  const PointLayout layout = problem.Layout(0);
  CostDescription description;
  description.weight = term.weight;
  if (const auto* torque = std::get_if<GaitRequest::SquaredTorque>(&term.term)) {
    description.term = std::make_unique<SquaredTorqueCost>(JointWeights(problem.model, torque->joint_weights), layout,
                                                           problem.effort_size());
  } else if (const auto* rate = std::get_if<GaitRequest::SquaredTorqueRate>(&term.term)) {
    description.term = EffortRateCost{JointWeights(problem.model, rate->joint_weights), problem.effort_size()};
  } else if (const auto* work = std::get_if<GaitRequest::MechanicalWork>(&term.term)) {
    // About 0.5 J per newton of weight and metre.
    description.term = std::make_unique<MechanicalWorkCost>(work->smoothing.value(), problem.model.actuated(), layout,
                                                            0.5 * problem.force_size());
  } else if (std::holds_alternative<GaitRequest::Time>(term.term)) {
    description.term = std::make_unique<TimeCost>();
  } else {
    description.term = DescribeTracking(std::get<GaitRequest::Tracking>(term.term), problem.model);
  }
  return description;
}

CostDenominator Denominator(GaitRequest::Normalization normalization) {
  switch (normalization) {
    case GaitRequest::Normalization::kPerDistance:
      return CostDenominator::kDistance;
    case GaitRequest::Normalization::kPerTime:
      return CostDenominator::kTime;
    case GaitRequest::Normalization::kNone:
      return CostDenominator::kNothing;
  }
  ROLLGAIT_CHECK(false);
}

Interval Scaled(double factor, const GaitRequest::Range& range) { return {factor * range.min, factor * range.max}; }

// The prismatic joint along x at the root carries the walk.
int ForwardJoint(const Model& model) {
  for (int j = 0; j < model.size(); ++j) {
    if (model.joint(j).name == "base_x") return j;
  }
  ROLLGAIT_CHECK(false);
}

}  // namespace

std::unique_ptr<OptimalControlProblem> BuildProblem(const GaitSpec& spec) {
  auto problem = std::make_unique<OptimalControlProblem>(spec.scene.model);
  problem->contacts = spec.scene.contacts;
  problem->gravity = spec.gravity;
  for (const GaitSpec::Phase& phase : spec.phases) {
    problem->phases.push_back({phase.contacts, {phase.min_duration, phase.max_duration}});
  }
  problem->mirrored = spec.cycle == Cycle::kHalf;
  problem->forward_joint = ForwardJoint(problem->model);
  problem->denominator = Denominator(spec.normalization);
  problem->friction_coefficient = spec.friction_coefficient;
  problem->min_normal_force = spec.min_normal_force_bw * problem->force_size();
  problem->swing_clearance = spec.swing_clearance;
  if (spec.touch_down_point) problem->touch_down_point = Scaled(1, *spec.touch_down_point);
  if (spec.lift_off_point) problem->lift_off_point = Scaled(1, *spec.lift_off_point);
  const double steps = problem->mirrored ? 1 : 2;
  problem->displacement = Scaled(steps, spec.step_length_range);
  problem->duration = Scaled(steps, spec.step_duration_range);
  problem->speed = Scaled(1, spec.speed_range);
  for (const GaitSpec::CostTerm& term : spec.costs) problem->costs.push_back(DescribeCost(term, *problem));
  return problem;
}

}  // namespace rollgait
