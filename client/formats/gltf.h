// The walking body as an animated glTF 2.0 scene.
#ifndef ROLLGAIT_CLIENT_FORMATS_GLTF_H_
#define ROLLGAIT_CLIENT_FORMATS_GLTF_H_

#include <string>

#include "rollgait/v1/solve.pb.h"

namespace rollgait::client {

// glTF's axes: Y up, Z forward, X left; metres. The node "ground" carries everything and is turned by the slope, so
// that gravity is −Y. Below it a square of ground and a node for each link with mass, under its name, with its
// ellipsoids (LinkShapes). The animation "walk" turns them over the gait cycle, 201 keys with linear interpolation.
// Contract: the solve has a trajectory. Throws Failure(kUsage) as SkeletonMotion, LinkShapes and BuildStride.

// JSON with its buffer inside, .gltf.
std::string ToGltf(const v1::Solve& solve);
// The binary container, .glb.
std::string ToGlb(const v1::Solve& solve);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_FORMATS_GLTF_H_
