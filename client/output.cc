#include "client/output.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "client/failure.h"
#include "client/gait_events_table.h"
#include "client/json.h"
#include "client/report/gait_events_data.h"
#include "client/report/stride.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

constexpr int kStrideIntervals = kCycleSteps;
constexpr int kDigits = 12;

std::string Ending(const std::string& path) { return std::filesystem::path(path).extension().string(); }

const v1::Trajectory& TrajectoryOf(const v1::Solve& solve) {
  if (!solve.has_result() || !solve.result().has_trajectory() || solve.result().trajectory().phases_size() == 0) {
    throw Failure(ExitCode::kNoSolution, solve.name() + " has no trajectory to write (state " +
                                             StateName(solve.state()) + "); use a .json file to keep what it says");
  }
  return solve.result().trajectory();
}

bool IsPrismatic(const v1::Model& model, const std::string& joint) {
  for (const v1::Joint& candidate : model.joints()) {
    if (candidate.name() == joint) return candidate.type() == v1::Joint::TYPE_PRISMATIC;
  }
  return false;
}

// Values of one row of a matrix, each after a comma.
void AppendRow(const v1::Matrix& matrix, int row, std::string& line) {
  for (int j = 0; j < matrix.columns(); ++j) {
    const int index = row * matrix.columns() + j;
    line += "," + (index < matrix.values_size() ? FormatNumber(matrix.values(index), kDigits) : "");
  }
}

std::string CsvHeader(const v1::Trajectory& trajectory, const v1::Model& model) {
  std::string header = "time [s],phase [-]";
  const auto add = [&](const auto& names, const std::string& quantity, const std::string& angular,
                       const std::string& linear) {
    for (const std::string& name : names) {
      header += "," + name + " " + quantity + " [" + (IsPrismatic(model, name) ? linear : angular) + "]";
    }
  };
  add(trajectory.joint_names(), "position", "rad", "m");
  add(trajectory.joint_names(), "velocity", "rad/s", "m/s");
  add(trajectory.joint_names(), "acceleration", "rad/s^2", "m/s^2");
  add(trajectory.actuated_joint_names(), "effort", "N m", "N");
  for (const v1::ContactSurface& contact : model.contacts()) {
    for (const char* const axis : {"x", "y", "z"}) header += "," + contact.name() + " force " + axis + " [N]";
  }
  return header + "\n";
}

}  // namespace

void RequireOutputPath(const std::string& path) {
  const std::string ending = Ending(path);
  if (ending != ".json" && ending != ".csv" && ending != ".sto") {
    throw Failure(ExitCode::kUsage, "--output " + path + ": the name must end in .json, .csv or .sto");
  }
  const std::filesystem::path directory = std::filesystem::path(path).parent_path();
  const std::string place = directory.empty() ? "." : directory.string();
  if (access(place.c_str(), W_OK | X_OK) != 0) {
    throw Failure(ExitCode::kUsage, "--output " + path + ": cannot write in " + place + ": " + std::strerror(errno));
  }
}

void WriteSolve(const v1::Solve& solve, const std::string& path) {
  const std::string ending = Ending(path);
  WriteFile(path, ending == ".csv" ? ToCsv(solve) : ending == ".sto" ? ToSto(solve) : ToJsonText(solve));
}

std::string ToCsv(const v1::Solve& solve) {
  const v1::Trajectory& trajectory = TrajectoryOf(solve);
  const v1::Model& model = solve.result().model();
  std::string text = CsvHeader(trajectory, model);
  for (int p = 0; p < trajectory.phases_size(); ++p) {
    const v1::TrajectoryPhase& phase = trajectory.phases(p);
    for (int i = 0; i < phase.point_times_s_size(); ++i) {
      text += FormatNumber(phase.point_times_s(i), kDigits) + "," + std::to_string(p);
      AppendRow(phase.point_positions(), i, text);
      AppendRow(phase.point_velocities(), i, text);
      AppendRow(phase.point_accelerations(), i, text);
      AppendRow(phase.point_efforts(), i, text);
      for (const v1::ContactSurface& contact : model.contacts()) {
        int column = -1;
        for (int c = 0; c < phase.contacts_size(); ++c) {
          if (phase.contacts(c) == contact.name()) column = c;
        }
        for (int axis = 0; axis < 3; ++axis) {
          const int index = i * phase.point_forces().columns() + 3 * column + axis;
          const bool known = column >= 0 && index < phase.point_forces().values_size();
          text += "," + FormatNumber(known ? phase.point_forces().values(index) : 0.0, kDigits);
        }
      }
      text += "\n";
    }
  }
  return text;
}

std::string ToSto(const v1::Solve& solve) {
  const v1::Trajectory& trajectory = TrajectoryOf(solve);
  const v1::Model& model = solve.result().model();
  const v1::GaitEvents& events = solve.result().gait_events();
  const Stride stride = BuildStride(trajectory, model, events.start_s(), kStrideIntervals);
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
    text += FormatNumber(sample.time_s, kDigits);
    const auto add = [&text](double value) { text += "\t" + FormatNumber(value, kDigits); };
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
