// The ground that a body walks on, as the formats state it.
#ifndef ROLLGAIT_CLIENT_FORMATS_GROUND_H_
#define ROLLGAIT_CLIENT_FORMATS_GROUND_H_

#include <Eigen/Core>
#include <string>

#include "rollgait/v1/solve.pb.h"

namespace rollgait::client {

struct Ground {
  double slope_rad = 0;  // positive is uphill in the direction of walking
  double gravity_m_s2 = 9.81;
  double friction = 0.8;

  // Acceleration of gravity, m/s², in world axes: fixed to the ground, x along it in the direction of walking, y left,
  // z its normal.
  Eigen::Vector3d Gravity() const;
  // For comments of files: the axes, the slope and the friction in words.
  std::string Describe() const;
};

// What the request of the solve says, with the service's defaults.
Ground GroundOf(const v1::Solve& solve);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_FORMATS_GROUND_H_
