#ifndef ROLLGAIT_SERVER_CONVERT_JOINT_CONVERT_H_
#define ROLLGAIT_SERVER_CONVERT_JOINT_CONVERT_H_

#include <string>

#include "core/multibody/model.h"
#include "rollgait/v1/model.pb.h"
#include "rollgait/v1/simulation.pb.h"

namespace rollgait::server {

// Types of joints as the wire names them, by core/multibody/joint_kind.h.
v1::Joint::Type EncodeJointType(JointType type);
// Null of a value that says no type.
const JointKind* DecodeJointType(v1::Joint::Type type);
// "TYPE_REVOLUTE, TYPE_PRISMATIC or …", as a message may say: of a scene or of a walker.
enum class JointsOf { kScene, kWalker };
std::string JointTypeNames(JointsOf of);

// The numbers of core/multibody/joint_number.h; to and from the message without change. Contract of reading: the
// joint's type is read.
void EncodeJointNumbers(const Joint& joint, v1::Joint* encoded);
void DecodeJointNumbers(const v1::Joint& encoded, Joint* joint);
void DecodeJointNumbers(const v1::SceneJoint& encoded, Joint* joint);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_CONVERT_JOINT_CONVERT_H_
