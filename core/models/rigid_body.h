#ifndef ROLLGAIT_CORE_MODELS_RIGID_BODY_H_
#define ROLLGAIT_CORE_MODELS_RIGID_BODY_H_

#include <vector>

#include "core/base/types.h"

namespace rollgait {

// Mass properties of a rigid body in some frame. Value.
struct RigidBody {
  double mass = 0;                           // kg
  Vector3 center_of_mass = Vector3::Zero();  // m
  Matrix3 inertia = Matrix3::Zero();         // kg m², about the centre of mass, axes of the frame
};

// The same body seen from a frame with the same axes, in which the body's frame origin is at `origin` (m).
RigidBody Shifted(const RigidBody& body, const Vector3& origin);

// The same body seen from a frame in which the body's frame has orientation R (its axes -> the new ones) and origin p
// (m).
RigidBody Placed(const RigidBody& body, const Matrix3& R, const Vector3& p);

// What is left of `whole` when `part` is cut off; both in the same frame. Contract: the part has less mass.
RigidBody CutOff(const RigidBody& whole, const RigidBody& part);

// The bodies fixed to each other as one, by the parallel-axis theorem; all in the same frame. Contract: total mass > 0.
RigidBody Lumped(const std::vector<RigidBody>& bodies);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MODELS_RIGID_BODY_H_
