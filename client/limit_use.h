// Where a motion sits on the limits of its joints and of the ground.
#ifndef ROLLGAIT_CLIENT_LIMIT_USE_H_
#define ROLLGAIT_CLIENT_LIMIT_USE_H_

#include <string>
#include <vector>

#include "rollgait/v1/solve.pb.h"

namespace rollgait::client {

enum class LimitKind { kPosition, kVelocity, kEffort, kFriction };

struct LimitUse {
  LimitKind kind;
  std::string where;  // joint or contact
  std::string limit;  // "lower limit of -5°", "friction coefficient of 0.8"
  double share = 0;   // of the duration of the trajectory (of the phases in which the contact stands), (0, 1]
  double from_s = 0;  // when it is on the limit first, from the start of the trajectory
};

// Limits that the motion comes within 0.1 % of: of the width of the range for positions and efforts, of the limit for
// velocities and friction (contacts that carry at least 1 % of body weight). Judged at the collocation points, each of
// which stands for an equal part of its phase. Largest share first. Empty without a trajectory or a model that fits it.
std::vector<LimitUse> FindLimitUse(const v1::Solve& solve);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_LIMIT_USE_H_
