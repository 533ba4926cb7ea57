#ifndef ROLLGAIT_CORE_TRANSCRIPTION_FLAT_SIDE_H_
#define ROLLGAIT_CORE_TRANSCRIPTION_FLAT_SIDE_H_

#include "core/ocp/constraints/friction.h"

namespace rollgait {

// What one side of a friction pyramid costs in one phase, since it is flat and the cone is round.
struct FlatSide {
  int phase = 0, contact = 0;
  FrictionSide side;
  // To first order, in units of the objective, at least 0: how much lower it would be with the cone in place of the
  // pyramid, where the force meets the cone within this side.
  double cost = 0;
  double direction = 0;  // rad: where it meets the cone, mean weighted with the cost
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_TRANSCRIPTION_FLAT_SIDE_H_
