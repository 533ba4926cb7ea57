#include <Eigen/Geometry>

#include "core/contact/pair_kinematics.h"

namespace rollgait {

// Contact-math 3 to 5. The frame origins stand for C and o: nothing but the gap depends on which point of the plane is
// given.
PairKinematics ComputePlaneContact(const PlacedSurface& placed, const FrameMotion& body, const PlacedPlane& plane,
                                   const FrameMotion& plane_frame) {
  const Vector3& omega = body.w_WB;
  const Vector3& omega_2 = plane_frame.w_WB;
  const Matrix3 R_WE = body.R_WB * placed.R_BE;
  const Vector3 n = plane_frame.R_WB * plane.n_B;
  const Vector3 nu = -(R_WE.transpose() * n);
  const Surface& surface = placed.surface;
  const Vector3 x = surface.SupportPoint(nu);
  const Vector3 p_BE_W = body.R_WB * placed.p_BE;
  const Vector3 r = p_BE_W + R_WE * x;

  PairKinematics result;
  result.normal = n;
  result.p_1 = body.p_WB + r;
  const Vector3 offset = (body.p_WB - plane_frame.p_WB) + (p_BE_W - plane_frame.R_WB * plane.p_BO);
  result.gap = n.dot(offset) - surface.Support(nu);
  result.p_2 = result.p_1 - result.gap * n;
  const Vector3 lever_2 = result.p_1 - plane_frame.p_WB;
  result.slip = body.v_WB + omega.cross(r) - (plane_frame.v_WB + omega_2.cross(lever_2));
  result.gap_rate = n.dot(result.slip);
  result.normal_dot = omega_2.cross(n);

  const Vector3 over_surface = R_WE * surface.RollingVelocity(nu, R_WE.transpose() * (omega - omega_2));
  result.regular = over_surface.allFinite();
  if (!result.regular) {
    result.p_dot_1 = result.p_dot_2 = result.drift = Vector3::Constant(kInfinity);
    result.gap_acceleration = kInfinity;
    return result;
  }
  const Vector3 r_dot = omega.cross(r) + over_surface;
  result.p_dot_1 = body.v_WB + r_dot;
  result.p_dot_2 = result.p_dot_1 - result.gap_rate * n - result.gap * result.normal_dot;
  result.drift =
      body.a_WB + body.alpha_WB.cross(r) + omega.cross(r_dot) -
      (plane_frame.a_WB + plane_frame.alpha_WB.cross(lever_2) + omega_2.cross(result.p_dot_1 - plane_frame.v_WB));
  result.gap_acceleration = n.dot(result.drift) + result.normal_dot.dot(result.slip);
  return result;
}

PairLevers PlaneContactLevers(const PairKinematics& kinematics, const FrameMotion& body,
                              const FrameMotion& plane_frame) {
  return {kinematics.p_1 - body.p_WB, kinematics.p_1 - plane_frame.p_WB};
}

}  // namespace rollgait
