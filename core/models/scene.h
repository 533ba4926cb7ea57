#ifndef ROLLGAIT_CORE_MODELS_SCENE_H_
#define ROLLGAIT_CORE_MODELS_SCENE_H_

#include <string>
#include <vector>

#include "core/contact/contact_surface.h"
#include "core/multibody/model.h"

namespace rollgait {

enum class Sex { kFemale, kMale };

// Which body, as validated: see rollgait.v1.ModelSelection.
struct BodySelection {
  std::string model;
  Sex sex = Sex::kMale;
  double stature = 1.774;  // m
  double mass = 75.0;      // kg
};

// What walks: a tree, the surfaces that may touch the ground z = 0, and the facts that a gait needs of it. Immutable value.
struct Scene {
  std::string name;
  std::string description;
  BodySelection selection;
  Model model;
  std::vector<ContactSurface> contacts;
  double leg_length;                 // m, hip to sole with straight leg
  std::vector<std::string> sources;  // where the numbers come from

  // Index of a contact by name, -1 if there is none.
  int FindContact(const std::string& contact_name) const;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MODELS_SCENE_H_
