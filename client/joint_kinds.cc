#include "client/joint_kinds.h"

#include "client/failure.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

// Options of a type that this program does not know are empty.
const google::protobuf::EnumValueOptions& OptionsOf(v1::Joint::Type type) {
  const google::protobuf::EnumValueDescriptor* const value = v1::Joint::Type_descriptor()->FindValueByNumber(type);
  return value == nullptr ? google::protobuf::EnumValueOptions::default_instance() : value->options();
}

bool Slides(const v1::Joint& joint) { return OptionsOf(joint.type()).GetExtension(v1::joint_slides); }

}  // namespace

std::string JointWord(const v1::Joint& joint) {
  const std::string& word = OptionsOf(joint.type()).GetExtension(v1::joint_word);
  return word.empty() ? "type " + std::to_string(joint.type()) : word;
}

bool Turns(v1::Joint::Type type) { return OptionsOf(type).GetExtension(v1::joint_turns); }

bool IsSlide(const v1::Joint& joint) { return Slides(joint) && !Turns(joint); }

double Advance(const v1::Joint& joint) {
  if (!Slides(joint)) return 0;
  return Turns(joint) ? joint.pitch_m_rad() : 1;
}

std::string JointText(const v1::Joint& joint) {
  if (!Turns(joint) || Advance(joint) == 0) return JointWord(joint);
  return JointWord(joint) + " " + FormatNumber(1e3 * Advance(joint)) + " mm/rad";
}

std::vector<v1::Joint> TurnsOf(const v1::Joint& joint) {
  if (joint.coordinates_size() == 0) return {joint};
  std::vector<v1::Joint> turns;
  for (const v1::JointCoordinate& from : joint.coordinates()) {
    v1::Joint& to = turns.emplace_back();
    to.set_type(v1::Joint::TYPE_REVOLUTE);
    to.set_name(from.name());
    *to.mutable_axis() = from.axis();
    to.set_position_min(from.position_min());
    to.set_position_max(from.position_max());
    to.set_velocity_max(from.velocity_max());
    to.set_actuated(from.actuated());
    to.set_effort_min(from.effort_min());
    to.set_effort_max(from.effort_max());
    to.set_stiffness(from.stiffness());
    to.set_rest_position(from.rest_position());
    to.set_damping(from.damping());
    to.set_mirror_sign(from.mirror_sign());
    to.set_role(from.role());
    to.set_passive(from.passive());
  }
  return turns;
}

void RequireTurnOrSlide(const v1::Joint& joint, int index) {
  if (Turns(joint) != Slides(joint)) return;
  std::string names;
  const google::protobuf::EnumDescriptor& types = *v1::Joint::Type_descriptor();
  for (int i = 0; i < types.value_count(); ++i) {
    const google::protobuf::EnumValueOptions& options = types.value(i)->options();
    if (options.GetExtension(v1::joint_turns) == options.GetExtension(v1::joint_slides)) continue;
    names += (names.empty() ? "" : " or ") + types.value(i)->name();
  }
  throw Failure(ExitCode::kUsage, "model.joints[" + std::to_string(index) + "].type must be " + names +
                                      " for this format; joint " + joint.name() + " is " + JointWord(joint));
}

}  // namespace rollgait::client
