#include "core/gait/time_unit.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <variant>

#include "core/gait/judge_solution.h"

namespace rollgait {
namespace {

// −k of the dimension T^k of each integrand.
struct IntegrandPower {
  int operator()(const GaitRequest::SquaredTorque&) const { return 4; }
  int operator()(const GaitRequest::SquaredTorqueRate&) const { return 6; }
  int operator()(const GaitRequest::SquaredForceRate&) const { return 6; }
  int operator()(const GaitRequest::MechanicalWork&) const { return 3; }
  int operator()(const GaitRequest::Time&) const { return 0; }
  int operator()(const GaitRequest::Tracking&) const { return 0; }
  int operator()(const GaitRequest::MuscleEffort&) const { return 0; }  // torque over strength
  int operator()(const GaitRequest::MuscleWork&) const { return 3; }
  int operator()(const GaitRequest::PassiveLoad&) const { return 0; }
  int operator()(const GaitRequest::SquaredAcceleration&) const { return 4; }
};

GaitRequest::Range Scaled(double factor, const GaitRequest::Range& range) {
  return {factor * range.min, factor * range.max};
}

Scene WithLimits(double velocity, double effort, const Scene& scene) {
  std::vector<Joint> joints = scene.model.joints();
  for (Joint& joint : joints) {
    joint.velocity_max *= velocity;
    joint.effort_min *= effort;
    joint.effort_max *= effort;
  }
  Scene scaled = scene;
  scaled.model = Model::Create(std::move(joints)).value();
  return scaled;
}

CriterionValues ScaledBounds(double unit, CriterionValues bounds) {
  for (const Criterion criterion :
       {Criterion::kSlip, Criterion::kVelocityDefect, Criterion::kApproach, Criterion::kMomentum}) {
    bounds[criterion] *= unit;
  }
  bounds[Criterion::kPeriodicity] *= std::min(1.0, unit);
  return bounds;
}

void ScaleCost(double unit, GaitRequest::Normalization normalization, GaitSpec::CostTerm* cost) {
  const int time = normalization == GaitRequest::Normalization::kPerTime ? 0 : 1;  // T of ∫ … dt over the denominator
  cost->weight *= std::pow(unit, time - std::visit(IntegrandPower{}, cost->term));
  if (auto* work = std::get_if<GaitRequest::MechanicalWork>(&cost->term)) *work->smoothing *= std::pow(unit, 3);
  if (auto* work = std::get_if<GaitRequest::MuscleWork>(&cost->term)) *work->smoothing *= std::pow(unit, 3);
}

// What a violation in this unit is multiplied by to be in seconds; 1 where there is no time in it.
double ViolationFactor(double unit, const std::string& name) {
  if (name == "s") return unit;
  if (name == "m/s" || name == "rad/s" || name == "rad/s or m/s" || name == "N s") return 1 / unit;
  if (name == "N" || name == "N m" || name == "N m or N" || name == "m/s²" || name == "rad/s²")
    return 1 / (unit * unit);
  return 1;
}

}  // namespace

Trajectory InTimeUnit(double unit, Trajectory trajectory) {
  trajectory.duration /= unit;
  for (TrajectoryPhase& phase : trajectory.phases) {
    phase.start /= unit;
    phase.duration /= unit;
    for (double& time : phase.node_times) time /= unit;
    for (double& time : phase.point_times) time /= unit;
    phase.node_velocities *= unit;
    phase.point_velocities *= unit;
    phase.point_accelerations *= unit * unit;
    phase.point_efforts *= unit * unit;
    phase.point_forces *= unit * unit;
    phase.impulses *= unit;
    phase.impact_loss *= unit * unit;
  }
  return trajectory;
}

GaitSpec InTimeUnit(double unit, const GaitSpec& spec) {
  ROLLGAIT_CHECK(unit > 0 && !spec.manoeuvre);
  GaitSpec scaled = spec;
  scaled.scene = WithLimits(unit, unit * unit, spec.scene);
  scaled.similarity.gravity *= unit * unit;
  scaled.time_unit *= unit;
  scaled.passive_scale *= unit * unit;
  scaled.gravity *= unit * unit;
  if (scaled.speed) *scaled.speed *= unit;
  if (scaled.step_duration) *scaled.step_duration /= unit;
  scaled.speed_range = Scaled(unit, spec.speed_range);
  scaled.step_duration_range = Scaled(1 / unit, spec.step_duration_range);
  for (GaitSpec::Phase& phase : scaled.phases) {
    phase.min_duration /= unit;
    phase.max_duration /= unit;
  }
  for (GaitSpec::CostTerm& cost : scaled.costs) ScaleCost(unit, spec.normalization, &cost);
  scaled.bounds = ScaledBounds(unit, spec.bounds);
  if (scaled.max_error) {
    if (scaled.max_error->torque) *scaled.max_error->torque *= unit * unit;
    if (scaled.max_error->contact_force) *scaled.max_error->contact_force *= unit * unit;
  }
  if (scaled.warm_start) scaled.warm_start->trajectory = InTimeUnit(unit, spec.warm_start->trajectory);
  return scaled;
}

GaitSolution InSeconds(double unit, const GaitSpec& spec, GaitSolution solution) {
  for (size_t i = 0; i < solution.costs.size(); ++i) {
    const double factor = std::pow(unit, 1 - std::visit(IntegrandPower{}, spec.costs[i].term));
    solution.costs[i].weight = spec.costs[i].weight;
    solution.costs[i].value *= factor;
    solution.costs[i].unsmoothed *= factor;
  }
  for (UnmetConstraint& unmet : solution.unmet_constraints) {
    unmet.time *= unit;
    unmet.violation *= ViolationFactor(unit, unmet.unit);
  }
  for (MeshStatistics& mesh : solution.meshes) {
    mesh.max_slip /= unit;
    mesh.smoothing /= std::pow(unit, 3);
  }
  solution.speed /= unit;
  if (solution.finer) {
    solution.finer->speed /= unit;
    solution.finer->trajectory = InTimeUnit(1 / unit, std::move(solution.finer->trajectory));
  }
  if (solution.trajectory) {
    solution.trajectory = InTimeUnit(1 / unit, std::move(*solution.trajectory));
    Judge(spec, &solution);
  }
  return solution;
}

}  // namespace rollgait
