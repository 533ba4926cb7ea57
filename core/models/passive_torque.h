#ifndef ROLLGAIT_CORE_MODELS_PASSIVE_TORQUE_H_
#define ROLLGAIT_CORE_MODELS_PASSIVE_TORQUE_H_

#include <string>
#include <vector>

#include "core/math/exponential_spring.h"
#include "core/multibody/model.h"

namespace rollgait {

// What ligaments and stretched muscles of a person of the given mass (kg) exert on a joint of the human (human.h): rad
// -> N m. Hip, knee and ankle as measured, proportional to body mass (assumption), each with the joints that share its
// muscles as in mid-stance: ankle at 0, knee at 15°, hip at 10° of flexion. The base has none; the others have stops
// near the ends of the joint's range (assumption).
ExponentialSpring PassiveTorque(const Joint& joint, double mass);

// Where the numbers come from.
std::vector<std::string> PassiveTorqueSources();

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MODELS_PASSIVE_TORQUE_H_
