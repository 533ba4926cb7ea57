#ifndef ROLLGAIT_CORE_GAIT_ITERATE_SINK_H_
#define ROLLGAIT_CORE_GAIT_ITERATE_SINK_H_

#include "core/nlp/result.h"
#include "core/trajectory/coarse_motion.h"

namespace rollgait {

// Takes the motion of some iterates of a running search, to show them. Called in the solving thread, between
// evaluations; it only reads, so that the search is the same with and without one. There is no iterate of a manoeuvre,
// whose charts change, nor in the restoration phase of Ipopt.
class IterateSink {
 public:
  virtual ~IterateSink() = default;
  // Asked once an iteration, at once after the observer; must take no longer than a reading of the clock.
  virtual bool Wants() = 0;
  // Called if Wants() was true. `motion` is that of the program that is being solved, in SI units, in the joints of the
  // request's model; it may be not finite.
  virtual void Take(const IterationInfo& iteration, const CoarseMotion& motion) = 0;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_ITERATE_SINK_H_
