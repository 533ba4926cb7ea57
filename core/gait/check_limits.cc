#include <numbers>

#include "core/gait/presets.h"
#include "core/gait/request_check.h"
#include "core/models/joint_chain.h"
#include "core/models/joint_limits.h"

namespace rollgait {

std::vector<Joint> CheckLimits(const GaitRequest& request, const Scene* scene, const Similarity& similarity,
                               RequestCheck& check) {
  std::vector<Joint> joints;
  if (scene != nullptr) joints = scene->model.joints();
  if (request.preset) ScaleLimits(similarity, &joints);
  // Index of the joint to change, -1 if it is unknown or there is no scene.
  const auto find = [&](const std::string& field, const std::string& name, bool actuated) {
    return scene == nullptr ? -1 : check.Joint(field, name, *scene, actuated);
  };
  for (const auto& [name, range] : request.limits.joint_position) {
    const std::string field = Keyed("limits.joint_position", name);
    check.Range(field, range, {-kMaxPosition, kMaxPosition, "rad or m"}, false);
    if (const int joint = find(field, name, false); joint >= 0) {
      constexpr double kMost = kLargestBaseRoll * std::numbers::pi / 180;
      if (joints[joint].role == JointRole::kBaseRoll && (range.min < -kMost || range.max > kMost)) {
        check.Add(field, "the range " + FormatNumber(range.min) + " to " + FormatNumber(range.max) +
                             " leaves that of the chart of the floating base, " + FormatNumber(-kMost) + " to " +
                             FormatNumber(kMost) + "; stay within it");
      }
      if (const std::string problem = RangeProblem(scene->chains, joints, joint, range.min, range.max);
          !problem.empty()) {
        check.Add(field, problem);
      }
      joints[joint].position_min = range.min;
      joints[joint].position_max = range.max;
    }
  }
  for (const auto& [name, velocity] : request.limits.joint_velocity) {
    const std::string field = Keyed("limits.joint_velocity", name);
    check.Number(field, velocity, 0, {0, kMaxVelocity, "rad/s or m/s", true});
    if (const int joint = find(field, name, false); joint >= 0) joints[joint].velocity_max = velocity;
  }
  for (const auto& [name, range] : request.limits.joint_effort) {
    const std::string field = Keyed("limits.joint_effort", name);
    check.Range(field, range, {-kMaxEffort, kMaxEffort, "N m or N"}, false);
    if (range.min > 0 || range.max < 0) {
      check.Add(field, "the range " + FormatNumber(range.min) + " to " + FormatNumber(range.max) +
                           " does not contain 0; give min <= 0 <= max");
    }
    if (const int joint = find(field, name, true); joint >= 0) {
      joints[joint].effort_min = range.min;
      joints[joint].effort_max = range.max;
    }
  }
  return joints;
}

}  // namespace rollgait
