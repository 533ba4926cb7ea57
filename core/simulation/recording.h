#ifndef ROLLGAIT_CORE_SIMULATION_RECORDING_H_
#define ROLLGAIT_CORE_SIMULATION_RECORDING_H_

#include "core/simulation/scene_dynamics.h"
#include "core/simulation/simulation.h"

namespace rollgait {

// What a simulation tells of an instant. `dynamics` has just evaluated its right side at (time, x).
SimulationSample MakeSample(double time, const VectorX& x, SceneDynamics* dynamics);

// Takes the instant into the extremes of the report: energy, normal forces, friction; without projection gaps and
// slips.
void RecordExtremes(const SimulationScene& scene, double time, const VectorX& x, SceneDynamics* dynamics,
                    SimulationReport* report);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_SIMULATION_RECORDING_H_
