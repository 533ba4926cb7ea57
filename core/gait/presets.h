#ifndef ROLLGAIT_CORE_GAIT_PRESETS_H_
#define ROLLGAIT_CORE_GAIT_PRESETS_H_

#include <vector>

#include "core/gait/gait_spec.h"

namespace rollgait {

// rollgait.v1.Preset says what the presets are, docs/explanation/walking.md measures them. A preset fills only what a
// request leaves open; combined_costs.h says how its costs and those of the request become one cost.

// Feet, duty factor and clearance.
void FillFromPreset(GaitRequest* request);

// The terms of the cost for a body. Weights are chosen at 75 kg and 9.81 m/s² and scaled so that the optimum of a body
// of the same proportions, another mass and another gravity is the same motion in the time of that gravity. `human` and
// `transport` also ask for passive torques in proportion to gravity (GaitSpec::passive_scale), and all for the limits
// below.
std::vector<GaitRequest::CostTerm> PresetCosts(Preset preset, const Scene& scene, const Similarity& similarity);

// What a preset makes of limits of velocity and effort that are given for 9.81 m/s² (and, of efforts, for the body's
// mass): they follow gravity as the motion does. Costs of muscles take the limits of effort as strengths.
void ScaleLimits(const Similarity& similarity, std::vector<Joint>* joints);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_PRESETS_H_
