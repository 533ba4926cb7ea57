#ifndef ROLLGAIT_CORE_SIMULATION_INITIAL_STATE_H_
#define ROLLGAIT_CORE_SIMULATION_INITIAL_STATE_H_

#include "core/base/result.h"
#include "core/simulation/scene_dynamics.h"

namespace rollgait {

// The state at t = 0 as SceneDynamics::MakeState: the scene's q and v with its adjusted joints computed (see
// SimulationScene). Violations: an active contact keeps a gap above 1e-7 of its distance from the joints, or a slip
// above 1e-7 of its speed (and 1e-9 m, m/s). A contact with FrictionLoss::kSlide that slips more is left sliding in
// `dynamics`.
Result<VectorX> InitialState(const SimulationScene& scene, SceneDynamics* dynamics);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_SIMULATION_INITIAL_STATE_H_
