#include <Eigen/Geometry>

#include "core/contact/pair_tangent.h"
#include "core/contact/surface_pair.h"

namespace rollgait {

PosedSurface Pose(const PlacedSurface& placed, const FrameMotion& body) {
  return {&placed.surface, body.R_WB * placed.R_BE, body.p_WB + body.R_WB * placed.p_BE};
}

PairKinematics ComputeSurfaceContact(const PlacedSurface& surface_1, const FrameMotion& body_1,
                                     const PlacedSurface& surface_2, const FrameMotion& body_2,
                                     const Separation& separation) {
  const Vector3& nu = separation.nu;
  const Vector3 &omega_1 = body_1.w_WB, &omega_2 = body_2.w_WB;
  const Vector3 r_1 = body_1.R_WB * surface_1.p_BE + separation.r_1;
  const Vector3 r_2 = body_2.R_WB * surface_2.p_BE + separation.r_2;

  PairKinematics result;
  result.p_1 = body_1.p_WB + r_1;
  result.p_2 = body_2.p_WB + r_2;
  result.normal = -nu;
  result.gap = separation.distance;
  result.slip = (body_1.v_WB - body_2.v_WB) + (omega_1.cross(r_1) - omega_2.cross(r_2));
  result.gap_rate = -nu.dot(result.slip);

  const PairTangent tangent(Pose(surface_1, body_1), Pose(surface_2, body_2), nu, separation.distance);
  result.regular = tangent.finite;
  if (!result.regular) {
    result.normal_dot = result.p_dot_1 = result.p_dot_2 = result.drift = Vector3::Constant(kInfinity);
    result.gap_acceleration = kInfinity;
    return result;
  }
  // M ν̇ = S₁(ω₁×ν) + S₂(ω₂×ν) − P w, on the tangent plane.
  const Eigen::Vector2d turn_1 = tangent.Components(omega_1.cross(nu));
  const Eigen::Vector2d turn_2 = tangent.Components(omega_2.cross(nu));
  const Eigen::Vector2d slip = tangent.Components(result.slip);
  const Eigen::Vector2d nu_dot = tangent.Solve(tangent.S_1 * turn_1 + tangent.S_2 * turn_2 - slip);
  const Vector3 r_1_dot = omega_1.cross(r_1) + tangent.basis * (tangent.S_1 * (nu_dot - turn_1));
  const Vector3 r_2_dot = omega_2.cross(r_2) - tangent.basis * (tangent.S_2 * (nu_dot - turn_2));
  result.normal_dot = -(tangent.basis * nu_dot);
  result.p_dot_1 = body_1.v_WB + r_1_dot;
  result.p_dot_2 = body_2.v_WB + r_2_dot;
  result.drift = (body_1.a_WB - body_2.a_WB) + (body_1.alpha_WB.cross(r_1) - body_2.alpha_WB.cross(r_2)) +
                 (omega_1.cross(r_1_dot) - omega_2.cross(r_2_dot));
  result.gap_acceleration = result.normal_dot.dot(result.slip) + result.normal.dot(result.drift);
  return result;
}

void SurfacePair::StartFrom(const Vector3& nu) {
  separation_.nu = nu;
  warm_ = true;
}

PairKinematics SurfacePair::Compute(const FrameMotion& body_1, const FrameMotion& body_2) {
  const Vector3 start = separation_.nu;
  separation_ = FindSeparation(Pose(surface_1_, body_1), Pose(surface_2_, body_2), warm_ ? &start : nullptr);
  warm_ = true;
  return ComputeSurfaceContact(surface_1_, body_1, surface_2_, body_2, separation_);
}

}  // namespace rollgait
