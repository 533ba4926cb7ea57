#include "core/models/rigid_body.h"

#include "core/base/check.h"

namespace rollgait {

RigidBody Shifted(const RigidBody& body, const Vector3& origin) {
  RigidBody shifted = body;
  shifted.center_of_mass += origin;
  return shifted;
}

RigidBody Lumped(const std::vector<RigidBody>& bodies) {
  RigidBody sum;
  for (const RigidBody& body : bodies) {
    sum.mass += body.mass;
    sum.center_of_mass += body.mass * body.center_of_mass;
  }
  ROLLGAIT_CHECK(sum.mass > 0);
  sum.center_of_mass /= sum.mass;
  for (const RigidBody& body : bodies) {
    const Vector3 offset = body.center_of_mass - sum.center_of_mass;
    sum.inertia += body.inertia +
                   body.mass * (offset.squaredNorm() * Matrix3::Identity() - offset * offset.transpose());
  }
  return sum;
}

}  // namespace rollgait
