// The motion that formats write: the whole gait cycle, or a manoeuvre, at equal steps.
#ifndef ROLLGAIT_CLIENT_FORMATS_EXPORTED_STRIDE_H_
#define ROLLGAIT_CLIENT_FORMATS_EXPORTED_STRIDE_H_

#include <string>

#include "client/report/stride.h"
#include "rollgait/v1/solve.pb.h"

namespace rollgait::client {

// 201 instants from right heel strike on, or from the start of a motion without gait events. Throws Failure as
// BuildStride.
Stride ExportedStride(const v1::Solve& solve);

// One line about it for headers: the solve's name, what the motion is, the ground.
std::string DescribeStride(const v1::Solve& solve);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_FORMATS_EXPORTED_STRIDE_H_
