#ifndef ROLLGAIT_CORE_MODELS_SCENE_H_
#define ROLLGAIT_CORE_MODELS_SCENE_H_

#include <string>
#include <vector>

#include "core/contact/body_surface.h"
#include "core/contact/contact_surface.h"
#include "core/models/body_selection.h"
#include "core/models/joint_chain.h"
#include "core/multibody/model.h"

namespace rollgait {

// What walks: a tree, the surfaces that may touch the ground z = 0, and the facts that a gait needs of it. Immutable
// value.
struct Scene {
  std::string name;
  std::string description;
  BodySelection selection;
  Model model;
  std::vector<ContactSurface> contacts;
  double leg_length;                     // m, hip to sole with straight leg, of the longer one
  std::vector<std::string> sources;      // where the numbers come from
  bool symmetric = true;                 // its left/right mirror image is itself; if not, it has no half cycle
  std::vector<BodySurface> bodies = {};  // the parts with a thickness
  std::vector<BodyPair> pairs = {};      // those that can meet
  std::vector<JointChain> chains = {};   // joints of the model that are one joint of a message

  // Index of a contact by name, -1 if there is none.
  int FindContact(const std::string& contact_name) const;
  // The same by side and part; the first if there are several.
  int FindContact(BodySide side, FootPart part) const;
  // "left_shank / right_heel". Contract: pair in range.
  std::string PairName(int pair) const;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MODELS_SCENE_H_
