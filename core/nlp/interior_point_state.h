#ifndef ROLLGAIT_CORE_NLP_INTERIOR_POINT_STATE_H_
#define ROLLGAIT_CORE_NLP_INTERIOR_POINT_STATE_H_

#include <optional>
#include <vector>

#include "core/nlp/barrier_parameter.h"
#include "core/nlp/barrier_problem.h"
#include "core/nlp/newton_step.h"
#include "core/nlp/restoration_state.h"
#include "core/nlp/step_acceptance.h"

namespace rollgait {

// All that the interior point method carries from one iteration to the next. A solve that goes on from it takes the
// same steps as one that was not interrupted, to the last bit where program and processor are the same. Within
// restoration everything but iteration, time and moved bounds is as it was where the phase began; the rest is in
// `restoration`.
struct InteriorPointState {
  int iteration = 0;     // the one at whose point this was taken; it has been reported
  double elapsed_s = 0;  // s, from the start of the solve to there
  VectorX w;             // variables and slacks
  Multipliers multipliers;
  BarrierParameter::Memory barrier;
  StepAcceptance::Memory acceptance;
  NewtonSystem::Memory newton;
  std::vector<BarrierProblem::MovedBound> moved_bounds;
  int tiny_steps = 0;                                          // the last steps in a row that did not move the point
  bool asked = false;                                          // NlpOptions::worth_finishing has been asked
  std::optional<RestorationState> restoration = std::nullopt;  // empty: not within restoration
};

// Whether a solve of the problem with these options can go on from a state: every size is right, every number finite, w
// within its bounds, multipliers of bounds positive, and the functions have values there. Within restoration so of both
// points, and elastic variables are positive.
bool Fits(const InteriorPointState& state, NlpProblem& problem, const NlpOptions& options);

// Who keeps the states of a running solve.
class StateKeeper {
 public:
  virtual ~StateKeeper() = default;
  // Whether the state at this iteration is wanted. Asked once an iteration, within restoration too.
  virtual bool IsDue(int iteration) = 0;
  // Given when it is due, and when the solve is stopped (SolveControl::stop).
  virtual void Keep(const InteriorPointState& state) = 0;
};

// What a solve goes on from, and who keeps its states. Both may be null. What is pointed to outlives the solve.
struct Resumption {
  const InteriorPointState* from = nullptr;  // contract: Fits
  StateKeeper* keeper = nullptr;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_NLP_INTERIOR_POINT_STATE_H_
