#ifndef ROLLGAIT_CORE_TRANSCRIPTION_CONSECUTIVE_POINTS_H_
#define ROLLGAIT_CORE_TRANSCRIPTION_CONSECUTIVE_POINTS_H_

#include <string>
#include <utility>
#include <vector>

#include "core/ocp/problem.h"
#include "core/transcription/layout.h"
#include "core/transcription/rate_term.h"

namespace rollgait {

// Two consecutive collocation points, Δt = ratio · T_phase apart, of the phase of the later one; ratio 0: the same
// instant. The last point of a motion is followed by the first one, mirrored in a half cycle.
struct PointLink {
  int from_interval, from_point, to_interval, to_point;
  int phase = 0;
  double ratio = 0;
  bool wraps = false;
};

// All links in the order of time.
std::vector<PointLink> ConsecutivePoints(const DecisionLayout& layout, const VectorX& point_fractions);

// What one actuated joint's effort changes by over a link, N m (N of a prismatic joint).
std::vector<Change> EffortChanges(const OptimalControlProblem& problem, const DecisionLayout& layout,
                                  const PointLink& link);

// What the components of the forces of the ground change by over a link, N, with the names of contact and direction.
// Along x of the contacts of one link together, else of each contact; of contacts that are active on neither side
// nothing.
std::vector<std::pair<std::string, Change>> ForceChanges(const OptimalControlProblem& problem,
                                                         const DecisionLayout& layout, const PointLink& link);

// The changes that a rate cost sums, each with its weight.
std::vector<Change> RateChanges(const RateCost& cost, const OptimalControlProblem& problem,
                                const DecisionLayout& layout, const VectorX& point_fractions);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_TRANSCRIPTION_CONSECUTIVE_POINTS_H_
