#include "client/simulation_end.h"

namespace rollgait::client {

std::string SimulationEndText(v1::SimulationReport::End end) {
  switch (end) {
    case v1::SimulationReport::END_DURATION:
      return "reached the end";
    case v1::SimulationReport::END_IMPACT_COUNT:
      return "ended at the impact asked for";
    case v1::SimulationReport::END_FRICTION_LOST:
      return "ended where friction was lost";
    case v1::SimulationReport::END_STEP_TOO_SMALL:
      return "ended early: the tolerance cannot be met; loosen it, unless a body comes to rest on an almost flat "
             "surface";
    case v1::SimulationReport::END_NOT_FINITE:
      return "ended early: the accelerations are not finite; is a flat surface in contact?";
    case v1::SimulationReport::END_TOO_MANY_STEPS:
      return "ended early: too many steps; raise max_steps or loosen the tolerance";
    case v1::SimulationReport::END_FRICTION_UNDETERMINED:
      return "ended early: friction leaves the motion undetermined; lower a coefficient or use fewer contacts";
    case v1::SimulationReport::END_ROLLING_IMPOSSIBLE:
      return "ended early: a contact would have to pull to go on rolling, and closes if it is let go; give it a "
             "friction coefficient and FRICTION_LOSS_SLIDE";
    case v1::SimulationReport::END_TOO_MANY_EVENTS:
      return "ended early: too many events; raise max_events";
    default:
      return "was stopped";
  }
}

bool IsCompleted(v1::SimulationReport::End end) {
  return end == v1::SimulationReport::END_DURATION || end == v1::SimulationReport::END_IMPACT_COUNT ||
         end == v1::SimulationReport::END_FRICTION_LOST;
}

}  // namespace rollgait::client
