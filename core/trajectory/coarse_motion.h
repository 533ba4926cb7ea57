#ifndef ROLLGAIT_CORE_TRAJECTORY_COARSE_MOTION_H_
#define ROLLGAIT_CORE_TRAJECTORY_COARSE_MOTION_H_

#include <vector>

#include "core/trajectory/trajectory.h"

namespace rollgait {

// Positions of a motion at some of its nodes: for a picture of an iterate that is no solution yet. A value.
struct CoarseMotion {
  struct Phase {
    std::vector<int> contacts;  // indices into Scene::contacts
    double start = 0;           // s
    double duration = 0;        // s
    std::vector<double> times;  // s, ascending: the first and the last node of the phase, and some between
    MatrixX positions;          // nq × times, rad and m
  };
  Cycle cycle = Cycle::kHalf;
  double duration = 0;      // s
  double displacement = 0;  // m, along x
  std::vector<Phase> phases;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_TRAJECTORY_COARSE_MOTION_H_
