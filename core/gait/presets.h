#ifndef ROLLGAIT_CORE_GAIT_PRESETS_H_
#define ROLLGAIT_CORE_GAIT_PRESETS_H_

#include <vector>

#include "core/gait/gait_request.h"

namespace rollgait {

// What the presets are is said in rollgait.v1.Preset and measured in docs/walking.md. A preset fills only what a request
// leaves open; its costs take the place of costs, which a request with a preset must not give.

// Feet, duty factor and clearance.
void FillFromPreset(GaitRequest* request);

// The terms of the cost for a body. Weights are chosen at 75 kg and scaled so that the optimum of a body of the same
// proportions and another mass is the same motion.
std::vector<GaitRequest::CostTerm> PresetCosts(Preset preset, const Scene& scene);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_PRESETS_H_
