#ifndef ROLLGAIT_CORE_MODELS_OWN_MODEL_H_
#define ROLLGAIT_CORE_MODELS_OWN_MODEL_H_

#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/contact/body_surface.h"
#include "core/contact/contact_surface.h"
#include "core/models/joint_chain.h"
#include "core/models/scene.h"
#include "core/multibody/model.h"

namespace rollgait {

inline constexpr int kMaxOwnJoints = 64, kMaxOwnContacts = 16, kMaxOwnBodies = 64, kMaxOwnPairs = 512;
inline constexpr int kMaxOwnSources = 64;

// A walker given as data, any numbers: see rollgait.v1.Model for each field. Indices may be out of range. At position
// zero it stands straight, facing x of the world, y to its left.
struct OwnModel {
  std::string name, description;
  std::vector<Joint> joints;
  std::vector<ContactSurface> contacts;
  std::vector<BodySurface> bodies;
  std::vector<BodyPair> pairs;       // mirror_pair is found here
  std::optional<double> total_mass;  // kg; if given, must be the sum
  std::optional<double> leg_length;  // m; default: from hip to sole at position zero
  std::vector<std::string> sources;
  // Joints of the message that are several of `joints`, ascending: revolute, each the parent of the next, the ones
  // after the first in the frame of the link before. Contract: none is out of range. Violations name them as the
  // message does.
  std::vector<JointChain> chains = {};
};

// The scene of a walker given as data, its numbers unchanged to the bit. Refuses what a solver could not make walk and
// what is no body, at position zero where a posture matters:
//   sizes and names             more than the numbers above; names are 1 to 64 letters, digits, "_", "-" or "."
//   tree                        what Model::Create refuses; a base that is not the chain of base roles; other roots
//   units                       total mass and leg length out of range, radii of gyration longer than twice the leg
//   universal and ball joints   axes that are parallel, a second of three turns whose range the joint would lock in
//   joints                      a missing or infinite range, velocity or effort of a joint that is not of the base
//   roles                       no hip; an axis across the role; a role in front of the one that moves it (a knee above
//                               the hip); a left hip to the right of the right one; a passive torque of people on
//                               another joint
//   feet                        no contact on a side, surfaces without a WalkingShape,
//                               soles above the hip, beside each other by more than a fifth of the leg, or above the
//                               centre of mass of a link
//   mirror                      links, joints, limits or contacts that are not the mirror images they name
// Violations name fields of rollgait.v1.Model, "joints[3].mass_kg", with link or joint, value and limit.
Result<Scene> OwnScene(const OwnModel& model);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MODELS_OWN_MODEL_H_
