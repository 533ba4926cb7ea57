#include "client/formats/sto.h"

#include "client/gait_events_table.h"
#include "client/report/gait_events_data.h"
#include "client/report/stride.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

constexpr int kStoDigits = 12;

}  // namespace

std::string ToSto(const v1::Solve& solve) {
  const v1::Trajectory& trajectory = solve.result().trajectory();
  const v1::Model& model = solve.result().model();
  const v1::GaitEvents& events = solve.result().gait_events();
  const Stride stride = BuildStride(trajectory, model, events.start_s(), kCycleSteps);
  for (const v1::FootOnGround& foot : events.feet()) RequireInstants(foot);
  std::string labels = "time";
  int columns = 1;
  const auto label = [&](const std::string& name) {
    labels += "\t" + name;
    ++columns;
  };
  for (const v1::Joint& joint : model.joints()) label(joint.name());
  for (const v1::Joint& joint : model.joints()) label(joint.name() + "_u");
  for (const v1::Joint& joint : model.joints()) {
    if (joint.actuated()) label(joint.name() + "_effort");
  }
  for (const v1::ContactSurface& contact : model.contacts()) {
    for (const char* const axis : {"x", "y", "z"}) label(contact.name() + "_force_v" + axis);
  }
  for (const v1::FootOnGround& foot : events.feet()) {
    const std::string name = SideName(foot.foot()) + "_ground_force_";
    for (const char* const column : {"vx", "vy", "vz", "px", "py"}) label(name + column);
  }

  std::string text =
      (solve.name().empty() ? "rollgait" : solve.name()) +
      "\nversion=1\nnRows=" + std::to_string(stride.samples.size()) + "\nnColumns=" + std::to_string(columns) +
      "\ninDegrees=no\nRollgait: " +
      (solve.spec().has_manoeuvre() ? "a manoeuvre" : "one gait cycle from heel strike of the right foot") +
      ". SI units: rad, m, rad/s (_u), N m "
      "(_effort), N (_force_v, sums over the surfaces of a foot in _ground_force_v), centre of pressure in m "
      "(_ground_force_p, nan below 1 % of body weight). Axes fixed to the ground: x along it in the direction of "
      "walking, y left, z its "
      "normal; slope " +
      FormatNumber(solve.spec().slope_rad() * 180 / kPi) + " deg.\nendheader\n" + labels + "\n";
  for (size_t row = 0; row < stride.samples.size(); ++row) {
    const StrideSample& sample = stride.samples[row];
    text += FormatNumber(sample.time_s, kStoDigits);
    const auto add = [&text](double value) { text += "\t" + FormatNumber(value, kStoDigits); };
    for (const double value : sample.instant.position) add(value);
    for (const double value : sample.instant.velocity) add(value);
    for (int i = 0; i < model.joints_size(); ++i) {
      if (model.joints(i).actuated()) add(sample.instant.effort[i]);
    }
    for (const auto& force : sample.instant.force) {
      for (const double value : force) add(value);
    }
    for (const v1::FootOnGround& foot : events.feet()) {
      const auto at = [row](const v1::Matrix& matrix, int column) {
        return matrix.values(static_cast<int>(row) * matrix.columns() + column);
      };
      for (int axis = 0; axis < 3; ++axis) add(at(foot.force_n(), axis));
      for (int axis = 0; axis < 2; ++axis) add(at(foot.center_of_pressure_m(), axis));
    }
    text += "\n";
  }
  return text;
}

}  // namespace rollgait::client
