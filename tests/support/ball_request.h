#ifndef ROLLGAIT_TESTS_SUPPORT_BALL_REQUEST_H_
#define ROLLGAIT_TESTS_SUPPORT_BALL_REQUEST_H_

#include <Eigen/Geometry>

#include "core/gait/gait_spec.h"

namespace rollgait {

// The default ball: radius 0.1 m, 1 kg, homogeneous.
inline constexpr double kBallRadius = 0.1, kBallSpin = 0.4 * 0.01, kBallRoll = 1.4 * 0.01;  // m, kg m²

inline Eigen::Vector4d Quaternion(const Vector3& turn) {
  const double angle = turn.norm();
  const Eigen::Quaterniond q(Eigen::AngleAxisd(angle, angle > 0 ? Vector3(turn / angle) : Vector3::UnitX()));
  return {q.w(), q.x(), q.y(), q.z()};
}

// From rest at the origin to rest at (x, y); the orientation at the end is free.
inline GaitRequest RollTo(double x, double y, double duration) {
  GaitRequest request;
  request.body.model = "ball";
  request.cycle = Cycle::kOnce;
  request.normalization = GaitRequest::Normalization::kNone;
  request.manoeuvre.emplace();
  request.manoeuvre->end.x = x;
  request.manoeuvre->end.y = y;
  request.manoeuvre->duration = duration;
  return request;
}

// And turned by a rotation vector (rad).
inline GaitRequest RollTo(double x, double y, double duration, const Vector3& turn) {
  GaitRequest request = RollTo(x, y, duration);
  request.manoeuvre->end.orientation = Quaternion(turn);
  return request;
}

}  // namespace rollgait

#endif  // ROLLGAIT_TESTS_SUPPORT_BALL_REQUEST_H_
