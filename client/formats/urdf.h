// A model as URDF, the Unified Robot Description Format.
#ifndef ROLLGAIT_CLIENT_FORMATS_URDF_H_
#define ROLLGAIT_CLIENT_FORMATS_URDF_H_

#include <string>

#include "rollgait/v1/model.pb.h"

namespace rollgait::client {

// Links and joints one to one, with the service's names, axes and signs; the root link "world" is the ground, the
// floating base is its own chain of joints. URDF has neither ground, slope nor ellipsoids: there are no shapes. A
// revolute joint without range is "continuous"; where URDF asks for a limit that the model does not have, it is
// kUrdfUnlimited. Throws Failure(kUsage) for a free joint.
std::string ToUrdf(const v1::Model& model);

// In the unit of the quantity.
constexpr double kUrdfUnlimited = 1e6;

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_FORMATS_URDF_H_
