#ifndef ROLLGAIT_CORE_TRAJECTORY_MANOEUVRE_H_
#define ROLLGAIT_CORE_TRAJECTORY_MANOEUVRE_H_

#include <Eigen/Geometry>
#include <optional>

#include "core/base/types.h"

namespace rollgait {

// How a rolling body is at one end of a manoeuvre. World axes; what is empty is free.
struct BodyState {
  std::optional<double> x, y;                     // m, centre of the body; its height follows from the contact
  std::optional<Eigen::Quaterniond> orientation;  // unit, body -> world
  Vector3 angular_velocity = Vector3::Zero();     // rad/s; not zero only where the orientation is given
};

// From one state to another on one contact that rolls without slipping. The start is given in full.
struct Manoeuvre {
  BodyState start, end;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_TRAJECTORY_MANOEUVRE_H_
