#ifndef ROLLGAIT_TESTS_SUPPORT_STANDING_PLATE_H_
#define ROLLGAIT_TESTS_SUPPORT_STANDING_PLATE_H_

#include <vector>

#include "core/contact/contact_dynamics.h"
#include "core/multibody/configuration.h"

namespace rollgait::testing {

// A plate of 3 kg at rest on feet at `places` (m, from its centre of mass).
struct StandingPlate {
  StandingPlate(const std::vector<Vector3>& places, Grip grip)
      : dynamics(BodyDynamics(MakeModel()), Contacts(places, grip)) {
    VectorX q = NeutralConfiguration(MakeModel());
    q[6] = 0.5;
    dynamics.SetState(q, VectorX::Zero(6), {FrameMotion{}});
    for (size_t k = 0; k < places.size(); ++k) active.push_back(static_cast<int>(k));
  }
  static Model MakeModel() {
    Joint joint;
    joint.name = "plate", joint.type = JointType::kFree, joint.mass = 3, joint.inertia = Vector3(1, 1, 2).asDiagonal();
    return Model::Create({joint}).value();
  }
  static std::vector<TreeContact> Contacts(const std::vector<Vector3>& places, Grip grip) {
    std::vector<TreeContact> contacts(places.size());
    for (size_t k = 0; k < places.size(); ++k) {
      contacts[k].surface = {Sphere(0.1), places[k] + Vector3(0, 0, -0.4), Matrix3::Identity()};
      contacts[k].grip = grip;
    }
    return contacts;
  }
  ContactDynamics dynamics;
  std::vector<int> active;
};

}  // namespace rollgait::testing

#endif  // ROLLGAIT_TESTS_SUPPORT_STANDING_PLATE_H_
