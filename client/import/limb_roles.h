// What the joints of legs, arms and trunk are for, from their names, axes and order.
#ifndef ROLLGAIT_CLIENT_IMPORT_LIMB_ROLES_H_
#define ROLLGAIT_CLIENT_IMPORT_LIMB_ROLES_H_

#include <string>
#include <vector>

#include "rollgait/v1/model.pb.h"

namespace rollgait::client {

struct LimbJoint {
  int index;  // of the joint in its tree
  std::string name;
  v1::BodySide side;
  bool in_leg;    // between the root and a foot
  double across;  // |component| of the axis along y of the world, 0 to 1; 0 of a prismatic joint
};

struct LimbRole {
  int index;
  v1::Joint::Role role;
  std::string reason;
};

// Only joints with across >= 0.5 have a role, each at most one, and no role is given twice on a side. In a leg (joints
// in order from the root): the first whose name has "hip", "knee" or "ankle", in any case; what is then missing by
// order: the first joint flexes the hip, the next the knee, the next the ankle. Of all others by name alone: "shoulder"
// (or "arm_flex") and "elbow" on a side; "waist", "trunk", "torso", "back", "spine", "lumbar" and "abdomen" in the
// middle.
std::vector<LimbRole> ProposeRoles(const std::vector<LimbJoint>& joints);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_IMPORT_LIMB_ROLES_H_
