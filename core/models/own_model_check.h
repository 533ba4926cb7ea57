#ifndef ROLLGAIT_CORE_MODELS_OWN_MODEL_CHECK_H_
#define ROLLGAIT_CORE_MODELS_OWN_MODEL_CHECK_H_

#include <sstream>
#include <string>
#include <vector>

#include "core/models/own_model.h"

namespace rollgait {

// What the parts of OwnScene's checks share: the model at position zero, and what was found wrong so far.
class OwnModelCheck {
 public:
  explicit OwnModelCheck(const OwnModel& model) : own(model) {}

  // "joints[3].mass_kg" for ("joints", 3, "mass_kg").
  template <typename... Parts>
  void Refuse(const std::string& list, int index, const std::string& field, const Parts&... parts) {
    Add(list == "joints" ? JointPath(own.chains, index, field) : list + "[" + std::to_string(index) + "]." + field,
        Text(parts...));
  }
  template <typename... Parts>
  void RefuseModel(const std::string& field, const Parts&... parts) {
    Add(field, Text(parts...));
  }
  bool ok() const { return violations_.empty(); }
  Violations Take() { return std::move(violations_); }

  // The index that the message has of a joint; -1 for the world.
  int Named(int joint) const { return joint < 0 ? joint : MessageIndex(own.chains, joint); }

  // Link frames at position zero: axes and origin (m) in the world. Contract: every parent precedes its joint.
  void PlaceLinks();
  // Lowest point of a contact, m above the world's origin. Contract: PlaceLinks, an ellipsoid on a joint of the model.
  double Lowest(const ContactSurface& contact) const;

  const OwnModel& own;
  std::vector<Matrix3> R_WL;
  std::vector<Vector3> p_WL;

 private:
  template <typename... Parts>
  static std::string Text(const Parts&... parts) {
    std::ostringstream text;
    (text << ... << parts);
    return text.str();
  }
  void Add(std::string field, std::string message) { violations_.push_back({std::move(field), std::move(message)}); }
  Violations violations_;
};

// 1 to 64 letters, digits, "_", "-" or ".".
bool IsOwnName(const std::string& name);

// The parts, in the order in which they are asked: each may rely on those before it having found nothing.
void CheckOwnSizes(OwnModelCheck* check);                      // sizes, names, indices
void CheckOwnBase(OwnModelCheck* check);                       // floating base
void CheckOwnUnits(double leg_length, OwnModelCheck* check);   // masses, lengths, inertias
void CheckOwnJoints(double leg_length, OwnModelCheck* check);  // limits and roles
void CheckOwnChains(OwnModelCheck* check);                     // universal and ball joints
void CheckOwnFeet(double leg_length, OwnModelCheck* check);    // contacts
void CheckOwnMirror(double leg_length, OwnModelCheck* check);  // left and right

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MODELS_OWN_MODEL_CHECK_H_
