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
