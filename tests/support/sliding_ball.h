#ifndef ROLLGAIT_TESTS_SUPPORT_SLIDING_BALL_H_
#define ROLLGAIT_TESTS_SUPPORT_SLIDING_BALL_H_

#include "core/multibody/configuration.h"
#include "core/simulation/scene.h"

namespace rollgait::testing {

inline constexpr double kG = 9.81, kRadius = 0.11, kMass = 2.3;

// A homogeneous ball on the plane z = 0 under `gravity`, that may slide; velocity and angular velocity at the start.
inline SimulationScene Ball(double friction, const Vector3& gravity, const Vector3& v, const Vector3& omega) {
  Joint joint;
  joint.name = "ball", joint.type = JointType::kFree, joint.mass = kMass;
  joint.inertia = 0.4 * kMass * kRadius * kRadius * Matrix3::Identity();
  SceneContact contact;
  contact.contact.name = "ground";
  contact.contact.surface.surface = Sphere(kRadius);
  contact.active = true;
  contact.friction = friction;
  contact.friction_loss = FrictionLoss::kSlide;
  SimulationScene scene{
      "ball", Model::Create({joint}).value(), {0.0}, {GroundMotion{}}, {contact}, gravity, {}, {}, {}, -1, {}};
  scene.q = NeutralConfiguration(scene.model);
  scene.q[6] = kRadius;
  scene.v.resize(6);
  scene.v << omega, v;
  scene.options.tolerance = 1e-12;
  return scene;
}

}  // namespace rollgait::testing

#endif  // ROLLGAIT_TESTS_SUPPORT_SLIDING_BALL_H_
