// A model as MJCF, the XML of the simulator MuJoCo.
#ifndef ROLLGAIT_CLIENT_FORMATS_MJCF_H_
#define ROLLGAIT_CLIENT_FORMATS_MJCF_H_

#include <string>

#include "client/formats/ground.h"
#include "rollgait/v1/model.pb.h"

namespace rollgait::client {

// World axes, joint names, signs and units are the service's; qpos is Model.joints' order. A link without mass is no
// body: the next link with mass has its joints. The floating base is its own chain of slides and hinges. Surfaces are
// ellipsoid geoms: those that roll on the ground collide with the plane "ground", the others are to be seen (group 1).
// Actuators are motors whose control is the joint's effort. Throws Failure(kUsage) as BodyLinks and LinkShapes.
std::string ToMjcf(const v1::Model& model, const Ground& ground);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_FORMATS_MJCF_H_
