#ifndef ROLLGAIT_CORE_NLP_STEP_LENGTH_H_
#define ROLLGAIT_CORE_NLP_STEP_LENGTH_H_

#include "core/nlp/newton_step.h"

namespace rollgait {

// Largest step in (0, 1] after which every distance to a bound is at least 1 − τ of what it was (fraction to the
// boundary).
double MaxPrimalStep(const BarrierProblem& barrier, const BarrierProblem::Point& point, const VectorX& step,
                     double tau);
// Whether a step from a point that is nearly feasible is lost in the rounding of w.
bool IsTiny(const VectorX& step, const BarrierProblem::Point& point);
// The largest step after which positive numbers are at least 1 − τ of what they were.
double MaxPositiveStep(const VectorX& value, const VectorX& step, double tau);
// The same for the multipliers of bounds.
double MaxDualStep(const Multipliers& multipliers, const Multipliers& step, double tau);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_NLP_STEP_LENGTH_H_
