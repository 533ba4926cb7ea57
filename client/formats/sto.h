// The gait cycle as OpenSim storage in the service's own axes and names.
#ifndef ROLLGAIT_CLIENT_FORMATS_STO_H_
#define ROLLGAIT_CLIENT_FORMATS_STO_H_

#include <string>

#include "rollgait/v1/solve.pb.h"

namespace rollgait::client {

// 201 equal steps of the cycle, tab separated, SI units. Contract: the solve has a trajectory. Throws Failure(kUsage)
// as BuildStride and RequireInstants.
std::string ToSto(const v1::Solve& solve);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_FORMATS_STO_H_
