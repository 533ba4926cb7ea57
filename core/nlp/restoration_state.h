#ifndef ROLLGAIT_CORE_NLP_RESTORATION_STATE_H_
#define ROLLGAIT_CORE_NLP_RESTORATION_STATE_H_

#include "core/nlp/barrier_parameter.h"
#include "core/nlp/newton_step.h"
#include "core/nlp/step_acceptance.h"

namespace rollgait {

// The elastic variables of the problem of restoration and the multipliers of their bounds at 0.
struct ElasticVariables {
  VectorX p, n, z_p, z_n;  // rows(), > 0; in rows without bounds p = n = 0 and the multipliers are 1
};

// All that a restoration phase carries from one iteration to the next, but for the point where it began.
struct RestorationState {
  VectorX w;  // variables and slacks
  Multipliers multipliers;
  ElasticVariables elastic;
  BarrierParameter::Memory barrier;
  StepAcceptance::Memory acceptance;
  NewtonSystem::Memory newton;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_NLP_RESTORATION_STATE_H_
