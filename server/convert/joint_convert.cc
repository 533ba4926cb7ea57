#include "server/convert/joint_convert.h"

#include <vector>

#include "core/base/check.h"
#include "core/models/joint_chain.h"
#include "core/multibody/joint_number.h"
#include "server/convert/field_decoding.h"

namespace rollgait::server {
namespace {

double NumberOf(const google::protobuf::Message& message, const char* name) {
  return message.GetReflection()->GetDouble(message, FieldOf(message, name));
}

}  // namespace

v1::Joint::Type EncodeJointType(JointType type) {
  v1::Joint::Type encoded = v1::Joint::TYPE_UNSPECIFIED;
  ROLLGAIT_CHECK(v1::Joint::Type_Parse(KindOf(type).name, &encoded));
  return encoded;
}

const JointKind* DecodeJointType(v1::Joint::Type type) { return FindJointKind(v1::Joint::Type_Name(type)); }

std::string JointTypeNames(JointsOf of) {
  std::vector<std::string> names;
  for (const JointKind& kind : kJointKinds) {
    if (of == JointsOf::kScene || !kind.is_free()) names.push_back(kind.name);
  }
  for (const ChainKind& kind : kChainKinds) {
    if (of == JointsOf::kWalker) names.push_back(kind.name);
  }
  std::string list = names.front();
  for (size_t i = 1; i < names.size(); ++i) list += (i + 1 < names.size() ? ", " : " or ") + names[i];
  return list;
}

void EncodeJointNumbers(const Joint& joint, v1::Joint* encoded) {
  for (const JointNumber& number : kJointNumbers) {
    encoded->GetReflection()->SetDouble(encoded, FieldOf(*encoded, number.field), joint.*number.member);
  }
}

void DecodeJointNumbers(const v1::Joint& encoded, Joint* joint) {
  for (const JointNumber& number : kJointNumbers) joint->*number.member = NumberOf(encoded, number.field);
}

void DecodeJointNumbers(const v1::SceneJoint& encoded, Joint* joint) {
  for (const JointNumber& number : kJointNumbers) {
    if (number.scene_field == nullptr || (joint->kind().is_free() && !number.of_free)) continue;
    joint->*number.member = NumberOf(encoded, number.scene_field);
  }
}

}  // namespace rollgait::server
