#include <cmath>
#include <string>
#include <variant>

#include "core/gait/request_check.h"

namespace rollgait {
namespace {

constexpr double kUnitTolerance = 1e-6;
constexpr double kShortest = 0.01, kLongest = 100;  // s
constexpr double kMostTurn = 200;                   // rad, of the distance over the least semi-axis
constexpr int kDefaultIntervals = 24;

using State = ManoeuvreRequest::State;

std::optional<Eigen::Quaterniond> CheckOrientation(const std::string& field,
                                                   const std::optional<Eigen::Vector4d>& given, RequestCheck& check) {
  if (!given) return std::nullopt;
  const Eigen::Vector4d& q = *given;
  const double length = q.norm();
  if (!(std::abs(length - 1) <= kUnitTolerance)) {  // true for NaN
    check.Add(field,
              "has length " + FormatNumber(length) + "; must be a unit quaternion (w, x, y, z), length 1 to 1e-6");
    return Eigen::Quaterniond::Identity();
  }
  return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized();
}

BodyState CheckState(const std::string& path, const State& state, RequestCheck& check) {
  const NumberLimits place{-kMaxPosition, kMaxPosition, "m"};
  if (state.x) check.Number(path + ".x_m", state.x, 0, place);
  if (state.y) check.Number(path + ".y_m", state.y, 0, place);
  for (int i = 0; i < 3; ++i) {
    check.Number(path + ".angular_velocity_rad_s." + std::string(1, "xyz"[i]), state.angular_velocity[i], 0,
                 {-kMaxVelocity, kMaxVelocity, "rad/s"});
  }
  return {state.x, state.y, CheckOrientation(path + ".orientation", state.orientation, check), state.angular_velocity};
}

void CheckDistance(const Manoeuvre& manoeuvre, const Scene& scene, RequestCheck& check) {
  const double distance = std::hypot(manoeuvre.end.x.value_or(*manoeuvre.start.x) - *manoeuvre.start.x,
                                     manoeuvre.end.y.value_or(*manoeuvre.start.y) - *manoeuvre.start.y);
  const double most = kMostTurn * scene.selection.rolling_body->semi_axes.minCoeff();
  if (distance > most) {
    check.Add("manoeuvre.end", "is " + FormatNumber(distance) +
                                   " m from the start; a body of this size may roll at most " + FormatNumber(most) +
                                   " m (200 times its shortest semi-axis)");
  }
}

// What means something in walking only.
void RefuseWalking(const GaitRequest& request, RequestCheck& check) {
  const auto refuse = [&check](bool given, const char* field, const char* reason) {
    if (given) check.Add(field, std::string("contradicts manoeuvre: ") + reason + "; leave it out");
  };
  const GaitRequest::Motion& motion = request.motion;
  refuse(motion.speed || motion.step_length || motion.step_duration || motion.free_speed || motion.duty_factor,
         "motion", "its ends and duration say how the body moves");
  refuse(request.cycle != Cycle::kOnce, "cycle", "nothing is repeated");
  refuse(request.preset.has_value(), "preset", "presets are costs of walking");
  refuse(request.starts.has_value(), "starts", "its starts are its own");
  refuse(request.warm_start, "warm_start", "its starts are its own");
  refuse(request.phases.has_value(), "phases", "it has one phase, on the contact \"surface\"");
  refuse(request.normalization != GaitRequest::Normalization::kNone, "cost_normalization",
         "its distance may be zero and its cost is not divided");
  refuse(request.ground_contact.swing_clearance.has_value(), "ground_contact.swing_clearance_m", "nothing swings");
  refuse(request.ground_contact.touch_down_point.has_value(), "ground_contact.touch_down_point",
         "nothing touches down");
  refuse(request.ground_contact.lift_off_point.has_value(), "ground_contact.lift_off_point", "nothing lifts off");
  refuse(request.ground_contact.touch_down != GaitRequest::TouchDown::kSmooth, "ground_contact.touch_down",
         "nothing touches down");
  refuse(request.discretization.double_support_intervals.has_value(), "discretization.double_support_intervals",
         "it has one phase, of single_support_intervals");
}

// The angles of the body are those of a chart that the solver chooses: nothing may be said of one of them.
void RefuseChartJoints(const GaitRequest& request, RequestCheck& check) {
  const auto refuse = [&check](const char* field, const auto& named) {
    for (const auto& [name, value] : named) {
      if (name.rfind("roll_", 0) == 0) {
        check.Add(Keyed(field, name), "belongs to a chart of the orientation that the solver chooses; leave it out");
      }
    }
  };
  refuse("limits.joint_position", request.limits.joint_position);
  refuse("limits.joint_velocity", request.limits.joint_velocity);
  refuse("limits.joint_effort", request.limits.joint_effort);
}

// True if time costs something.
bool CheckTerms(const GaitRequest& request, RequestCheck& check) {
  bool time = false;
  for (size_t i = 0; i < request.costs.size(); ++i) {
    const std::string path = Indexed("costs", i);
    const auto& term = request.costs[i].term;
    if (const auto* torque = std::get_if<cost::SquaredTorque>(&term)) {
      if (!torque->joint_weights.empty()) {
        check.Add(path + ".squared_torque.joint_weights",
                  "means nothing for a rolling body, whose cost is the square of the couple on it; leave it out");
      }
    } else if (std::holds_alternative<cost::Time>(term)) {
      time = time || request.costs[i].weight.value_or(1) > 0;
    } else {
      check.Add(path, "is a cost of joints, which a rolling body has none of; give squared_torque or time");
    }
  }
  return time;
}

}  // namespace

CheckedManoeuvre CheckManoeuvre(const GaitRequest& request, const Scene* scene, RequestCheck& check) {
  const ManoeuvreRequest& asked = *request.manoeuvre;
  if (scene != nullptr && !scene->selection.rolling_body) {
    check.Add("manoeuvre", "is for model \"ball\" so far, and model " + Quoted(scene->name) + " walks; leave it out");
    return {};
  }
  RefuseWalking(request, check);
  RefuseChartJoints(request, check);
  const bool time_costs = CheckTerms(request, check);

  CheckedManoeuvre checked;
  BodyState& start = checked.manoeuvre.start;
  BodyState& end = checked.manoeuvre.end;
  start = CheckState("manoeuvre.start", asked.start, check);
  end = CheckState("manoeuvre.end", asked.end, check);
  start.x = start.x.value_or(0);
  start.y = start.y.value_or(0);
  if (!start.orientation) start.orientation = Eigen::Quaterniond::Identity();
  if (!end.orientation && !end.angular_velocity.isZero(0)) {
    check.Add("manoeuvre.end.angular_velocity_rad_s",
              "is not zero while end.orientation is free; give the orientation too, or leave it out");
  }
  if (scene != nullptr) CheckDistance(checked.manoeuvre, *scene, check);

  check.Number("manoeuvre.duration_s", asked.duration, 1, {kShortest, kLongest, "s"});
  if (!asked.duration && !time_costs) {
    check.Add("manoeuvre.duration_s",
              "is not set, and no cost term of positive weight is on time: slower would always be "
              "cheaper; give the duration, 0.01 to 100 s, or a time cost");
  }
  GaitSpec::Phase phase{{0}, 0, asked.duration.value_or(kShortest), asked.duration.value_or(kLongest)};
  phase.intervals = check.Integer("discretization.single_support_intervals",
                                  request.discretization.single_support_intervals, kDefaultIntervals, 1, 1000);
  checked.phases = {phase};
  return checked;
}

}  // namespace rollgait
