#ifndef ROLLGAIT_CORE_GAIT_MANOEUVRE_REQUEST_H_
#define ROLLGAIT_CORE_GAIT_MANOEUVRE_REQUEST_H_

#include <optional>

#include "core/trajectory/manoeuvre.h"

namespace rollgait {

// A manoeuvre as it comes in: any numbers. Field for field rollgait.v1.Manoeuvre.
struct ManoeuvreRequest {
  struct State {
    std::optional<double> x, y;                  // m
    std::optional<Eigen::Vector4d> orientation;  // quaternion (w, x, y, z)
    Vector3 angular_velocity = Vector3::Zero();  // rad/s
  };
  State start, end;
  std::optional<double> duration;  // s
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_MANOEUVRE_REQUEST_H_
