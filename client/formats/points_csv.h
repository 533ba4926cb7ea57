// A trajectory at the times of its collocation points.
#ifndef ROLLGAIT_CLIENT_FORMATS_POINTS_CSV_H_
#define ROLLGAIT_CLIENT_FORMATS_POINTS_CSV_H_

#include <string>

#include "rollgait/v1/solve.pb.h"

namespace rollgait::client {

// Comma separated, a header line with units; one row a point. Positions and velocities are those of the motion q(t),
// TrajectoryPhase.point_positions; the equations of motion hold at the stage positions, which differ from them inside
// an interval. Contract: the solve has a trajectory.
std::string ToCsv(const v1::Solve& solve);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_FORMATS_POINTS_CSV_H_
