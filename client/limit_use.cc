#include "client/limit_use.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "client/joint_kinds.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

constexpr double kNear = 1e-3;  // of the range or limit
constexpr double kLoadedShareOfWeight = 0.01;

std::string WithUnit(double value, const v1::Joint& joint, LimitKind kind) {
  const bool revolute = Turns(joint);
  switch (kind) {
    case LimitKind::kPosition:
      return revolute ? FormatNumber(value * 180 / kPi) + "°" : FormatNumber(value) + " m";
    case LimitKind::kVelocity:
      return FormatNumber(value) + (revolute ? " rad/s" : " m/s");
    default:
      return FormatNumber(value) + (revolute ? " N m" : " N");
  }
}

// Adds up the time on each limit.
class LimitClock {
 public:
  // The instant `time` stands for `weight` s, of `whole` s that the share is of.
  void Add(LimitKind kind, const std::string& where, const std::string& limit, double time, double weight) {
    const auto [at, is_new] = uses_.try_emplace({kind, where + "\n" + limit}, LimitUse{kind, where, limit, 0, time});
    at->second.share += weight;
  }
  std::vector<LimitUse> Take(const std::map<std::string, double>& stance_s, double duration) {
    std::vector<LimitUse> sorted;
    for (auto& [key, use] : uses_) {
      use.share /= use.kind == LimitKind::kFriction ? stance_s.at(use.where) : duration;
      sorted.push_back(std::move(use));
    }
    std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.share > b.share; });
    return sorted;
  }

 private:
  std::map<std::pair<LimitKind, std::string>, LimitUse> uses_;
};

// One value against a range whose ends may be infinite.
void AddRange(LimitKind kind, const v1::Joint& joint, double value, std::pair<double, double> range, double time,
              double weight, LimitClock& clock) {
  const auto [lower, upper] = range;
  const double width = upper - lower;
  if (!std::isfinite(width) || width <= 0) return;
  const bool low = value <= lower + kNear * width;
  if (!low && value < upper - kNear * width) return;
  clock.Add(kind, joint.name(),
            (low ? "lower limit of " : "upper limit of ") + WithUnit(low ? lower : upper, joint, kind), time, weight);
}

double At(const v1::Matrix& matrix, int row, int column) { return matrix.values(row * matrix.columns() + column); }

bool Fits(const v1::Matrix& matrix, int rows, int columns) {
  return matrix.rows() == rows && matrix.columns() == columns && matrix.values_size() == rows * columns;
}

void AddJoints(const v1::Trajectory& trajectory, const std::map<std::string, const v1::Joint*>& joints,
               const v1::TrajectoryPhase& phase, int point, double weight, LimitClock& clock) {
  const double time = phase.point_times_s(point);
  for (int j = 0; j < trajectory.joint_names_size(); ++j) {
    const v1::Joint& joint = *joints.at(trajectory.joint_names(j));
    AddRange(LimitKind::kPosition, joint, At(phase.point_positions(), point, j),
             {joint.position_min(), joint.position_max()}, time, weight, clock);
    const double speed = std::abs(At(phase.point_velocities(), point, j)), most = joint.velocity_max();
    if (std::isfinite(most) && most > 0 && speed >= (1 - kNear) * most) {
      clock.Add(LimitKind::kVelocity, joint.name(), "largest speed of " + WithUnit(most, joint, LimitKind::kVelocity),
                time, weight);
    }
  }
  for (int j = 0; j < trajectory.actuated_joint_names_size(); ++j) {
    const v1::Joint& joint = *joints.at(trajectory.actuated_joint_names(j));
    AddRange(LimitKind::kEffort, joint, At(phase.point_efforts(), point, j), {joint.effort_min(), joint.effort_max()},
             time, weight, clock);
  }
}

bool FitsModel(const v1::Trajectory& trajectory, const std::map<std::string, const v1::Joint*>& joints) {
  for (const std::string& name : trajectory.joint_names()) {
    if (joints.count(name) == 0) return false;
  }
  for (const std::string& name : trajectory.actuated_joint_names()) {
    if (joints.count(name) == 0) return false;
  }
  for (const v1::TrajectoryPhase& phase : trajectory.phases()) {
    const int points = phase.point_times_s_size(), columns = trajectory.joint_names_size();
    const bool fits = Fits(phase.point_positions(), points, columns) &&
                      Fits(phase.point_velocities(), points, columns) &&
                      Fits(phase.point_efforts(), points, trajectory.actuated_joint_names_size()) &&
                      Fits(phase.point_forces(), points, 3 * phase.contacts_size());
    if (!fits) return false;
  }
  return true;
}

}  // namespace

std::vector<LimitUse> FindLimitUse(const v1::Solve& solve) {
  const v1::Trajectory& trajectory = solve.result().trajectory();
  const v1::Model& model = solve.result().model();
  std::map<std::string, const v1::Joint*> joints;
  for (const v1::Joint& joint : model.joints()) joints[joint.name()] = &joint;
  if (trajectory.phases().empty() || !(trajectory.duration_s() > 0) || !FitsModel(trajectory, joints)) return {};
  const v1::GroundContact& ground = solve.spec().ground_contact();
  const double friction = ground.has_friction_coefficient() ? ground.friction_coefficient() : 0.8;
  const double loaded = kLoadedShareOfWeight * model.total_mass_kg() * model.gravity_m_s2();
  LimitClock clock;
  std::map<std::string, double> stance_s;
  for (const v1::TrajectoryPhase& phase : trajectory.phases()) {
    const int points = phase.point_times_s_size();
    for (const std::string& contact : phase.contacts()) stance_s[contact] += phase.duration_s();
    for (int point = 0; point < points; ++point) {
      const double weight = phase.duration_s() / points;
      AddJoints(trajectory, joints, phase, point, weight, clock);
      for (int c = 0; c < phase.contacts_size(); ++c) {
        const double x = At(phase.point_forces(), point, 3 * c), y = At(phase.point_forces(), point, 3 * c + 1);
        const double normal = At(phase.point_forces(), point, 3 * c + 2);
        if (normal < loaded || std::hypot(x, y) < (1 - kNear) * friction * normal) continue;
        clock.Add(LimitKind::kFriction, phase.contacts(c), "friction coefficient of " + FormatNumber(friction),
                  phase.point_times_s(point), weight);
      }
    }
  }
  return clock.Take(stance_s, trajectory.duration_s());
}

}  // namespace rollgait::client
