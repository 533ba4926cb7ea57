#include <algorithm>
#include <cmath>
#include <utility>

#include "core/gait/default_speed.h"
#include "core/gait/request_check.h"

namespace rollgait {
namespace {

// Refuses contradictions between the prescribed quantities; returns the mean speed that they imply, if any.
std::optional<double> ImpliedSpeed(const GaitRequest::Motion& motion, const Similarity& similarity,
                                   RequestCheck& check) {
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
  return motion.speed.value_or(DefaultSpeed(kDefaultGravity * similarity.gravity));
}

// Walking on one leg at a time needs v² <= g L: above it the ground would have to pull on the stance leg.
void CheckFroude(double speed, const GaitRequest::Motion& motion, const Scene& scene, double gravity,
                 RequestCheck& check) {
  const double froude = speed * speed / (gravity * scene.leg_length);
  if (!(gravity > 0) || !(froude > 1)) return;  // without gravity, gravity was refused already
  const bool derived = motion.step_length && motion.step_duration;
  check.Add(derived ? "motion" : "motion.speed_m_s",
            FormatNumber(speed) + " m/s has Froude number v²/(g L) = " + FormatNumber(froude) + " with leg length " +
                FormatNumber(scene.leg_length) + (scene.symmetric ? " m" : " m of the longer leg") +
                "; walking is impossible above 1: give at most " + FormatNumber(std::sqrt(gravity * scene.leg_length)) +
                " m/s");
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

// Everything but the durations of the phases. Stops at the first contradiction: what follows would repeat it.
CheckedMotion CheckTravel(const GaitRequest::Motion& motion, const Scene* scene, double gravity,
                          const Similarity& similarity, RequestCheck& check) {
  check.Number("motion.speed_m_s", motion.speed, 0, {0, 4, "m/s", true});
  check.Number("motion.step_length_m", motion.step_length, 0, {0, 2, "m", true});
  check.Number("motion.step_duration_s", motion.step_duration, 0, {0.1, 5, "s"});
  if (!check.ok()) return {};

  CheckedMotion checked;
  checked.step_length = motion.step_length;
  checked.step_duration = motion.step_duration;
  checked.speed_range = {0.2 * similarity.speed(), 3 * similarity.speed()};
  checked.step_duration_range = {0.1 * similarity.time(), 5 * similarity.time()};
  if (scene != nullptr) {
    checked.speed_range.max = std::min(checked.speed_range.max, std::sqrt(gravity * scene->leg_length));
    checked.step_length_range = {0.1 * scene->leg_length, 1.6 * scene->leg_length};
  }
  const std::optional<double> speed = ImpliedSpeed(motion, similarity, check);
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

}  // namespace

CheckedMotion CheckMotion(const GaitRequest& request, const Scene* scene, double gravity, const Similarity& similarity,
                          const std::vector<GaitSpec::Phase>& phases, RequestCheck& check) {
  RequestCheck own;
  const CheckedMotion motion = CheckTravel(request.motion, scene, gravity, similarity, own);
  if (own.ok() && motion.step_duration) {
    CheckStepDuration(*motion.step_duration, "motion.step_duration_s", *request.cycle, phases, own);
  } else if (own.ok() && motion.speed && motion.step_length) {
    CheckStepDuration(*motion.step_length / *motion.speed, "motion", *request.cycle, phases, own);
  }
  if (own.ok()) return motion;
  for (Violation& violation : own.Take()) check.Add(std::move(violation.field), std::move(violation.message));
  return motion;
}

}  // namespace rollgait
