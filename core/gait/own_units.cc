#include "core/gait/own_units.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "core/gait/judge_solution.h"
#include "core/gait/power_smoothing.h"

namespace rollgait {
namespace {

// Of a force or moment in SI units, in these; the same of an impulse and a power.
double OfForce(const Units& units) { return units.time * units.time / units.mass; }
double OfImpulse(const Units& units) { return units.time / units.mass; }
double OfPower(const Units& units) { return std::pow(units.time, 3) / units.mass; }

Units Inverse(const Units& units) { return {1 / units.time, 1 / units.mass, 1 / units.objective}; }

GaitRequest::Range Scaled(double factor, const GaitRequest::Range& range) {
  return {factor * range.min, factor * range.max};
}

Scene InUnits(const Units& units, const Scene& scene) {
  std::vector<Joint> joints = scene.model.joints();
  for (Joint& joint : joints) {
    joint.velocity_max *= units.time;
    joint.effort_min *= OfForce(units);
    joint.effort_max *= OfForce(units);
    joint.stiffness *= OfForce(units);
    joint.damping *= OfImpulse(units);
    joint.mass /= units.mass;
    joint.inertia /= units.mass;
  }
  Scene scaled = scene;
  scaled.model = Model::Create(std::move(joints)).value();
  scaled.selection.mass /= units.mass;
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

// Of ∫ … dt in these units, in SI units.
double OfIntegral(const Units& units, const GaitSpec::CostTerm& cost) {
  const CostTraits& traits = TraitsOf(cost.term);
  return std::pow(units.time, 1 + traits.time_power) * std::pow(units.mass, traits.mass_power);
}

// The weight of a term in these units of time and mass.
double WeightIn(const Units& units, GaitRequest::Normalization normalization, const GaitSpec::CostTerm& cost) {
  const double weight = cost.weight * OfIntegral(units, cost);
  return normalization == GaitRequest::Normalization::kPerTime ? weight / units.time : weight;
}

void ScaleCost(const Units& units, GaitRequest::Normalization normalization, GaitSpec::CostTerm* cost) {
  cost->weight = WeightIn(units, normalization, *cost) / units.objective;
  if (std::optional<double>* smoothing = SmoothingOf(cost)) **smoothing *= OfPower(units);
}

// What a violation in these units is multiplied by to be in SI units; 1 where there is neither time nor mass in it.
double ViolationFactor(const Units& units, const std::string& name) {
  if (name == "s") return units.time;
  if (name == "m/s" || name == "rad/s" || name == "rad/s or m/s") return 1 / units.time;
  if (name == "N s") return 1 / OfImpulse(units);
  if (name == "N" || name == "N m" || name == "N m or N") return 1 / OfForce(units);
  if (name == "m/s²" || name == "rad/s²") return 1 / (units.time * units.time);
  return 1;
}

// The nearest multiple of the power of ten that has 11 digits in a number as large as `size`.
double Rounded(double value, double size) {
  constexpr int kDigits = 11;
  if (size == 0 || !std::isfinite(size) || !std::isfinite(value)) return value;
  const int places = kDigits - static_cast<int>(std::ceil(std::log10(std::abs(size))));
  const double power = std::pow(10.0, std::abs(places));  // exact up to 22 places: decimal numbers stay as they are
  return places >= 0 ? std::round(value * power) / power : std::round(value / power) * power;
}

void Round(double* value) { *value = Rounded(*value, *value); }

void Round(std::optional<double>* value) {
  if (*value) Round(&**value);
}

void Round(GaitRequest::Range* range) {
  Round(&range->min);
  Round(&range->max);
}

void Round(Joint* joint) {
  for (double* value : {&joint->velocity_max, &joint->effort_min, &joint->effort_max, &joint->mass, &joint->stiffness,
                        &joint->damping}) {
    Round(value);
  }
  // Of bodies joined to one, means of centres with the masses as weights.
  for (double& coordinate : joint->center_of_mass) coordinate = Rounded(coordinate, 1);
  const double size = joint->inertia.trace();
  joint->inertia = joint->inertia.unaryExpr([size](double moment) { return Rounded(moment, size); });
}

}  // namespace

Units OwnUnits(const GaitSpec& spec) {
  Units units{spec.similarity.time(), spec.similarity.mass};
  double sum = 0;
  for (const GaitSpec::CostTerm& cost : spec.costs) sum += WeightIn(units, spec.normalization, cost);
  if (sum > 0) units.objective = sum;
  return units;
}

Trajectory InUnits(const Units& units, Trajectory trajectory) {
  const double unit = units.time;
  trajectory.duration /= unit;
  for (TrajectoryPhase& phase : trajectory.phases) {
    phase.start /= unit;
    phase.duration /= unit;
    for (double& time : phase.node_times) time /= unit;
    for (double& time : phase.point_times) time /= unit;
    phase.node_velocities *= unit;
    phase.point_velocities *= unit;
    phase.point_accelerations *= unit * unit;
    phase.point_efforts *= OfForce(units);
    phase.point_forces *= OfForce(units);
    phase.impulses *= OfImpulse(units);
    phase.impact_loss *= OfForce(units);
  }
  return trajectory;
}

GaitSpec InUnits(const Units& units, const GaitSpec& spec) {
  ROLLGAIT_CHECK(units.time > 0 && units.mass > 0 && !spec.manoeuvre);
  const double unit = units.time;
  GaitSpec scaled = spec;
  scaled.scene = InUnits(units, spec.scene);
  scaled.similarity.gravity *= unit * unit;
  scaled.similarity.mass /= units.mass;
  scaled.units.time *= unit;
  scaled.units.mass *= units.mass;
  scaled.units.objective *= units.objective;
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
  for (GaitSpec::CostTerm& cost : scaled.costs) ScaleCost(units, spec.normalization, &cost);
  scaled.bounds = ScaledBounds(unit, spec.bounds);
  if (scaled.max_error) {
    if (scaled.max_error->torque) *scaled.max_error->torque *= OfForce(units);
    if (scaled.max_error->contact_force) *scaled.max_error->contact_force *= OfForce(units);
  }
  if (scaled.warm_start) {
    scaled.warm_start->trajectory = InUnits(units, spec.warm_start->trajectory);
    if (scaled.warm_start->multipliers) scaled.warm_start->multipliers->Scale(1 / units.objective);
  }
  if (spec.symmetric) scaled.symmetric = std::make_shared<const GaitSpec>(InUnits(units, *spec.symmetric));
  return scaled;
}

GaitSpec WithoutRounding(const GaitSpec& spec) {
  constexpr double kOwnGravity = 9.81;
  GaitSpec rounded = spec;
  std::vector<Joint> joints = spec.scene.model.joints();
  for (Joint& joint : joints) Round(&joint);
  rounded.scene.model = Model::Create(std::move(joints)).value();
  Round(&rounded.scene.selection.mass);
  rounded.similarity = {};
  rounded.gravity = kOwnGravity * Vector3(-std::sin(spec.slope), 0, -std::cos(spec.slope));
  Round(&rounded.passive_scale);
  Round(&rounded.speed);
  Round(&rounded.step_duration);
  Round(&rounded.speed_range);
  Round(&rounded.step_duration_range);
  for (GaitSpec::Phase& phase : rounded.phases) {
    Round(&phase.min_duration);
    Round(&phase.max_duration);
  }
  for (GaitSpec::CostTerm& cost : rounded.costs) {
    Round(&cost.weight);
    if (std::optional<double>* smoothing = SmoothingOf(&cost)) Round(smoothing);
  }
  for (const CriterionTraits& traits : Criteria()) Round(&rounded.bounds[traits.criterion]);
  if (spec.symmetric) rounded.symmetric = std::make_shared<const GaitSpec>(WithoutRounding(*spec.symmetric));
  return rounded;
}

GaitSolution InSi(const Units& units, const GaitSpec& spec, GaitSolution solution) {
  for (size_t i = 0; i < solution.costs.size(); ++i) {
    const double factor = OfIntegral(units, spec.costs[i]);
    solution.costs[i].weight = spec.costs[i].weight;
    solution.costs[i].value *= factor;
    solution.costs[i].unsmoothed *= factor;
    solution.costs[i].contribution *= units.objective;
  }
  solution.objective *= units.objective;
  if (solution.multipliers) solution.multipliers->Scale(units.objective);
  for (UnmetConstraint& unmet : solution.unmet_constraints) {
    unmet.time *= units.time;
    unmet.violation *= ViolationFactor(units, unmet.unit);
  }
  for (MeshStatistics& mesh : solution.meshes) {
    mesh.objective *= units.objective;
    mesh.max_slip /= units.time;
    mesh.smoothing /= OfPower(units);
  }
  solution.speed /= units.time;
  if (solution.finer) {
    solution.finer->objective *= units.objective;
    solution.finer->speed /= units.time;
    solution.finer->trajectory = InUnits(Inverse(units), std::move(solution.finer->trajectory));
  }
  if (solution.trajectory) {
    solution.trajectory = InUnits(Inverse(units), std::move(*solution.trajectory));
    Judge(spec, &solution);
  }
  return solution;
}

}  // namespace rollgait
