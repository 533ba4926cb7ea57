#ifndef ROLLGAIT_SERVER_CONVERT_WARM_START_CONVERT_H_
#define ROLLGAIT_SERVER_CONVERT_WARM_START_CONVERT_H_

#include "core/base/result.h"
#include "core/gait/gait_spec.h"
#include "rollgait/v1/solve.pb.h"

namespace rollgait::server {

// What a solve of the spec can start from. Violations, all with the field "warm_start": the trajectory is not one of
// the spec's joints, contacts, cycle and scheme (CheckWarmStart), or its sizes do not fit together. Multipliers without
// rows count as none.
Result<WarmStart> DecodeWarmStart(const v1::Trajectory& trajectory, const v1::Multipliers& multipliers,
                                  const GaitSpec& spec);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_CONVERT_WARM_START_CONVERT_H_
