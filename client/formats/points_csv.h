// A trajectory at its collocation points, where the equations of motion hold.
#ifndef ROLLGAIT_CLIENT_FORMATS_POINTS_CSV_H_
#define ROLLGAIT_CLIENT_FORMATS_POINTS_CSV_H_

#include <string>

#include "rollgait/v1/solve.pb.h"

namespace rollgait::client {

// Comma separated, a header line with units; one row a point. Contract: the solve has a trajectory.
std::string ToCsv(const v1::Solve& solve);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_FORMATS_POINTS_CSV_H_
