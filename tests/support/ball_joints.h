#ifndef ROLLGAIT_TESTS_SUPPORT_BALL_JOINTS_H_
#define ROLLGAIT_TESTS_SUPPORT_BALL_JOINTS_H_

#include <algorithm>
#include <string>
#include <vector>

#include "rollgait/v1/model.pb.h"

namespace rollgait::testing {

// Joints of a model to be told of as one: consecutive turns from the joint `first` on.
struct Told {
  std::string first, name;
  v1::Joint::Type type;
};

// human29's hips, shoulders and trunk are balls, its ankles universal joints.
inline std::vector<Told> HumanBalls() {
  return {
      {"hip_l", "hip_ball_l", v1::Joint::TYPE_BALL},          {"hip_r", "hip_ball_r", v1::Joint::TYPE_BALL},
      {"ankle_l", "ankle_both_l", v1::Joint::TYPE_UNIVERSAL}, {"ankle_r", "ankle_both_r", v1::Joint::TYPE_UNIVERSAL},
      {"trunk_flexion", "trunk", v1::Joint::TYPE_BALL},       {"shoulder_l", "shoulder_ball_l", v1::Joint::TYPE_BALL},
      {"shoulder_r", "shoulder_ball_r", v1::Joint::TYPE_BALL}};
}

// The same model with these joints, written by hand: field by field, not by the server's code.
inline v1::Model WithBalls(const v1::Model& from, const std::vector<Told>& balls) {
  v1::Model model = from;
  model.clear_selection();
  model.clear_stature_m();
  model.clear_joints();
  std::vector<int> index;  // of each joint of `from`
  for (int i = 0; i < from.joints_size(); ++i) {
    const auto told =
        std::find_if(balls.begin(), balls.end(), [&](const Told& ball) { return ball.first == from.joints(i).name(); });
    v1::Joint& to = *model.add_joints();
    const int now = model.joints_size() - 1;
    to = from.joints(i);
    if (to.parent() >= 0) to.set_parent(index[static_cast<size_t>(to.parent())]);
    index.push_back(now);
    if (told == balls.end()) continue;
    const int turns = told->type == v1::Joint::TYPE_BALL ? 3 : 2;
    for (int k = 0; k < turns; ++k) {
      const v1::Joint& turn = from.joints(i + k);
      v1::JointCoordinate& coordinate = *to.add_coordinates();
      coordinate.set_name(turn.name());
      *coordinate.mutable_axis() = turn.axis();
      coordinate.set_position_min(turn.position_min());
      coordinate.set_position_max(turn.position_max());
      coordinate.set_velocity_max(turn.velocity_max());
      coordinate.set_actuated(turn.actuated());
      coordinate.set_effort_min(turn.effort_min());
      coordinate.set_effort_max(turn.effort_max());
      coordinate.set_stiffness(turn.stiffness());
      coordinate.set_rest_position(turn.rest_position());
      coordinate.set_damping(turn.damping());
      coordinate.set_mirror_sign(turn.mirror_sign());
      coordinate.set_role(turn.role());
      coordinate.set_passive(turn.passive());
      if (k > 0) index.push_back(now);
    }
    const v1::Joint& last = from.joints(i + turns - 1);
    to.set_name(told->name);
    to.set_type(told->type);
    to.clear_axis();
    to.clear_position_min();
    to.clear_position_max();
    to.clear_velocity_max();
    to.clear_actuated();
    to.clear_effort_min();
    to.clear_effort_max();
    to.clear_stiffness();
    to.clear_rest_position();
    to.clear_damping();
    to.clear_mirror_sign();
    to.clear_role();
    to.clear_passive();
    to.set_link_name(last.link_name());
    to.set_mass_kg(last.mass_kg());
    *to.mutable_center_of_mass_m() = last.center_of_mass_m();
    *to.mutable_inertia_kg_m2() = last.inertia_kg_m2();
    i += turns - 1;
  }
  for (v1::Joint& joint : *model.mutable_joints()) {
    joint.set_mirror_joint(index[static_cast<size_t>(joint.mirror_joint())]);
  }
  for (v1::ContactSurface& contact : *model.mutable_contacts()) {
    contact.set_joint(index[static_cast<size_t>(contact.joint())]);
  }
  for (v1::BodySurface& body : *model.mutable_bodies()) body.set_joint(index[static_cast<size_t>(body.joint())]);
  return model;
}

}  // namespace rollgait::testing

#endif  // ROLLGAIT_TESTS_SUPPORT_BALL_JOINTS_H_
