#ifndef ROLLGAIT_TESTS_SUPPORT_CONTACT_TREE_H_
#define ROLLGAIT_TESTS_SUPPORT_CONTACT_TREE_H_

#include <random>
#include <utility>
#include <vector>

#include "core/contact/contact_dynamics.h"
#include "core/multibody/configuration.h"
#include "tests/support/random_tree.h"

namespace rollgait::testing {

// A free body that carries a chain of three joints, and a second free body, with every kind of contact: 0 of the first
// body with the ground frame 1 (moving), 1 of the chain's end with the ground frame 0, 2 of the first body with a plane
// on the chain's end, 3 of the second body with the first, surface on surface, close by and apart.
struct ContactTree {
  explicit ContactTree(unsigned seed) : random(seed), model(MakeModel()) {
    q = Retract(model, NeutralConfiguration(model), RandomVector(random, model.nv()));
    v = RandomVector(random, model.nv());
    ground.resize(2);
    ground[1] = {RandomRotation(random),  RandomVector(random, 3), RandomVector(random, 3),
                 RandomVector(random, 3), RandomVector(random, 3), RandomVector(random, 3)};
    contacts = MakeContacts();
  }

  Model MakeModel() {
    std::vector<Joint> joints = RandomTree(random, 5).joints();
    for (int i = 0; i < 5; ++i) joints[static_cast<size_t>(i)].parent = i == 4 ? -1 : i - 1;
    return WithFreeJoints(std::move(joints), {0, 4});
  }

  PlacedSurface RandomSurface() {
    const Vector3 axes = RandomVector(random, 3).cwiseAbs() + Vector3::Constant(0.2);
    return {Ellipsoid(axes), RandomVector(random, 3), RandomRotation(random)};
  }

  std::vector<TreeContact> MakeContacts() {
    std::vector<TreeContact> all(4);
    for (TreeContact& contact : all) {
      contact.surface = RandomSurface();
      contact.other = PlacedPlane{RandomVector(random, 3), Vector3(RandomVector(random, 3)).normalized()};
    }
    all[0].link = 0, all[0].ground = 1, all[0].no_spin = true;
    all[1].link = 3, all[1].grip = Grip::kFrictionless;
    all[2].link = 0, all[2].other_link = 3, all[2].grip = Grip::kRollingAlong, all[2].along = RandomVector(random, 3);
    // The second body's surface is put 2.9 from the first one's centre; neither extends further than 1.2.
    all[3].link = 4, all[3].other_link = 0;
    const PlacedSurface other = RandomSurface();
    all[3].other = other;
    BodyDynamics::State state;
    BodyDynamics(model).ComputeState(q, v, &state);
    const Vector3 target =
        state[0].p_WL + state[0].R_WL * other.p_BE + 2.9 * Vector3(RandomVector(random, 3)).normalized();
    all[3].surface.p_BE = state[4].R_WL.transpose() * (target - state[4].p_WL);
    return all;
  }

  std::mt19937 random;
  Model model;
  VectorX q, v;
  std::vector<FrameMotion> ground;
  std::vector<TreeContact> contacts;
};

}  // namespace rollgait::testing

#endif  // ROLLGAIT_TESTS_SUPPORT_CONTACT_TREE_H_
