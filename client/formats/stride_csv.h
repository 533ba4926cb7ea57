// Both legs over the whole stride as a table.
#ifndef ROLLGAIT_CLIENT_FORMATS_STRIDE_CSV_H_
#define ROLLGAIT_CLIENT_FORMATS_STRIDE_CSV_H_

#include <string>

#include "rollgait/v1/solve.pb.h"

namespace rollgait::client {

// Comma separated, one header line, the service's axes, SI units and radians, 201 rows. Columns as in the Python
// client's Gait.stride(): percent, time_s, "knee_r", "knee_r.velocity", "knee_r.effort", "right.force_x"; after them
// the centre of pressure "right.pressure_x", "right.pressure_y" and the free moment "right.free_moment" of each foot,
// and of each surface "right_heel.force_x" … and its lowest point "right_heel.point_x" …, also in the air. Contract:
// the solve has a trajectory. Throws Failure(kUsage) where trajectory and model do not fit.
std::string ToStrideCsv(const v1::Solve& solve);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_FORMATS_STRIDE_CSV_H_
