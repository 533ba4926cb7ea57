#ifndef ROLLGAIT_CORE_GAIT_DEFAULT_SPEED_H_
#define ROLLGAIT_CORE_GAIT_DEFAULT_SPEED_H_

#include <cmath>

namespace rollgait {

// m/s², where a request says nothing of gravity.
constexpr double kDefaultGravity = 9.81;

// Of a walk whose request says nothing of speed, m/s: people's own choice on level ground, 1.3 at 9.81 m/s², with the
// same Froude number at another gravity. Contract: gravity > 0.
inline double DefaultSpeed(double gravity) { return 1.3 * std::sqrt(gravity / kDefaultGravity); }

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_DEFAULT_SPEED_H_
