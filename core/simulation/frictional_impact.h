#ifndef ROLLGAIT_CORE_SIMULATION_FRICTIONAL_IMPACT_H_
#define ROLLGAIT_CORE_SIMULATION_FRICTIONAL_IMPACT_H_

#include <optional>
#include <vector>

#include "core/contact/impact.h"
#include "core/simulation/scene_dynamics.h"

namespace rollgait {

// ResolveImpact at (t, x) for a scene whose contacts may slide. Those stick in the impact if the cone of friction holds
// their impulse; those that cannot, slide on in the direction in which they came, with a friction impulse of μ times
// the normal one. Leaves `dynamics` at (t, x) with contacts sliding or not as after the impact. Nothing if one of them
// would be turned back within the impact, or if the impulses are not determined.
std::optional<Impact> ResolveFrictionalImpact(const SimulationScene& scene, const std::vector<int>& touching,
                                              const std::vector<int>& must_hold, double t, const VectorX& x,
                                              SceneDynamics* dynamics);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_SIMULATION_FRICTIONAL_IMPACT_H_
