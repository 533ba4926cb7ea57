#ifndef ROLLGAIT_CORE_MODELS_PASSIVE_TORQUE_H_
#define ROLLGAIT_CORE_MODELS_PASSIVE_TORQUE_H_

#include <string>
#include <vector>

#include "core/math/exponential_spring.h"
#include "core/multibody/model.h"

namespace rollgait {

// What ligaments and stretched muscles of a person of the given mass (kg) exert on a joint (Joint::passive): rad -> N
// m. Hip, knee and ankle of people as measured, proportional to body mass (assumption), each with the joints that share
// its muscles as in mid-stance: ankle at 0, knee at 15°, hip at 10° of flexion. Stops: near the ends of the joint's
// range (assumption), whatever the mass; contract: finite range and effort_max. kNone: none, at every angle.
ExponentialSpring PassiveTorque(const Joint& joint, double mass);

// Where the numbers come from.
std::vector<std::string> PassiveTorqueSources();

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MODELS_PASSIVE_TORQUE_H_
