#include "core/gait/warm_start.h"

#include <string>
#include <vector>

#include "core/base/check.h"
#include "core/gait/gait_spec.h"

namespace rollgait {
namespace {

std::string Names(const GaitSpec& spec, const std::vector<int>& contacts) {
  std::string names;
  for (const int contact : contacts) names += (names.empty() ? "" : " + ") + spec.scene.contacts[contact].name;
  return names;
}

std::string Span(Cycle cycle) {
  switch (cycle) {
    case Cycle::kHalf:
      return "one step (CYCLE_HALF, which its mirror image completes)";
    case Cycle::kFull:
      return "two steps (CYCLE_FULL)";
    case Cycle::kOnce:
      return "a manoeuvre (CYCLE_ONCE)";
  }
  ROLLGAIT_CHECK(false);
}

// What a request of another cycle may do to start from a solution of `cycle`.
std::string HowToMatch(Cycle cycle) {
  std::string other = "start from a solve of the cycle that this request asks for";
  if (cycle == Cycle::kHalf) return "give `cycle` CYCLE_HALF, or " + other;
  if (cycle == Cycle::kFull) return "give `cycle` CYCLE_FULL, or " + other;
  return other;
}

}  // namespace

Violations CheckWarmStart(const GaitSpec& spec, const Trajectory& trajectory) {
  const auto refuse = [](const std::string& reason) { return Violations{{"warm_start", "its solution " + reason}}; };
  if (trajectory.cycle != spec.cycle) {
    return refuse("is " + Span(trajectory.cycle) + ", this request asks for " + Span(spec.cycle) +
                  (spec.is_full_by_body
                       ? ", because left and right of its body differ; start from a solve of such a body"
                         ", or of a request with cycle CYCLE_FULL"
                       : "; " + HowToMatch(trajectory.cycle)));
  }
  if (trajectory.scheme != ReturnedAs(spec.scheme))
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
