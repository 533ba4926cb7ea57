// A stride as curves of every joint.
#ifndef ROLLGAIT_CLIENT_REPORT_STRIDE_DATA_H_
#define ROLLGAIT_CLIENT_REPORT_STRIDE_DATA_H_

#include <nlohmann/json.hpp>

#include "client/report/stride.h"

namespace rollgait::client {

// {duration, displacement,
//  joints: [{name, title, side, unit, positive, min, max, angle, torque, power}],
//  curves: as PackedRows::ToJson, a column a sample}
// Every revolute joint, and the actuated slides. title: the name without its side; side as in sides.h; unit of the
// angle, "degrees" or "m"; positive as PositiveDirection; min, max: range, null without one; angle, torque, power: rows
// of `curves`, the last two null for a joint without a motor. Units: degrees or m, N m or N, W.
nlohmann::json StrideData(const Stride& stride, const v1::Model& model);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_REPORT_STRIDE_DATA_H_
