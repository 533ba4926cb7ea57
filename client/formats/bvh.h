// The walk as BVH (Biovision hierarchy), for animation programs.
#ifndef ROLLGAIT_CLIENT_FORMATS_BVH_H_
#define ROLLGAIT_CLIENT_FORMATS_BVH_H_

#include <string>

#include "rollgait/v1/solve.pb.h"

namespace rollgait::client {

// Bones are the links with mass under their names; the axes are OpenSim's (X forward, Y up, Z right) and fixed to the
// ground; lengths in centimetres, angles in degrees, channels Zrotation Xrotation Yrotation. 201 frames. Contract: the
// solve has a trajectory. Throws Failure(kUsage) as SkeletonMotion and BuildStride.
std::string ToBvh(const v1::Solve& solve);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_FORMATS_BVH_H_
