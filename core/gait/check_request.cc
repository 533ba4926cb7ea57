#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/gait/gait_request.h"
#include "core/gait/request_check.h"

namespace rollgait {
namespace {

constexpr double kDefaultSpeed = 1.3;  // m/s

std::optional<Scene> CheckBody(BodyRequest body, RequestCheck& check) {
  body.model = Printable(body.model);  // it comes back in a message if it is unknown
  Result<Scene> scene = BuildScene(body);
  if (scene.ok()) return std::move(scene).value();
  for (const Violation& violation : scene.violations()) check.Add("model." + violation.field, violation.message);
  return std::nullopt;
}

// Refuses contradictions between the prescribed quantities; returns the mean speed that they imply, if any.
std::optional<double> ImpliedSpeed(const GaitRequest::Motion& motion, RequestCheck& check) {
  const bool both = motion.step_length && motion.step_duration;
  if (motion.free_speed && motion.speed) {
    check.Add("motion.free_speed", "contradicts speed_m_s " + FormatNumber(*motion.speed) + "; give one of the two");
    return std::nullopt;
  }
  if (motion.free_speed && both) {
    check.Add("motion.free_speed",
              "contradicts step_length_m and step_duration_s, which fix the speed together; "
              "leave one of the three out");
    return std::nullopt;
  }
  if (motion.speed && both) {
    check.Add("motion", "speed_m_s " + FormatNumber(*motion.speed) + ", step_length_m " +
                            FormatNumber(*motion.step_length) + " and step_duration_s " +
                            FormatNumber(*motion.step_duration) + " are all given (speed times duration is " +
                            FormatNumber(*motion.speed * *motion.step_duration) + " m); give at most two of them");
    return std::nullopt;
  }
  if (motion.free_speed) return std::nullopt;
  if (both) return *motion.step_length / *motion.step_duration;
  return motion.speed.value_or(kDefaultSpeed);
}

// Walking on one leg at a time needs v² <= g L: above it the ground would have to pull on the stance leg.
void CheckFroude(double speed, const GaitRequest::Motion& motion, const Scene& scene, double gravity,
                 RequestCheck& check) {
  const double froude = speed * speed / (gravity * scene.leg_length);
  if (!(gravity > 0) || !(froude > 1)) return;  // without gravity, gravity was refused already
  const bool derived = motion.step_length && motion.step_duration;
  check.Add(derived ? "motion" : "motion.speed_m_s",
            FormatNumber(speed) + " m/s" + (derived || motion.speed ? "" : " (the default)") +
                " has Froude number v²/(g L) = " + FormatNumber(froude) + " with leg length " +
                FormatNumber(scene.leg_length) + " m; walking is impossible above 1: give at most " +
                FormatNumber(std::sqrt(gravity * scene.leg_length)) + " m/s");
}

// A step lasts as long as its phases: refuses a duration that they cannot add up to.
void CheckStepDuration(double step, const char* field, Cycle cycle, const std::vector<GaitSpec::Phase>& phases,
                       RequestCheck& check) {
  if (phases.empty()) return;
  double least = 0, most = 0;
  for (const GaitSpec::Phase& phase : phases) {
    least += phase.min_duration;
    most += phase.max_duration;
  }
  const double steps = cycle == Cycle::kHalf ? 1 : 2;
  if (steps * step < least || steps * step > most) {
    check.Add(field, "a step of " + FormatNumber(step) + " s contradicts the phases, which last " +
                         FormatNumber(least / steps) + " to " + FormatNumber(most / steps) +
                         " s a step together; change it or min_duration_s and max_duration_s of the phases");
  }
}

struct CheckedAccuracy {
  double kkt_tolerance, max_gap, max_slip;
  int max_refinements;
};

CheckedAccuracy CheckAccuracy(const GaitRequest::Accuracy& accuracy, RequestCheck& check) {
  CheckedAccuracy level{1e-6, kInfinity, kInfinity, 0};
  switch (accuracy.level) {
    case GaitRequest::AccuracyLevel::kDraft:
      break;
    case GaitRequest::AccuracyLevel::kStandard:
      level = {1e-6, 1e-4, 1e-3, 3};
      break;
    case GaitRequest::AccuracyLevel::kFine:
      level = {1e-6, 1e-5, 1e-4, 3};
      break;
  }
  return {check.Number("accuracy.kkt_tolerance", accuracy.kkt_tolerance, level.kkt_tolerance, {1e-12, 1e-2}),
          check.Number("accuracy.max_gap_m", accuracy.max_gap, level.max_gap, {1e-9, 0.1, "m"}),
          check.Number("accuracy.max_slip_m_s", accuracy.max_slip, level.max_slip, {1e-9, 1, "m/s"}),
          check.Integer("accuracy.max_refinements", accuracy.max_refinements, level.max_refinements, 0, 6)};
}

}  // namespace

CheckedMotion CheckMotion(const GaitRequest& request, const Scene* scene, double gravity, RequestCheck& check) {
  const GaitRequest::Motion& motion = request.motion;
  check.Number("motion.speed_m_s", motion.speed, 0, {0, 4, "m/s", true});
  check.Number("motion.step_length_m", motion.step_length, 0, {0, 2, "m", true});
  check.Number("motion.step_duration_s", motion.step_duration, 0, {0.1, 5, "s"});
  if (!check.ok()) return {};

  CheckedMotion checked;
  checked.step_length = motion.step_length;
  checked.step_duration = motion.step_duration;
  checked.speed_range = {0.2, 3};
  checked.step_duration_range = {0.1, 5};
  if (scene != nullptr) {
    checked.speed_range.max = std::min(3.0, std::sqrt(gravity * scene->leg_length));
    checked.step_length_range = {0.1 * scene->leg_length, 1.6 * scene->leg_length};
  }
  const std::optional<double> speed = ImpliedSpeed(motion, check);
  if (!check.ok()) return {};
  if (speed && *speed > 4) {
    check.Add("motion",
              "step_length_m / step_duration_s is " + FormatNumber(*speed) + " m/s; at most 4 m/s is accepted");
  } else if (speed && scene != nullptr) {
    CheckFroude(*speed, motion, *scene, gravity, check);
  }
  const auto widen = [](GaitRequest::Range& range, double value) {
    range = {std::min(range.min, value), std::max(range.max, value)};
  };
  if (motion.step_length) checked.step_length_range = {*motion.step_length, *motion.step_length};
  if (motion.step_duration) checked.step_duration_range = {*motion.step_duration, *motion.step_duration};
  if (speed && motion.step_length && motion.step_duration) {
    widen(checked.speed_range, *speed);
  } else if (speed) {
    checked.speed = speed;
    checked.speed_range = {*speed, *speed};
    if (motion.step_duration) {
      widen(checked.step_length_range, *speed * *motion.step_duration);
      check.Number("motion", *speed * *motion.step_duration, 0,
                   {0, 2, "m of step length (speed times duration)", true});
    } else if (motion.step_length) {
      check.Number("motion", *motion.step_length / *speed, 0, {0.1, 5, "s of step duration (length divided by speed)"});
    }
  }
  return checked;
}

Result<GaitSpec> CheckRequest(const GaitRequest& request) {
  RequestCheck check;
  const std::optional<Scene> scene = CheckBody(request.body, check);
  const Scene* known = scene ? &*scene : nullptr;

  constexpr double kSteepest = std::numbers::pi / 4;
  const double slope = check.Number("slope_rad", request.slope, 0, {-kSteepest, kSteepest, "rad"});
  const double gravity = check.Number("gravity_m_s2", request.gravity, 9.81, {0.1, 100, "m/s²"});

  RequestCheck motion_check;
  const CheckedMotion motion = CheckMotion(request, known, gravity, motion_check);
  std::vector<GaitSpec::Phase> phases = CheckPhases(request, known, check);
  if (motion_check.ok()) {
    if (motion.step_duration) {
      CheckStepDuration(*motion.step_duration, "motion.step_duration_s", request.cycle, phases, motion_check);
    } else if (motion.speed && motion.step_length) {
      CheckStepDuration(*motion.step_length / *motion.speed, "motion", request.cycle, phases, motion_check);
    }
  }
  if (!motion_check.ok()) {
    for (Violation& violation : motion_check.Take())
      check.Add(std::move(violation.field), std::move(violation.message));
  }
  std::vector<GaitSpec::CostTerm> costs = CheckCosts(request, known, check);

  const GaitRequest::GroundContact& ground = request.ground_contact;
  const double friction =
      check.Number("ground_contact.friction_coefficient", ground.friction_coefficient, 0.8, {0, 5, "", true});
  const double min_force = check.Number("ground_contact.min_normal_force_bw", ground.min_normal_force_bw, 0, {0, 1});
  const double clearance =
      check.Number("ground_contact.swing_clearance_m", ground.swing_clearance, 0.01, {0, 0.3, "m"});
  const NumberLimits heel_to_toe{-1, 1};
  if (ground.touch_down_point)
    check.Range("ground_contact.touch_down_point", *ground.touch_down_point, heel_to_toe, true);
  if (ground.lift_off_point) check.Range("ground_contact.lift_off_point", *ground.lift_off_point, heel_to_toe, true);

  std::vector<Joint> joints = CheckLimits(request, known, check);
  const CheckedAccuracy accuracy = CheckAccuracy(request.accuracy, check);
  const int max_iterations =
      check.Integer("solver_limits.max_iterations", request.solver_limits.max_iterations, 1000, 1, 100000);
  const double max_wall_time =
      check.Number("solver_limits.max_wall_time_s", request.solver_limits.max_wall_time, 600, {0.01, 86400, "s"});
  if (!check.ok()) return check.Take();

  Result<Model> model = Model::Create(std::move(joints));
  if (!model.ok()) return model.violations();
  Scene limited = *scene;
  limited.model = std::move(model).value();
  return GaitSpec{.scene = std::move(limited),
                  .slope = slope,
                  .gravity = gravity * Vector3(-std::sin(slope), 0, -std::cos(slope)),
                  .speed = motion.speed,
                  .step_length = motion.step_length,
                  .step_duration = motion.step_duration,
                  .speed_range = motion.speed_range,
                  .step_length_range = motion.step_length_range,
                  .step_duration_range = motion.step_duration_range,
                  .cycle = request.cycle,
                  .phases = std::move(phases),
                  .costs = std::move(costs),
                  .normalization = request.normalization,
                  .friction_coefficient = friction,
                  .min_normal_force_bw = min_force,
                  .swing_clearance = clearance,
                  .touch_down_point = ground.touch_down_point,
                  .lift_off_point = ground.lift_off_point,
                  .scheme = request.discretization.scheme,
                  .kkt_tolerance = accuracy.kkt_tolerance,
                  .max_gap = accuracy.max_gap,
                  .max_slip = accuracy.max_slip,
                  .max_refinements = accuracy.max_refinements,
                  .max_iterations = max_iterations,
                  .max_wall_time = max_wall_time};
}

}  // namespace rollgait
