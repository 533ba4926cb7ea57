#include "client/formats/points_csv.h"

#include "client/joint_kinds.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

constexpr int kCsvDigits = 12;

bool IsSlideOf(const v1::Model& model, const std::string& joint) {
  for (const v1::Joint& candidate : model.joints()) {
    if (candidate.name() == joint) return IsSlide(candidate);
  }
  return false;
}

// Values of one row of a matrix, each after a comma.
void AppendRow(const v1::Matrix& matrix, int row, std::string& line) {
  for (int j = 0; j < matrix.columns(); ++j) {
    const int index = row * matrix.columns() + j;
    line += "," + (index < matrix.values_size() ? FormatNumber(matrix.values(index), kCsvDigits) : "");
  }
}

std::string CsvHeader(const v1::Trajectory& trajectory, const v1::Model& model) {
  std::string header = "time [s],phase [-]";
  const auto add = [&](const auto& names, const std::string& quantity, const std::string& angular,
                       const std::string& linear) {
    for (const std::string& name : names) {
      header += "," + name + " " + quantity + " [" + (IsSlideOf(model, name) ? linear : angular) + "]";
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

std::string ToCsv(const v1::Solve& solve) {
  const v1::Trajectory& trajectory = solve.result().trajectory();
  const v1::Model& model = solve.result().model();
  std::string text = CsvHeader(trajectory, model);
  for (int p = 0; p < trajectory.phases_size(); ++p) {
    const v1::TrajectoryPhase& phase = trajectory.phases(p);
    for (int i = 0; i < phase.point_times_s_size(); ++i) {
      text += FormatNumber(phase.point_times_s(i), kCsvDigits) + "," + std::to_string(p);
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
          text += "," + FormatNumber(known ? phase.point_forces().values(index) : 0.0, kCsvDigits);
        }
      }
      text += "\n";
    }
  }
  return text;
}

}  // namespace rollgait::client
