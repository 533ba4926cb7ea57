#ifndef ROLLGAIT_CORE_VALIDATION_MOTION_DIFFERENCE_H_
#define ROLLGAIT_CORE_VALIDATION_MOTION_DIFFERENCE_H_

#include <array>
#include <string>
#include <vector>

#include "core/models/scene.h"
#include "core/trajectory/trajectory.h"

namespace rollgait {

// The kinds of quantities in which two motions of one scene are compared.
enum class MotionQuantity {
  kAngle,            // positions of revolute joints, rad
  kPlace,            // positions of prismatic joints, m
  kAngularVelocity,  // rad/s
  kLinearVelocity,   // m/s
  kTorque,           // efforts of revolute joints, N m
  kForce,            // efforts of prismatic joints, N
  kContactForce,     // of a contact surface on the body, N
};
inline constexpr int kMotionQuantityCount = 7;

struct MotionQuantityTraits {
  MotionQuantity quantity;
  const char* name;  // "joint angle"
  const char* unit;  // "rad"
};

// One for each quantity, in their order.
const std::array<MotionQuantityTraits, kMotionQuantityCount>& MotionQuantities();

// How far two motions are apart in one quantity. All are 0 where the scene has no such quantity.
struct QuantityDifference {
  double largest = 0;  // |difference| over all instants and joints; of a contact, the norm
  double rms = 0;      // over time, of the joint or contact whose root mean square is largest
  double peak = 0;     // of the largest absolute value that a joint or a contact reaches, largest over them
  std::string where;   // the joint or contact of `largest`
  int phase = 0;       // and its phase, with the time from the start of the first trajectory, s
  double time = 0;
};

using MotionDifference = std::array<QuantityDifference, kMotionQuantityCount>;

// Compares two trajectories of the scene at equal fractions of their phases, so that a contact change that comes
// earlier does not count as a jump of forces: how much earlier, the durations tell. Instants are the four Gauss points
// between neighbouring nodes of either mesh, where the root mean square of the polynomials of Radau-2 is exact.
// Contract: both fit the scene, whose joints have one degree of freedom each, and have the same phases with the same
// contacts.
MotionDifference CompareMotions(const Scene& scene, const Trajectory& trajectory, const Trajectory& other);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_VALIDATION_MOTION_DIFFERENCE_H_
