#ifndef ROLLGAIT_CORE_SIMULATION_FRICTIONAL_IMPACT_H_
#define ROLLGAIT_CORE_SIMULATION_FRICTIONAL_IMPACT_H_

#include <optional>
#include <vector>

#include "core/contact/impact.h"
#include "core/simulation/scene_dynamics.h"

namespace rollgait {

// ResolveImpact at (t, x), where the gap of `contact` closes, for a scene whose contacts may slide: with the active
// contacts and those that close at the same instant, where only `contact` and bilateral ones must be held, or, where
// that is not consistent, only bilateral ones. Contacts stick in the impact if the cone of friction holds their
// impulse; those that cannot, slide on in the direction in which they came, with a friction impulse of μ times the
// normal one. Leaves `dynamics` at (t, x) with contacts sliding or not as after the impact. Nothing if one of them
// would be turned back within the impact, or if the impulses are not determined.
std::optional<Impact> ResolveTouchDown(const SimulationScene& scene, int contact, double t, const VectorX& x,
                                       SceneDynamics* dynamics);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_SIMULATION_FRICTIONAL_IMPACT_H_
