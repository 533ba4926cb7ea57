#ifndef ROLLGAIT_SERVER_CONVERT_SCENE_CONVERT_H_
#define ROLLGAIT_SERVER_CONVERT_SCENE_CONVERT_H_

#include "core/base/result.h"
#include "core/simulation/periodic_gait.h"
#include "core/simulation/simulation.h"
#include "rollgait/v1/simulation.pb.h"

namespace rollgait::server {

// Translates a scene and checks it (CheckScene); the violations name paths relative to the scene. Whether the state at
// t = 0 agrees with the contacts is found by Simulate.
Result<SimulationScene> DecodeScene(const v1::SimulationScene& scene);

v1::SimulationSample EncodeSample(const SimulationSample& sample);
v1::SimulationEvent EncodeEvent(const SimulationEvent& event, const SimulationScene& scene);
v1::SimulationReport EncodeReport(const SimulationReport& report, const SimulationScene& scene);
v1::PeriodicGait EncodeGait(const PeriodicGait& gait, const SimulationScene& scene);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_CONVERT_SCENE_CONVERT_H_
