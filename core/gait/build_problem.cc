#include "core/gait/build_problem.h"

#include <algorithm>
#include <cmath>

#include "core/models/passive_torque.h"
#include "core/ocp/costs/body_torque.h"
#include "core/ocp/costs/muscle_costs.h"
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

std::vector<MuscledJoint> MuscledJoints(const Scene& scene, double passive_scale,
                                        const std::map<std::string, double>& weights) {
  std::vector<MuscledJoint> joints;
  for (int index : scene.model.actuated()) {
    const Joint& joint = scene.model.joint(index);
    const double strength = std::max(-joint.effort_min, joint.effort_max);
    joints.push_back(
        {index, strength, weights.at(joint.name), PassiveTorque(joint, passive_scale * scene.selection.mass)});
  }
  return joints;
}

// Describes each kind of term.
struct TermDescription {
  const Scene& scene;
  double passive_scale;
  const OptimalControlProblem& problem;
  PointLayout layout;
  // Mechanical power of a walker, W: about 0.5 J per newton of weight and metre.
  double power() const { return 0.5 * problem.force_size(); }

  using Term = decltype(CostDescription::term);
  Term operator()(const GaitRequest::SquaredTorque& term) const {
    if (scene.selection.rolling_body) {
      return std::make_unique<BodyTorqueCost>(problem.model.actuated()[1], layout, std::pow(problem.effort_size(), 2));
    }
    return std::make_unique<SquaredTorqueCost>(JointWeights(problem.model, term.joint_weights), layout,
                                               problem.effort_size());
  }
  Term operator()(const GaitRequest::SquaredTorqueRate& term) const {
    return EffortRateCost{JointWeights(problem.model, term.joint_weights), problem.effort_size()};
  }
  Term operator()(const GaitRequest::SquaredForceRate&) const { return ForceRateCost{problem.force_size()}; }
  Term operator()(const GaitRequest::MechanicalWork& term) const {
    return std::make_unique<MechanicalWorkCost>(term.smoothing.value(), problem.model.actuated(), layout, power());
  }
  Term operator()(const GaitRequest::Time&) const { return std::make_unique<TimeCost>(); }
  Term operator()(const GaitRequest::Tracking& term) const { return DescribeTracking(term, problem.model); }
  Term operator()(const GaitRequest::MuscleEffort& term) const {
    return std::make_unique<MuscleEffortCost>(MuscledJoints(scene, passive_scale, term.joint_weights),
                                              term.exponent.value(), layout);
  }
  Term operator()(const GaitRequest::MuscleWork& term) const {
    return std::make_unique<MuscleWorkCost>(MuscledJoints(scene, passive_scale, term.joint_weights),
                                            term.positive_efficiency.value(), term.negative_efficiency.value(),
                                            term.smoothing.value(), layout, power());
  }
  Term operator()(const GaitRequest::PassiveLoad& term) const {
    return std::make_unique<PassiveLoadCost>(MuscledJoints(scene, passive_scale, term.joint_weights), layout);
  }
  Term operator()(const GaitRequest::SquaredAcceleration& term) const {
    VectorX weights = VectorX::Zero(problem.model.size());
    for (const auto& [name, weight] : term.joint_weights) weights(problem.model.Find(name)) = weight;
    return std::make_unique<SquaredAccelerationCost>(weights, layout);
  }
};

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

// Root mean square of the couple that turns the body in the time that the request gives (1 s where it is free), and of
// that which holds it on the slope.
double TypicalCouple(const GaitSpec& spec) {
  const double duration =
      spec.phases.front().max_duration > 10 * spec.phases.front().min_duration ? 1 : spec.phases.front().max_duration;
  const double turning = std::sqrt(12.0) * TurningMoment(spec) / (duration * duration);
  const double holding = spec.scene.model.total_mass() * spec.gravity.head<2>().norm() *
                         spec.scene.selection.rolling_body->semi_axes.mean();
  return std::hypot(turning, holding);
}

void DescribeTravel(const GaitSpec& spec, OptimalControlProblem* problem) {
  if (spec.manoeuvre) {
    const Manoeuvre& manoeuvre = *spec.manoeuvre;
    if (manoeuvre.end.x) problem->displacement.min = problem->displacement.max = *manoeuvre.end.x - *manoeuvre.start.x;
    problem->lever = TypicalCouple(spec) / problem->force_size();
    return;
  }
  const double steps = problem->mirrored ? 1 : 2;
  problem->displacement = Scaled(steps, spec.step_length_range);
  problem->duration = Scaled(steps, spec.step_duration_range);
  problem->speed = Scaled(1, spec.speed_range);
  if (spec.duty_factor) problem->duty_factor = Scaled(1, *spec.duty_factor);
}

}  // namespace

double TurningMoment(const GaitSpec& spec) {
  const RollingEllipsoid& body = *spec.scene.selection.rolling_body;
  const Manoeuvre& manoeuvre = *spec.manoeuvre;
  const double radius = body.semi_axes.mean();
  const double x = *manoeuvre.start.x, y = *manoeuvre.start.y;
  const double distance = std::hypot(manoeuvre.end.x.value_or(x) - x, manoeuvre.end.y.value_or(y) - y);
  return (body.moments.mean() + body.mass * radius * radius) * std::max(1.0, distance / radius);
}

std::unique_ptr<OptimalControlProblem> BuildProblem(const GaitSpec& spec) {
  auto problem = std::make_unique<OptimalControlProblem>(spec.scene.model);
  problem->contacts = spec.scene.contacts;
  problem->bodies = spec.scene.bodies;
  problem->pairs = spec.scene.pairs;
  problem->gravity = spec.gravity;
  for (const GaitSpec::Phase& phase : spec.phases) {
    problem->phases.push_back({phase.contacts, {phase.min_duration, phase.max_duration}});
  }
  problem->mirrored = spec.cycle == Cycle::kHalf;
  problem->forward_joint = problem->model.Find(JointRole::kBaseForward);  // carries the walk
  ROLLGAIT_CHECK(problem->forward_joint >= 0);
  problem->lateral_joint = problem->model.Find(JointRole::kBaseLateral);
  problem->denominator = Denominator(spec.normalization);
  problem->friction_coefficient = spec.friction_coefficient;
  problem->min_normal_force = spec.min_normal_force_bw * problem->force_size();
  problem->swing_clearance = spec.swing_clearance;
  if (spec.touch_down_point) problem->touch_down_point = Scaled(1, *spec.touch_down_point);
  if (spec.lift_off_point) problem->lift_off_point = Scaled(1, *spec.lift_off_point);
  problem->plastic_touch_down = spec.touch_down == GaitRequest::TouchDown::kPlastic;
  DescribeTravel(spec, problem.get());
  const TermDescription describe{spec.scene, spec.passive_scale, *problem, problem->Layout(0)};
  for (const GaitSpec::CostTerm& term : spec.costs) {
    problem->costs.push_back({std::visit(describe, term.term), term.weight});
  }
  return problem;
}

}  // namespace rollgait
