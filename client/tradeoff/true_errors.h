// How far apart two solutions of one request are.
#ifndef ROLLGAIT_CLIENT_TRADEOFF_TRUE_ERRORS_H_
#define ROLLGAIT_CLIENT_TRADEOFF_TRUE_ERRORS_H_

#include "rollgait/v1/solve.pb.h"

namespace rollgait::client {

struct TrueErrors {
  double objective = 0;   // as a share of that of the reference
  double angle_deg = 0;   // largest of a revolute joint
  double torque_n_m = 0;  // likewise
};

// The motions are compared at 200 instants a phase, at equal shares of its duration. Throws Failure(kUsage) if a
// trajectory does not fit its model, or the two have other joints or phases.
TrueErrors ErrorsAgainst(const v1::SolveResult& reference, const v1::SolveResult& result);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_TRADEOFF_TRUE_ERRORS_H_
