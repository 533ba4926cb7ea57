// The walk as an MCAP log, for Foxglove and other viewers of robot logs.
#ifndef ROLLGAIT_CLIENT_FORMATS_MCAP_H_
#define ROLLGAIT_CLIENT_FORMATS_MCAP_H_

#include <string>

#include "rollgait/v1/solve.pb.h"

namespace rollgait::client {

// JSON messages at 201 instants; log time is the time in the gait cycle. The service's axes, SI units, radians.
//   /joints           rollgait.JointStates: name, position, velocity, effort
//   /ground_reaction  rollgait.GroundReaction: for each foot force, centre of pressure, free moment
//   /tf               foxglove.FrameTransforms: world -> each link with mass
//   /body             foxglove.SceneUpdate: the ellipsoids, once at the start
// Contract: the solve has a trajectory. Throws Failure(kUsage) as BodyLinks, LinkShapes and BuildStride.
std::string ToMcap(const v1::Solve& solve);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_FORMATS_MCAP_H_
