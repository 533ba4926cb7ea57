#include "core/gait/build_problem.h"

#include <algorithm>
#include <cmath>

#include "core/models/passive_torque.h"
#include "core/ocp/cost_context.h"
#include "core/ocp/cost_table.h"

namespace rollgait {
namespace {

std::vector<MuscledJoint> MuscledJoints(const Scene& scene, double passive_scale, const JointWeights& weights) {
  std::vector<MuscledJoint> joints;
  for (int index : scene.model.actuated()) {
    const Joint& joint = scene.model.joint(index);
    const double strength = std::max(-joint.effort_min, joint.effort_max);
    joints.push_back(
        {index, strength, weights.at(joint.name), PassiveTorque(joint, passive_scale * scene.selection.mass)});
  }
  return joints;
}

void DescribeCosts(const GaitSpec& spec, OptimalControlProblem* problem) {
  const CostContext context{
      *problem, problem->Layout(0), spec.scene.selection.rolling_body.has_value(),
      [&spec](const JointWeights& weights) { return MuscledJoints(spec.scene, spec.passive_scale, weights); }};
  std::vector<CostDescription> costs;
  for (const GaitSpec::CostTerm& cost : spec.costs) {
    const CostTraits& traits = TraitsOf(cost.term);
    costs.push_back({std::visit([&context](const auto& term) { return Make(term, context); }, cost.term), cost.weight,
                     traits.name, traits.unit});
  }
  problem->costs = std::move(costs);
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
  DescribeCosts(spec, problem.get());
  return problem;
}

}  // namespace rollgait
