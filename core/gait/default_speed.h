#ifndef ROLLGAIT_CORE_GAIT_DEFAULT_SPEED_H_
#define ROLLGAIT_CORE_GAIT_DEFAULT_SPEED_H_

namespace rollgait {

// Of a walk whose request says nothing of speed, m/s: people's own choice on level ground.
constexpr double kDefaultSpeed = 1.3;

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_DEFAULT_SPEED_H_
