#ifndef ROLLGAIT_CORE_GAIT_WARM_START_H_
#define ROLLGAIT_CORE_GAIT_WARM_START_H_

#include <optional>

#include "core/base/result.h"
#include "core/base/types.h"
#include "core/ocp/added_constraints.h"
#include "core/trajectory/trajectory.h"

namespace rollgait {

struct GaitSpec;

// Lagrange multipliers of the last nonlinear program of a solve, per unit of the objective, in the order of
// CollocationNlp. Of bounds: that of the lower minus that of the upper one, of which at most one acts.
struct SolutionMultipliers {
  VectorX rows;
  VectorX bounds;

  void Scale(double factor) {
    rows *= factor;
    bounds *= factor;
  }
};

// The solution of a request like this one, for a solve to start from.
struct WarmStart {
  Trajectory trajectory;
  std::optional<SolutionMultipliers> multipliers;
  AddedConstraints added;             // of the NLP whose solution it is
  std::vector<int> overlapping = {};  // pairs of bodies that overlap in it: the next NLP keeps them apart
};

// What keeps a trajectory from being a start of the spec: another cycle or scheme, other phases, numbers of joints or
// intervals. Violations have the field "warm_start".
Violations CheckWarmStart(const GaitSpec& spec, const Trajectory& trajectory);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_WARM_START_H_
