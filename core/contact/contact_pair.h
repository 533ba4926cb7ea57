#ifndef ROLLGAIT_CORE_CONTACT_CONTACT_PAIR_H_
#define ROLLGAIT_CORE_CONTACT_CONTACT_PAIR_H_

#include "core/base/types.h"
#include "core/geometry/surface.h"

namespace rollgait {

// Where a body frame B is and how it moves. World axes; classical derivatives of its origin. The accelerations are
// whatever part of them the caller passes: the bias at zero joint accelerations, or all of it.
struct FrameMotion {
  Matrix3 R_WB = Matrix3::Identity();
  Vector3 p_WB = Vector3::Zero();                              // m
  Vector3 w_WB = Vector3::Zero(), v_WB = Vector3::Zero();      // rad/s, m/s
  Vector3 alpha_WB = Vector3::Zero(), a_WB = Vector3::Zero();  // rad/s², m/s²
};

// A surface fixed to a body frame B: its origin and its axes.
struct PlacedSurface {
  Surface surface = Sphere(1);
  Vector3 p_BE = Vector3::Zero();      // m
  Matrix3 R_BE = Matrix3::Identity();  // surface axes -> body axes
};

// A plane fixed to a (possibly moving) body frame B. The unit normal points out of the ground, towards the other body.
struct PlacedPlane {
  Vector3 p_BO = Vector3::Zero();  // m, a point of the plane
  Vector3 n_B = Vector3::UnitZ();
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_CONTACT_CONTACT_PAIR_H_
