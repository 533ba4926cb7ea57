#ifndef ROLLGAIT_CORE_MODELS_JOINT_LIMITS_H_
#define ROLLGAIT_CORE_MODELS_JOINT_LIMITS_H_

#include <string>
#include <vector>

namespace rollgait {

// Largest |base_roll| of the chart of the floating base, degrees.
inline constexpr double kLargestBaseRoll = 60;

// What a joint of a person may do. Signs as in human.h.
struct JointLimits {
  const char* joint;                  // name without "_l" or "_r"
  double position_min, position_max;  // degrees, anatomical
  double walking_min, walking_max;    // degrees, JointRanges::kWalking
  double velocity;                    // rad/s
  double effort_per_mass;             // N m/kg, both directions
};

// The limits of a joint of the human by its name without side. The translations of the base have none. Contract: the
// human has such a joint.
const JointLimits& LimitsOf(const std::string& joint);

// Where the numbers come from.
std::vector<std::string> JointLimitSources();

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MODELS_JOINT_LIMITS_H_
