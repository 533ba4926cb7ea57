#ifndef ROLLGAIT_TESTS_SUPPORT_STANDING_BOX_H_
#define ROLLGAIT_TESTS_SUPPORT_STANDING_BOX_H_

#include <vector>

#include "core/contact/contact_dynamics.h"
#include "core/multibody/configuration.h"

namespace rollgait::testing {

// A box of 2 kg that stands at rest on four frictional points: twelve rows of rank six.
struct StandingBox {
  explicit StandingBox(const Vector3& moments)
      : model(MakeModel(moments)), dynamics(BodyDynamics(model), MakeContacts()) {
    VectorX q = NeutralConfiguration(model);
    q[6] = 1;
    dynamics.SetState(q, VectorX::Zero(6), {FrameMotion{}});
  }

  static Model MakeModel(const Vector3& moments) {
    Joint joint;
    joint.name = "box", joint.type = JointType::kFree, joint.mass = 2;
    joint.inertia = moments.asDiagonal();
    return Model::Create({joint}).value();
  }
  static std::vector<TreeContact> MakeContacts() {
    std::vector<TreeContact> contacts(4);
    for (int k = 0; k < 4; ++k) {
      contacts[static_cast<size_t>(k)].surface = {Sphere(0.1), Vector3(k % 2 == 0 ? 1 : -1, k < 2 ? 1 : -1, -0.9),
                                                  Matrix3::Identity()};
    }
    return contacts;
  }

  Model model;
  ContactDynamics dynamics;
};

}  // namespace rollgait::testing

#endif  // ROLLGAIT_TESTS_SUPPORT_STANDING_BOX_H_
