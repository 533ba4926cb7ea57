#ifndef ROLLGAIT_CORE_MODELS_PASSIVE_TORQUE_H_
#define ROLLGAIT_CORE_MODELS_PASSIVE_TORQUE_H_

#include <string>
#include <vector>

#include "core/math/exponential_spring.h"

namespace rollgait {

// What ligaments and stretched muscles of a person of the given mass (kg) exert on a joint of the human, by its name with or
// without side: rad -> N m, signs as in human.h. No spring for joints of which nothing is known: the arms.
// Proportional to body mass (assumption). Joints that share a muscle are taken one by one, the others as in mid-stance: ankle
// at 0, knee at 15°, hip at 10° of flexion.
ExponentialSpring PassiveTorque(const std::string& joint, double mass);

// Where the numbers come from.
std::vector<std::string> PassiveTorqueSources();

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MODELS_PASSIVE_TORQUE_H_
