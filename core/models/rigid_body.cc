#include "core/models/rigid_body.h"

#include "core/base/check.h"

namespace rollgait {

RigidBody Shifted(const RigidBody& body, const Vector3& origin) {
  RigidBody shifted = body;
  shifted.center_of_mass += origin;
  return shifted;
}

RigidBody Placed(const RigidBody& body, const Matrix3& R, const Vector3& p) {
  return {body.mass, p + R * body.center_of_mass, R * body.inertia * R.transpose()};
}

RigidBody CutOff(const RigidBody& whole, const RigidBody& part) {
  ROLLGAIT_CHECK(part.mass < whole.mass);
  RigidBody rest;
  rest.mass = whole.mass - part.mass;
  rest.center_of_mass = (whole.mass * whole.center_of_mass - part.mass * part.center_of_mass) / rest.mass;
  const Vector3 apart = part.center_of_mass - rest.center_of_mass;
  rest.inertia =
      whole.inertia - part.inertia -
      part.mass * rest.mass / whole.mass * (apart.squaredNorm() * Matrix3::Identity() - apart * apart.transpose());
  return rest;
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
    sum.inertia +=
        body.inertia + body.mass * (offset.squaredNorm() * Matrix3::Identity() - offset * offset.transpose());
  }
  return sum;
}

}  // namespace rollgait
