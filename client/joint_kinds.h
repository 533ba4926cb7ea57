// Types of joints, as the options of rollgait.v1.Joint.Type say them: what a client shows, draws and writes follows.
#ifndef ROLLGAIT_CLIENT_JOINT_KINDS_H_
#define ROLLGAIT_CLIENT_JOINT_KINDS_H_

#include <string>
#include <vector>

#include "rollgait/v1/model.pb.h"

namespace rollgait::client {

// "revolute"; of a type that this program does not know its number, "type 9".
std::string JointWord(const v1::Joint& joint);

// The same with how far the link moves along the axis where it also turns: "screw 5 mm/rad".
std::string JointText(const v1::Joint& joint);

// True if positions are angles, rad, and efforts N m: the link turns about the axis.
bool Turns(v1::Joint::Type type);
inline bool Turns(const v1::Joint& joint) { return Turns(joint.type()); }
// True if positions are lengths, m, and efforts N: the link moves along the axis and does not turn.
bool IsSlide(const v1::Joint& joint);
// How far the link moves along the axis by unit of the position, m; 0 if it does not.
double Advance(const v1::Joint& joint);

// The degrees of freedom of a joint as joints: of a universal or ball joint each coordinate as a revolute one with what
// JointCoordinate says, else the joint itself.
std::vector<v1::Joint> TurnsOf(const v1::Joint& joint);

// For formats whose joints turn or slide. Throws Failure(kUsage) that names model.joints[index].type of any other.
void RequireTurnOrSlide(const v1::Joint& joint, int index);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_JOINT_KINDS_H_
