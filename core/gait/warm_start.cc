#include "core/gait/warm_start.h"

#include <string>
#include <vector>

#include "core/gait/gait_spec.h"

namespace rollgait {
namespace {

std::string Names(const GaitSpec& spec, const std::vector<int>& contacts) {
  std::string names;
  for (const int contact : contacts) names += (names.empty() ? "" : " + ") + spec.scene.contacts[contact].name;
  return names;
}

}  // namespace

Violations CheckWarmStart(const GaitSpec& spec, const Trajectory& trajectory) {
  const auto refuse = [](const std::string& reason) { return Violations{{"warm_start", "its solution " + reason}}; };
  if (trajectory.cycle != spec.cycle) return refuse("spans another cycle; it must be that of this request");
  if (trajectory.scheme != spec.scheme)
    return refuse("has another discretization.scheme; it must be that of this request");
  if (trajectory.phases.size() != spec.phases.size()) {
    return refuse("has " + std::to_string(trajectory.phases.size()) + " phases, this request has " +
                  std::to_string(spec.phases.size()) + "; they must be the same");
  }
  for (size_t p = 0; p < spec.phases.size(); ++p) {
    const TrajectoryPhase& phase = trajectory.phases[p];
    if (phase.contacts != spec.phases[p].contacts) {
      return refuse("stands on " + Names(spec, phase.contacts) + " in phase " + std::to_string(p) +
                    ", this request on " + Names(spec, spec.phases[p].contacts) + "; they must be the same");
    }
    if (phase.node_positions.rows() != spec.scene.model.size()) {
      return refuse("has " + std::to_string(phase.node_positions.rows()) + " joints, the model of this request has " +
                    std::to_string(spec.scene.model.size()) + "; they must be the same");
    }
  }
  return {};
}

}  // namespace rollgait
