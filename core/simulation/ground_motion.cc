#include "core/simulation/ground_motion.h"

#include <Eigen/Geometry>
#include <cmath>

namespace rollgait {

FrameMotion MotionAt(const GroundMotion& m, double t) {
  const double w = 2 * M_PI * m.frequency, a = w * t + m.phase;
  const Vector3 d = m.velocity * t + 0.5 * t * t * m.acceleration + m.amplitude * std::sin(a);
  const Vector3 d_dot = m.velocity + m.acceleration * t + m.amplitude * (w * std::cos(a));
  const Vector3 d_ddot = m.acceleration - m.amplitude * (w * w * std::sin(a));
  const double ws = 2 * M_PI * m.swing_frequency, b = ws * t + m.swing_phase;
  const double theta = m.rate * t + 0.5 * t * t * m.angular_acceleration + m.swing * std::sin(b);
  const double theta_dot = m.rate + m.angular_acceleration * t + m.swing * ws * std::cos(b);
  const double theta_ddot = m.angular_acceleration - m.swing * ws * ws * std::sin(b);

  FrameMotion frame;
  frame.R_WB = Eigen::AngleAxisd(theta, m.axis).toRotationMatrix();
  frame.w_WB = theta_dot * m.axis;
  frame.alpha_WB = theta_ddot * m.axis;
  const Vector3 arm = -(frame.R_WB * m.pivot);  // pivot -> origin of the frame
  frame.p_WB = m.pivot + d + arm;
  frame.v_WB = d_dot + frame.w_WB.cross(arm);
  frame.a_WB = d_ddot + frame.alpha_WB.cross(arm) + frame.w_WB.cross(frame.w_WB.cross(arm));
  return frame;
}

}  // namespace rollgait
